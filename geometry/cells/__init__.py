"""Voronoi and Laguerre division of units and mortar beds into convex cells with planar faces."""
