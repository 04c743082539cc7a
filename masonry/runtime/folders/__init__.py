"""What of a folder is ours: nothing else in it is replaced or deleted."""
