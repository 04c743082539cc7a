"""Where a straight line along x, y or z, or a point, runs through convex bodies: its pieces, and what each counts."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from geometry.blocks import Blocks
from geometry.polyhedra.measures import face_areas_normals_centroids
from geometry.polyhedra.polygons import pad

TOUCH = 1e-7
"""Of the specimen's extent: what a point or a line lies in, it may miss by so much."""


@dataclass(frozen=True)
class LinePieces:
    """Pieces of a line in bodies.

    body    (n,) number of the body     middle  (n, 3) m, of the piece
    fraction  (n,) of all that the bodies hold of the line; where k bodies share a piece each has a k-th; adds up to 1
    """

    body: np.ndarray
    middle: np.ndarray
    fraction: np.ndarray


def planes_of(blocks: Blocks) -> tuple[np.ndarray, np.ndarray]:
    """Outward normals (B, n, 3) of the faces of each block, and their levels (B, n) m, as `pieces` takes them."""
    _, normal, centre = face_areas_normals_centroids(blocks)
    level = np.einsum("fi,fi->f", normal, centre)
    planes, _ = pad(np.column_stack([normal, level]), blocks.block_face_start, np.arange(len(level)))
    return planes[:, :, :3], planes[:, :, 3]


def pieces(normal: np.ndarray, level: np.ndarray, place: Sequence[float | None], width: float) -> LinePieces:
    """The pieces of a line, or of a point, in convex bodies {p: normal . p <= level}; none where it misses them all.

    normal (n, k, 3), level (n, k) m: planes of each body, outward unit normals; repeat one where a body has fewer
    place   m, coordinates along x, y, z; None for the axis that a line runs along (one at most)
    width   m: bodies that the line touches within it hold it, shorter pieces do not count
    """
    start = np.array([0.0 if value is None else value for value in place])
    room = level + width - normal @ start
    if None not in place:
        body = np.flatnonzero((room >= 0.0).all(axis=1))
        return LinePieces(body, np.tile(start, (len(body), 1)), np.full(len(body), 1.0 / max(len(body), 1)))
    axis = list(place).index(None)
    slope = normal[:, :, axis]
    level_on = np.abs(slope) < 1e-9
    with np.errstate(divide="ignore", invalid="ignore"):
        crossing = (room - width) / slope
    high = np.where(slope > 0, crossing, np.inf)
    low = np.where(slope < 0, crossing, -np.inf)
    high, low = (np.where(level_on, infinite, end) for infinite, end in ((np.inf, high), (-np.inf, low)))
    outside = (level_on & (room < 0.0)).any(axis=1)
    high, low = high.min(axis=1), low.max(axis=1)
    body = np.flatnonzero(~outside & (high - low > width))
    cuts = np.unique(np.concatenate([low[body], high[body]]))
    cuts = cuts[np.concatenate([[True], np.diff(cuts) > width])] if len(cuts) else cuts
    begin, end = cuts[:-1], cuts[1:]
    holds = (low[body][:, None] <= begin + width) & (high[body][:, None] >= end - width)
    which, k = np.nonzero(holds)
    middle = np.tile(start, (len(which), 1))
    middle[:, axis] = 0.5 * (begin + end)[k]
    length = (end - begin)[k] / holds.sum(axis=0)[k]
    return LinePieces(body[which], middle, length / max(length.sum(), 1e-300))
