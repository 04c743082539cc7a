"""`masonry converge`: how far the numbers of a scene are from those of the same model, refined without end."""
