"""From a vector to the kind of place, with calibrated probabilities."""
