"""Furniture and small things, each as a person would name it."""
