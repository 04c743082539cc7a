"""What stands where: blocks, meshes and joints as plain arrays. Knows no mechanics; imports no `masonry`."""
