"""Pictures of a sweep: all curves in one, and a map of two keys."""
