"""What a viewer is shown, and the viewer that records for Rerun."""
