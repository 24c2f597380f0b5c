"""Relocalisation: by visual words, during a run and from disk."""
