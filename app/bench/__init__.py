"""Timed runs of sequences, each in a process of its own."""
