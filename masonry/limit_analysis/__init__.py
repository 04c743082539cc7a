"""Limit analysis of a scene: its contacts and loads, the factor, how it fails, in words and pictures.

The optimisation itself is masonry/statics: cones.py, interior_point.py (Clarabel), linear_programming.py (HiGHS),
no_dilation.py.
"""
