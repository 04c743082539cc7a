"""Files of blocks, meshes and CAD."""
