"""Names of contact points: whole numbers made of the edges that meet in them, so that they are found again exactly."""

from masonry.detection.bare import bare

MOST_FACES, MOST_CORNERS = 4096, 2047
"""Of one piece, and of one face."""
OTHER, CUT = 2048, 4095
"""Where the edges of the second face begin, and the edge along which a polygon was cut at the reach."""
CROSSED = 1 << 60
"""Added where two edges cross."""


@bare
def corner_feature(face_a, face_b, one, two):
    """A corner of the overlap of two faces (numbers within their pieces), where edges one and two meet."""
    low, high = min(one, two), max(one, two)
    return ((face_a * 4096 + face_b) * 4096 + low) * 4096 + high


@bare
def crossing_feature(edge_a, edge_b):
    """Where two edges (numbers within their pieces) cross."""
    return CROSSED + edge_a * 1048576 + edge_b
