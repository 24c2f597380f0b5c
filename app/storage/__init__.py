"""What lies on disk: a run's folder and its files, how a sequence was opened, cached buildings."""
