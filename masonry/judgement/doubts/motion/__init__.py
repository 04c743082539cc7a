"""Motion of a specimen that should rest or follow its drive, and the effect of damping on it."""
