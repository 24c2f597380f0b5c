"""How right labels, probabilities, places and graphs are."""
