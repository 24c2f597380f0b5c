"""Keyframes found again: by words, from memory and from disk."""
