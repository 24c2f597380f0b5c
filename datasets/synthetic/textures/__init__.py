"""Procedural images of materials and of the things that hang, stand and lie in the rooms."""
