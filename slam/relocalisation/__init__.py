"""Keyframes found again: by words, in memory and from disk."""
