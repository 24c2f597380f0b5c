"""Frames, cameras, trajectories, readers and the rendered building: what comes in."""
