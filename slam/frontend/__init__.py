"""Tracking of each frame: by optical flow, by features, by depth alone."""
