"""Faces that look at each other and nearly touch: small gaps and overlaps of imported solids."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from geometry.blocks import Blocks, GeometryError
from geometry.joints.find import facing_pairs
from geometry.polyhedra.box_pairs import overlapping_boxes
from geometry.polyhedra.intersect import is_inside, solid
from geometry.polyhedra.measures import bounds, extent, face_areas_normals_centroids
from geometry.polyhedra.overlaps import all_overlaps
from geometry.polyhedra.overlaps import described as overlaps_described
from geometry.polyhedra.polygons import areas_normals_centroids, clip, pad, tidy

LISTED = 5
ALMOST = 1e-4
"""Of the tolerance: so little above it is rounding of the file."""


class Unmended(GeometryError):
    """Gaps and overlaps beyond the tolerance; needed: the tolerance (m) that covers all of them."""

    def __init__(self, message: str, needed: float) -> None:
        super().__init__(message)
        self.needed = needed


@dataclass(frozen=True)
class Facing:
    """Pairs of faces that look at each other and lie over each other.

    face_a, face_b  (N,), block of a < block of b
    size            (N,) m between them where they are farthest apart: above 0 a gap, below 0 an overlap
    place           (N, 3) m, middle of what lies over each other
    """

    face_a: np.ndarray
    face_b: np.ndarray
    size: np.ndarray
    place: np.ndarray

    def chosen(self, which: np.ndarray) -> "Facing":
        """Those marked in which (N,)."""
        return Facing(self.face_a[which], self.face_b[which], self.size[which], self.place[which])


def facing_faces(blocks: Blocks, limit: float, tolerance: float) -> Facing:
    """All faces that touch, gape or overlap by up to limit (m) over a breadth of more than tolerance (m).

    What lies between two faces of a gap must be empty, and behind two faces that overlap there must be matter. The time
    grows nearly as the number of faces.
    """
    width = 1e-9 * extent(blocks)
    face_a, face_b = facing_pairs(blocks, limit)
    corners, count = pad(blocks.points, blocks.face_start, blocks.face_points)
    _, normal, centroid = face_areas_normals_centroids(blocks)
    over, number = clip(corners[face_a], count[face_a], corners[face_b], normal[face_b], width)
    over, number = tidy(over, number, width)
    area, _, place = areas_normals_centroids(over)
    perimeter = np.linalg.norm(np.roll(over, -1, axis=1) - over, axis=2).sum(axis=1)
    height = np.einsum("nki,ni->nk", over - centroid[face_b][:, None], normal[face_b])
    farthest = np.argmax(np.abs(height), axis=1) if len(height) else np.zeros(0, dtype=np.int64)
    size = height[np.arange(len(height)), farthest]
    broad = (number >= 3) & (2 * area > np.maximum(tolerance, 2 * np.abs(size)) * perimeter)
    facing = Facing(face_a, face_b, size, place).chosen(broad)
    return facing.chosen(_are_real(blocks, facing, width))


def _are_real(blocks: Blocks, facing: Facing, width: float) -> np.ndarray:
    real = np.ones(len(facing.size), dtype=bool)
    normal = face_areas_normals_centroids(blocks)[1]
    owner, start = blocks.face_block(), blocks.face_start[blocks.block_face_start]
    for n in np.flatnonzero(facing.size < -width):
        for face in (facing.face_a[n], facing.face_b[n]):
            b = owner[face]
            corners = blocks.points[blocks.face_points[start[b] : start[b + 1]]]
            thickness = np.max((facing.place[n] - corners) @ normal[face])
            real[n] &= thickness > -2 * facing.size[n]
    gaping = np.flatnonzero(facing.size > width)
    middle = facing.place[gaping] + normal[facing.face_a[gaping]] * facing.size[gaping, None] / 2
    low, high = bounds(blocks)
    meeting = overlapping_boxes(np.concatenate([low, middle]), np.concatenate([high, middle]))
    meeting = meeting[(meeting[:, 0] < blocks.count) & (meeting[:, 1] >= blocks.count)]
    for b, n in meeting.tolist():
        gap = gaping[n - blocks.count]
        if b not in (owner[facing.face_a[gap]], owner[facing.face_b[gap]]):
            real[gap] &= not is_inside(solid(blocks, b), middle[n - blocks.count])
    return real


def described(blocks: Blocks, facing: Facing, names: Sequence[str]) -> list[str]:
    """A line for each of the worst pairs: size, names, place."""
    owner = blocks.face_block()
    lines = []
    for n in np.argsort(-np.abs(facing.size), kind="stable")[:LISTED]:
        kind = "gap" if facing.size[n] > 0 else "overlap"
        one, two = (names[owner[face[n]]] for face in (facing.face_a, facing.face_b))
        x, y, z = facing.place[n]
        lines.append(
            f"{kind} of {abs(facing.size[n]) * 1e3:.4g} mm between '{one}' and '{two}' at ({x:.4g}, {y:.4g}, {z:.4g}) m"
        )
    if len(facing.size) > LISTED:
        lines.append(f"and {len(facing.size) - LISTED} more")
    return lines


def require_small(blocks: Blocks, facing: Facing, names: Sequence[str], tolerance: float, open_gaps: bool) -> None:
    """Raise Unmended for gaps and overlaps larger than tolerance (m), with all others; gaps may be left as they are."""
    large = np.abs(facing.size) > tolerance * (1 + ALMOST) + 1e-9 * extent(blocks)
    if open_gaps:
        large &= facing.size < 0
    if not large.any():
        return
    worst = facing.chosen(large)
    gaps, overlaps = int(np.sum(worst.size > 0)), int(np.sum(worst.size < 0))
    said = [f"{n} {word}{'s' if n > 1 else ''}" for n, word in ((gaps, "gap"), (overlaps, "overlap")) if n]
    owner, lines = blocks.face_block(), described(blocks, worst, names)
    known = {(int(owner[f]), int(owner[g])) for f, g in zip(facing.face_a, facing.face_b, strict=True)}
    others = all_overlaps(blocks, names, tolerance, {pair for a, b in known for pair in ((a, b), (b, a))})
    largest = max([float(np.abs(worst.size).max()), *(overlap.depth for overlap in others)])
    raise Unmended(
        f"{' and '.join(said)} between facing faces, larger than the tolerance of {tolerance * 1e3:.4g} mm: "
        f"{'; '.join([*lines, *overlaps_described(blocks, others, names)])}",
        rounded_up(largest),
    )


def rounded_up(length: float) -> float:
    """The next length above (m) of two digits."""
    step = 10.0 ** (math.floor(math.log10(length)) - 1)
    return math.ceil(length / step + 1e-6) * step
