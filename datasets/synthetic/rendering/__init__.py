"""Surfaces, their light, and pictures of them by ray casting."""
