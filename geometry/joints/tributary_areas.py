"""Each joint polygon shared out among its contact points: what lies nearer to one than to any other of the polygon."""

import numpy as np

from geometry.blocks import Joints
from geometry.polyhedra.polygons import pad, unpad, widen

NEIGHBOURS = 8
"""So many of the nearest points are looked at first; twice as many where these leave a doubt, and so on."""
FEW = 400
"""Points up to which all distances are quicker found than the library of trees is loaded."""


def tiles(joints: Joints) -> tuple[np.ndarray, np.ndarray]:
    """Start (C + 1,) and corners (., 3) m of a convex polygon for each contact point, round about its normal.

    The tiles of a joint polygon cover it once (Voronoi 1908). Points that coincide have the same tile.
    """
    from geometry.joints.cut_tiles import cut_at_neighbours  # compiled: pictures that need no tiles go without

    polygon, sides = pad(joints.patch_points, joints.patch_start, np.arange(len(joints.patch_points)))
    corners, count = polygon[joints.patch], sides[joints.patch]
    most = int(np.bincount(joints.patch).max(initial=1))
    open_, seen = np.arange(len(joints.point)), 1
    while len(open_) and seen < most:
        near_by = min(most, max(seen * 2, NEIGHBOURS))
        distance, near = _nearest(joints, open_, near_by)
        corners = widen(corners, int(count.max()) + near_by - seen)  # a cut adds one at most
        reach = cut_at_neighbours(corners, count, joints.point, open_, near[:, seen:], distance[:, seen:])
        corners = corners[:, : int(count.max())]
        open_, seen = open_[distance[:, -1] < reach], near_by
    start, points = unpad(corners, count)
    return start, points


def _nearest(joints: Joints, which: np.ndarray, number: int) -> tuple[np.ndarray, np.ndarray]:
    """Distance and index (n, number) of the points nearest to some, the nearest first; others' polygons are far."""
    apart = 10.0 * float(np.ptp(joints.point, axis=0).max())  # a fourth axis on which other polygons are out of reach
    place = np.column_stack([joints.point, apart * joints.patch])
    if len(place) <= FEW:
        between = np.linalg.norm(place[which][:, None] - place, axis=2)
        near = np.argsort(between, axis=1, kind="stable")[:, :number]
        return np.take_along_axis(between, near, axis=1), near
    from scipy.spatial import cKDTree

    distance, near = cKDTree(place).query(place[which], k=number)
    return distance.reshape(len(which), -1), near.reshape(len(which), -1)
