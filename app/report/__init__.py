"""A run for people: the page, the floor plan, the figures."""
