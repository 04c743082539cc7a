"""Overlays drawn over the blocks of a specimen."""
