"""Curves and cracks as pictures."""
