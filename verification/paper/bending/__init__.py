"""Horizontal bending: the runs, the estimates by hand, what is read off the walls, and the claims on them."""
