"""What a scene says of the road over a structure: what drives on it."""
