"""Evaluation of labels, probabilities, places and graphs."""
