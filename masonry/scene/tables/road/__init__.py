"""Tables of a scene for the road over a structure: what drives on it."""
