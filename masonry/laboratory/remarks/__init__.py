"""What is said of a scene and of its run from blocks, joints and frames: doubts, one a file, found by folder."""
