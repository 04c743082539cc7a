"""Rigid blocks in equilibrium, as optimisation on plain arrays: the largest load factor; knows no scenes."""
