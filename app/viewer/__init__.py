"""The interface of viewers, and the viewer that records for Rerun."""
