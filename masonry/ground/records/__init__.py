"""Records of the ground from files of other programs and networks: a format a file, which knows its own head."""
