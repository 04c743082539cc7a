"""Remarks on a scene and on its run from blocks, joints and frames: doubts, one a file, found by folder."""
