"""Keyframes in the background: constraints, bundle adjustment, loops and the pose graph."""
