"""One run: frames in, a run's folder out."""
