"""Movies of a run, and the specimen in 3D."""
