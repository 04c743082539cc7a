"""Polygons and polyhedra: measures, clipping, convexity, overlap."""
