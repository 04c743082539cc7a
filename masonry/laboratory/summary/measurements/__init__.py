"""Numbers of a run beside those of a test: of a measured curve, and by a standard."""
