"""Joints between faces that only nearly meet: of stones that touch nowhere exactly, of faces that are not flat.

The rule. Two faces of two blocks look at each other if their normals are opposite within an angle, and there are places
on both, one over the other, that are no more than a gap apart and no more than an overlap within each other. All such
pairs of two blocks whose mean planes agree, within the angle and the gap, make one joint in the plane that is their
mean by area. Its polygon is what the faces have in common as seen along the normal of this plane, where the distance is
within the limits; over a gap the convex hull of that, if it fills half of it. The contact points lie in it, half way
between the two blocks. What is not broader than the gap that it bridges, or than the overlap that is allowed, or has
another block in its gap, is no joint.
"""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from geometry.blocks import Blocks, JointPolygons
from geometry.polyhedra.box_pairs import overlapping_boxes
from geometry.polyhedra.intersect import is_inside, solid
from geometry.polyhedra.measures import bounds, extent
from geometry.polyhedra.polygons import areas_normals_centroids, clip, cut, pad, tidy, unpad

FULL, HALF = 0.98, 0.5
"""Share of its convex hull that pieces must fill to count as one polygon: where the blocks meet, and over a gap. In a
dry joint the hull bears what its pieces bear: the resultant may be anywhere within it."""
ROUNDS = 5
"""Times that the mean normal of a joint is taken of what lies within the angle of the last one."""
SAME = 1e-3
"""Share of its area that a polygon may lose or gain as its corners are tidied."""
SLIVER = 1e-6
"""Of a joint's area: smaller pieces are left out."""


@dataclass(frozen=True)
class Rule:
    """gap, overlap: m, of faces that make a joint; angle: rad between one normal and the other one reversed."""

    gap: float
    overlap: float
    angle: float


@dataclass(frozen=True)
class _Faces:
    """All faces, measured once: padded corners (F, K, 3), how many (F,), outward normals and centroids (F, 3)."""

    corners: np.ndarray
    count: np.ndarray
    normal: np.ndarray
    centroid: np.ndarray


@dataclass(frozen=True)
class _Pairs:
    """Faces over each other: numbers, axis from a to b (unit), a place halfway between, and area of what they share."""

    face_a: np.ndarray
    face_b: np.ndarray
    axis: np.ndarray
    place: np.ndarray
    area: np.ndarray


def nearby_joints(blocks: Blocks, rule: Rule) -> JointPolygons:
    """All joints of the blocks by the rule above, sorted by their blocks."""
    width = 1e-9 * extent(blocks)
    corners, count = pad(blocks.points, blocks.face_start, blocks.face_points)
    faces = _Faces(corners, count, *areas_normals_centroids(corners)[1:])
    owner = blocks.face_block()
    pairs = _pairs(faces, owner, rule, width)
    of = np.stack([owner[pairs.face_a], owner[pairs.face_b]], axis=1)
    polygons: list[tuple[int, int, np.ndarray, float, float]] = []
    order = np.lexsort((of[:, 1], of[:, 0]))
    ends = np.flatnonzero((of[order][1:] != of[order][:-1]).any(axis=1)) + 1
    for mine in np.split(order, ends):
        while len(mine):
            two = of[mine[0]]
            chosen, axis = _alike(pairs, mine, rule)
            mine = np.setdiff1d(mine, chosen)
            for polygon, least, most in _polygons(faces, pairs, chosen, axis, rule, width):
                polygons.append((int(two[0]), int(two[1]), polygon, least, most))
    return _without_blocks_between(blocks, _gathered(polygons), width)


def _pairs(faces: _Faces, owner: np.ndarray, rule: Rule, width: float) -> _Pairs:
    """The pairs of faces of the rule, of different owners (F,), each with the mean of their two normals as axis."""
    corners, normal = faces.corners, faces.normal
    reach = max(rule.gap, rule.overlap) / 2 + width
    two = overlapping_boxes(corners.min(axis=1) - reach, corners.max(axis=1) + reach)
    two = two[owner[two[:, 0]] != owner[two[:, 1]]]
    two = np.where((owner[two[:, 0]] > owner[two[:, 1]])[:, None], two[:, ::-1], two)
    facing = -np.einsum("ni,ni->n", normal[two[:, 0]], normal[two[:, 1]])
    two = two[facing >= np.cos(rule.angle) - 1e-12]
    axis = normal[two[:, 0]] - normal[two[:, 1]]
    axis /= np.linalg.norm(axis, axis=1)[:, None]
    over, count, gap = _shared(faces, two[:, 0], two[:, 1], axis, rule, width)
    area, _, middle = areas_normals_centroids(over)
    is_pair = (count >= 3) & (area > width**2)
    place = middle + 0.5 * gap.mean(axis=1)[:, None] * axis
    return _Pairs(two[is_pair, 0], two[is_pair, 1], axis[is_pair], place[is_pair], area[is_pair])


def _shared(
    faces: _Faces, face_a: np.ndarray, face_b: np.ndarray, axis: np.ndarray, rule: Rule, width: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Common part of faces (N,) seen along axes (N, 3), on the plane of face a: corners, count, the distances there."""
    corners, count, normal, centroid = faces.corners, faces.count, faces.normal, faces.centroid

    def flat(face: np.ndarray) -> np.ndarray:
        arm = corners[face] - centroid[face_a][:, None]
        return np.asarray(corners[face] - np.einsum("nki,ni->nk", arm, axis)[:, :, None] * axis[:, None])

    def height(over: np.ndarray, face: np.ndarray) -> np.ndarray:
        across = np.einsum("nki,ni->nk", centroid[face][:, None] - over, normal[face])
        return np.asarray(across / np.einsum("ni,ni->n", axis, normal[face])[:, None])

    over, number = clip(flat(face_a), count[face_a], flat(face_b), -axis, width)
    for limit, sign in ((rule.gap, 1.0), (rule.overlap, -1.0)):  # how far apart, how far into each other
        over, number = cut(over, number, limit + width - sign * (height(over, face_b) - height(over, face_a)))
    over, number = tidy(over, number, width)
    below, above = height(over, face_a), height(over, face_b)
    return over + below[:, :, None] * axis[:, None], number, above - below


def _alike(pairs: _Pairs, mine: np.ndarray, rule: Rule) -> tuple[np.ndarray, np.ndarray]:
    """Those of the pairs that lie in one plane with the largest of them, and the normal of this plane."""
    axis, area, place = pairs.axis[mine], pairs.area[mine], pairs.place[mine]
    largest = int(np.argmax(area))
    normal, middle = axis[largest], place[largest]
    within = np.zeros(len(mine), dtype=bool)
    for _ in range(ROUNDS):
        off = np.abs((place - middle) @ normal)
        within = (axis @ normal >= np.cos(rule.angle)) & (off <= max(rule.gap, rule.overlap))
        within[largest] = True
        mean = area[within] @ axis[within]
        normal = mean / np.linalg.norm(mean)
        middle = area[within] @ place[within] / area[within].sum()
    return mine[within], normal


def _polygons(
    faces: _Faces, pairs: _Pairs, chosen: np.ndarray, normal: np.ndarray, rule: Rule, width: float
) -> list[tuple[np.ndarray, float, float]]:
    """The polygons of one joint, counter-clockwise about its normal, each with its least and its greatest gap."""
    axes = np.broadcast_to(normal, (len(chosen), 3))
    over, count, gap = _shared(faces, pairs.face_a[chosen], pairs.face_b[chosen], axes, rule, width)
    area, _, middle = areas_normals_centroids(over)
    is_part = (count >= 3) & (area > SLIVER * area.sum())
    if not is_part.any():
        return []
    over, count, gap, area, middle = over[is_part], count[is_part], gap[is_part], area[is_part], middle[is_part]
    halfway = np.einsum("nki,i->nk", over, normal) + 0.5 * gap
    used = np.arange(over.shape[1]) < count[:, None]
    level = float(area @ np.array([h[u].mean() for h, u in zip(halfway, used, strict=True)]) / area.sum())
    over = over + (level - np.einsum("nki,i->nk", over, normal))[:, :, None] * normal
    pieces = [polygon[mine] for polygon, mine in zip(over, used, strict=True)]
    limits = [(float(g[u].min()), float(g[u].max())) for g, u in zip(gap, used, strict=True)]
    mean = float(area @ [(a + b) / 2 for a, b in limits] / area.sum())
    if len(pieces) > 1:
        hull = _hull(np.concatenate(pieces), normal)
        least = HALF if max(b for _, b in limits) > rule.overlap else FULL
        if hull is not None and area.sum() >= least * float(areas_normals_centroids(hull[None])[0][0]):
            pieces, limits = [hull], [(min(a for a, _ in limits), max(b for _, b in limits))]
    together = pieces[0] if len(pieces) == 1 else _hull(np.concatenate(pieces), normal)
    if together is None or not _is_broad(together, max(mean, rule.overlap, width)):
        return []
    pieces = [_tidied(piece, rule.overlap, width) for piece in pieces]
    return [(piece, *limit) for piece, limit in zip(pieces, limits, strict=True) if len(piece) >= 3]


def _is_broad(polygon: np.ndarray, least: float) -> bool:
    """Twice the area over the perimeter is about the lesser side of a polygon."""
    area = float(areas_normals_centroids(polygon[None])[0][0])
    perimeter = float(np.linalg.norm(np.roll(polygon, -1, axis=0) - polygon, axis=1).sum())
    return 2 * area > least * perimeter


def _tidied(polygon: np.ndarray, overlap: float, width: float) -> np.ndarray:
    """Without corners that lie on each other or on a straight edge: within the overlap, if the area stays."""
    area = float(areas_normals_centroids(polygon[None])[0][0])
    for tolerance in (overlap, width):
        corners, count = tidy(polygon[None], np.array([len(polygon)]), tolerance)
        if abs(float(areas_normals_centroids(corners)[0][0]) - area) <= SAME * area:
            return corners[0, : count[0]]
    return polygon


def _hull(points: np.ndarray, normal: np.ndarray) -> np.ndarray | None:
    """The convex hull of points (n, 3) of a plane, counter-clockwise about its normal; None where it has no area."""
    across = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    across /= np.linalg.norm(across)
    flat = (points - points[0]) @ np.stack([across, np.cross(normal, across)], axis=1)
    try:
        return np.asarray(points[ConvexHull(flat).vertices])
    except QhullError:
        return None


def _gathered(polygons: list[tuple[int, int, np.ndarray, float, float]]) -> JointPolygons:
    start = np.cumsum([0, *(len(polygon) for _, _, polygon, _, _ in polygons)])
    return JointPolygons(
        block_a=np.array([a for a, *_ in polygons], dtype=np.int64),
        block_b=np.array([b for _, b, *_ in polygons], dtype=np.int64),
        start=start.astype(np.int64),
        points=np.concatenate([polygon for _, _, polygon, _, _ in polygons]) if polygons else np.zeros((0, 3)),
        gap=np.array([[least, most] for *_, least, most in polygons]).reshape(-1, 2),
    )


def _without_blocks_between(blocks: Blocks, joints: JointPolygons, width: float) -> JointPolygons:
    """Those without another block in the middle of their gap."""
    is_free = np.ones(len(joints.block_a), dtype=bool)
    wide = np.flatnonzero(joints.gap[:, 1] > width)
    if len(wide) == 0:
        return joints
    polygon, _ = pad(joints.points, joints.start, np.arange(len(joints.points)))
    middle = areas_normals_centroids(polygon)[2][wide]
    low, high = bounds(blocks)
    meeting = overlapping_boxes(np.concatenate([low, middle]), np.concatenate([high, middle]))
    meeting = meeting[(meeting[:, 0] < blocks.count) & (meeting[:, 1] >= blocks.count)]
    for b, n in meeting.tolist():
        j = wide[n - blocks.count]
        if b not in (joints.block_a[j], joints.block_b[j]) and is_inside(solid(blocks, b), middle[n - blocks.count]):
            is_free[j] = False
    corners, count = pad(joints.points, joints.start, np.arange(len(joints.points)))
    start, points = unpad(corners[is_free], count[is_free])
    return JointPolygons(joints.block_a[is_free], joints.block_b[is_free], start, points, joints.gap[is_free])
