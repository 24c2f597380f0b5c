"""Recorded sequences: a file for each layout on disk."""
