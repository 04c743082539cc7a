"""Contact detection of large displacement: convex pieces, their common planes, overlap polygons, neighbours, history.

Knows plain arrays; no laws, time steps or scenes. patches/refreshing.py says when a run looks again.
"""
