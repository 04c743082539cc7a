"""Files of blocks: CAD, meshes, tessellations, our own format."""
