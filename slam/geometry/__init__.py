"""Motions, planes and surfaces: estimated, aligned and compared."""
