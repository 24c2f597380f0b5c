"""Things of corridors, halls, store rooms and cleaners."""
