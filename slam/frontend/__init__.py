"""Where each frame is: by optical flow, by features, by depth alone."""
