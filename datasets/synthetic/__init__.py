"""Rendered worlds: buildings from a seed, recorded on a walk, with their truth."""
