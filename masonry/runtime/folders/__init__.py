"""Files of a folder that are ours: nothing else in it is replaced or deleted."""
