"""Records of summary.json that only some runs have."""
