"""Furniture of homes, and the chairs and tables of all rooms."""
