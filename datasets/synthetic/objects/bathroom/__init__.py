"""Bathroom things: toilets, basins, tubs, towels."""
