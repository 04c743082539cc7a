"""Names of contact points: whole numbers made of the edges that meet in them, so that they are found again exactly."""

from masonry.jit.compiler import inner

MOST_FACES, MOST_CORNERS = 4096, 2047
"""Of one piece, and of one face."""
OTHER, CUT = 2048, 4095
"""Where the edges of the second face begin, and the edge along which a polygon was cut at the reach."""
CROSSED, LONE, INNER = 1 << 60, 1 << 59, 1 << 49
"""Added where two edges cross; where a corner is in the other piece that no corner of an overlap of faces is; and to
the name of a corner, once, twice, ..., for each point inside the patch that stands for it (spread.py)."""


@inner
def corner_feature(face_a, face_b, edge_a, edge_b):
    """A corner of the overlap of two faces (numbers within their pieces), where edges a and b meet."""
    low, high = min(edge_a, edge_b), max(edge_a, edge_b)
    return ((face_a * 4096 + face_b) * 4096 + low) * 4096 + high


@inner
def crossing_feature(edge_a, edge_b):
    """Where two edges (numbers within their pieces) cross."""
    return CROSSED + edge_a * 1048576 + edge_b


@inner
def lone_feature(face, corner, side):
    """A corner of one piece in a face of the other (numbers within their pieces); side: whose corner, 1 or -1."""
    return LONE + (face * 1048576 + corner) * 2 + (1 if side > 0.0 else 0)
