"""Files on disk: run folders, input options, cached buildings."""
