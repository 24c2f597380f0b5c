"""Local features of a frame, and how they are matched."""
