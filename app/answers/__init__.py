"""Answers about a finished map: places, routes, whereabouts, and why a label was given."""
