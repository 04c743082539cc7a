"""Stiffness and strength of joints from moduli, tests and codes: what `masonry contact` says."""
