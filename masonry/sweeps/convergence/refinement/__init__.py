"""Finer and coarser runs of a scene, and the error of its numbers that follows from them."""
