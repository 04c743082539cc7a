"""Blocks that take up the same space: convex ones found by the separating axis theorem; refused with a message."""

from collections.abc import Collection, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from geometry.blocks import Blocks, GeometryError
from geometry.polyhedra.box_pairs import overlapping_boxes
from geometry.polyhedra.construct import selected
from geometry.polyhedra.intersect import TABLE, ConvexSolid, are_convex, moved, shared_place, solid
from geometry.polyhedra.measures import bounds, extent, face_areas_normals_centroids, volumes
from geometry.polyhedra.polygons import areas_normals_centroids, cut, pad

CHUNK = 4096
THIN = 0.49
"""Of the side of a box: what is taken off either end at most, where blocks may overlap by more than they are thick."""
LISTED = 5
"""Overlaps that a message shows, the deepest first."""
SAME = 1e-3
"""Of size, volume and surface: by how much two blocks that are one and the same may differ."""
MEASURED, MOST_FACES = 6, 400
"""Overlaps of blocks that are not convex, and faces of two blocks, up to which moves in all directions are tried."""
NEARLY = 1e-2
"""Of the size of a block: how far a corner may stand out of the plane of a face of a block that is convex but for
noise."""
DIRECTIONS, HALVINGS = 24, 12
"""Normals of faces along which a block that is not convex is moved out of another one; how often a move is halved."""


class Overlap(NamedTuple):
    """Two blocks that share space. They part if the second moves by depth (m) along axis, a unit vector (3,): no move
    that is tried is shorter. place (3,) m: where."""

    first: int
    second: int
    depth: float
    axis: np.ndarray
    place: np.ndarray


class Overlapping(GeometryError):
    """Blocks that overlap, with all their overlaps."""

    def __init__(self, message: str, overlaps: Sequence[Overlap]) -> None:
        super().__init__(message)
        self.overlaps = tuple(overlaps)


def check_overlaps(blocks: Blocks, names: Sequence[str] | None = None, allowed: float = 0.0) -> None:
    """Raise Overlapping, a GeometryError, where blocks overlap by more than 1e-9 of the specimen's size.

    names (B,) says what to call each block; without it, its number and unit. allowed: m that they may overlap by.
    """
    if overlaps := all_overlaps(blocks, names, allowed):
        limit = f"overlap by no more than {allowed * 1e3:.4g} mm (--tolerance)" if allowed else "touch but not overlap"
        lines = "; ".join(described(blocks, overlaps, names))
        raise Overlapping(f"{lines}; blocks may {limit}", overlaps)


def all_overlaps(
    blocks: Blocks, names: Sequence[str] | None = None, allowed: float = 0.0, known: Collection[tuple[int, int]] = ()
) -> list[Overlap]:
    """All overlaps, the deepest first, but for those of pairs that are known; see check_overlaps. Raises GeometryError
    for a block that is too thin."""
    depth = max(1e-9 * extent(blocks), allowed)
    low, high = bounds(blocks)
    _require_thick(blocks, names, high - low, 1e-9 * extent(blocks))
    rim = np.minimum(depth / 2, THIN * (high - low))
    pairs = overlapping_boxes(low + rim, high - rim)
    if known:
        pairs = pairs[[pair not in known for pair in map(tuple, pairs.tolist())]]
    is_box = np.abs(volumes(blocks) / np.prod(high - low, axis=1) - 1) < 1e-12
    convex = np.ones(blocks.count, dtype=bool) if is_box.all() else are_convex(blocks, depth)
    sure = is_box[pairs].all(axis=1)
    overlaps = [overlap for a, b in pairs[sure].tolist() if (overlap := _of_boxes(low, high, a, b)).depth > depth]
    for a, b, place in overlapping_pairs(blocks, pairs[~sure], depth, convex):
        closely = len(overlaps) < MEASURED
        overlaps.append(
            _of_convex(blocks, a, b) if place is None else _of_solids(blocks, a, b, place, depth if closely else None)
        )
    return sorted(overlaps, key=lambda overlap: -overlap.depth)


def least_allowed(blocks: Blocks, maximum: float) -> float:
    """By how much (m) blocks must be allowed to overlap so that none is refused: 0 or a power of ten below
    `maximum` (m), at which none is."""
    depth = 1e-9 * extent(blocks)
    low, high = bounds(blocks)
    levels = (maximum * 10.0**-k for k in range(6, 0, -1))
    for deep in (depth, *(level for level in levels if level > depth)):
        rim = np.minimum(deep / 2, THIN * (high - low))
        pairs = overlapping_boxes(low + rim, high - rim)
        convex = are_convex(blocks, deep)  # more blocks the deeper, so pairs that passed at less are looked at again
        if next(overlapping_pairs(blocks, pairs, deep, convex), None) is None:
            return deep if deep > depth else 0.0
    return maximum


def described(blocks: Blocks, overlaps: Sequence[Overlap], names: Sequence[str] | None) -> list[str]:
    """A line for each of the deepest overlaps: blocks, depth, place, and the least move that parts the two."""
    lines = []
    for first, second, depth, axis, place in overlaps[:LISTED]:
        name_a, name_b = (
            f"{names[i]!r}" if names is not None else f"{i} (unit {blocks.unit[i]})" for i in (first, second)
        )
        if _are_one(blocks, first, second):
            lines.append(f"{name_a} and {name_b} are the same block twice: leave one of them out")
            continue
        x, y, z = place
        lines.append(
            f"blocks {name_a} and {name_b} overlap by {depth * 1e3:.4g} mm around ({x:.4g}, {y:.4g}, {z:.4g}) m: "
            f"moving {name_b} by {depth * 1e3:.4g} mm along {_direction(axis)} parts them"
        )
    if len(overlaps) > LISTED:
        lines.append(f"and {len(overlaps) - LISTED} pairs more, by less")
    return lines


def _are_one(blocks: Blocks, a: int, b: int) -> bool:
    """Whether two blocks have the same box around them, the same volume and the same surface."""
    both = selected(blocks, np.array([a, b]))
    (low, high), area = bounds(both), face_areas_normals_centroids(both)[0]
    difference = max(float(np.abs(np.diff(ends, axis=0)).max()) for ends in (low, high))
    sums = np.stack([volumes(both), np.add.reduceat(area, both.block_face_start[:-1])])
    return difference <= SAME * float((high - low).max()) and bool(np.all(np.abs(np.diff(sums)) <= SAME * sums[:, :1]))


def _direction(axis: np.ndarray) -> str:
    """An axis in words."""
    k = int(np.argmax(np.abs(axis)))
    if abs(axis[k]) > 1 - 1e-6:
        return f"{'-' if axis[k] < 0 else ''}{'xyz'[k]}"
    return "({:.3g}, {:.3g}, {:.3g})".format(*(axis + 0.0))


def _of_boxes(low: np.ndarray, high: np.ndarray, a: int, b: int) -> Overlap:
    """The overlap of two boxes along the axes."""
    forth, back = high[a] - low[b], high[b] - low[a]
    k = int(np.argmin(np.minimum(forth, back)))
    axis = np.eye(3)[k] * (1.0 if forth[k] <= back[k] else -1.0)
    place = (np.maximum(low[a], low[b]) + np.minimum(high[a], high[b])) / 2
    return Overlap(a, b, float(min(forth[k], back[k])), axis, place)


def _of_convex(blocks: Blocks, a: int, b: int) -> Overlap:
    """The overlap of two convex blocks; its place is the middle of what each has of its surface within the other."""
    depth, axis = _penetration(blocks, a, b)
    weight, moment = 0.0, np.zeros(3)
    for block, other in ((a, b), (b, a)):
        start = blocks.face_start[blocks.block_face_start[block] : blocks.block_face_start[block + 1] + 1]
        corners, count = pad(blocks.points, start, blocks.face_points)
        window = solid(blocks, other)
        for face, normal in zip(window.faces, window.normals, strict=True):
            corners, count = cut(corners, count, (face[0] - corners) @ normal)
        area, _, middle = areas_normals_centroids(corners)
        weight, moment = weight + float(area.sum()), moment + area @ middle
    return Overlap(a, b, depth, axis, moment / weight if weight > 0 else _middle_of_boxes(blocks, a, b))


def _middle_of_boxes(blocks: Blocks, a: int, b: int) -> np.ndarray:
    low, high = bounds(selected(blocks, np.array([a, b])))
    return np.asarray((low.max(axis=0) + high.min(axis=0)) / 2)


def _of_solids(blocks: Blocks, a: int, b: int, place: np.ndarray, depth: float | None) -> Overlap:
    """The overlap of two blocks that need not be convex, which share a place: the least move along an axis that parts
    their hulls, or, where it is looked at closely (depth), along the normal of a face that parts them."""
    penetration, axis = _penetration(blocks, a, b)
    if depth is None:
        return Overlap(a, b, penetration, axis, place)
    body_a, body_b = solid(blocks, a), solid(blocks, b)
    normals = np.concatenate([body_a.normals, -body_b.normals])
    if len(normals) > MOST_FACES or (_is_nearly_convex(body_a) and _is_nearly_convex(body_b)):
        return Overlap(a, b, penetration, axis, place)
    _, first = np.unique(np.round(normals, 3), axis=0, return_index=True)
    for normal in normals[np.sort(first)][:DIRECTIONS]:
        if _part(body_a, body_b, (1 - 1e-3) * penetration * normal, depth):
            penetration, axis = _shortest(body_a, body_b, normal, penetration, depth), normal
    return Overlap(a, b, penetration, axis, place)


def _is_nearly_convex(shape: ConvexSolid) -> bool:
    """Whether a solid is convex but for noise: its hull tells then how deep it is in another one."""
    corners = np.concatenate(shape.faces)
    height = corners @ shape.normals.T - np.array(
        [face.mean(axis=0) @ n for face, n in zip(shape.faces, shape.normals, strict=True)]
    )
    return float(height.max()) <= NEARLY * float(np.ptp(corners, axis=0).max())


def _part(first: ConvexSolid, second: ConvexSolid, step: np.ndarray, depth: float) -> bool:
    """Whether the second solid, moved by a step (3,) m, is out of the first one."""
    return shared_place(first, moved(second, step), depth) is None


def _shortest(first: ConvexSolid, second: ConvexSolid, normal: np.ndarray, longest: float, depth: float) -> float:
    """The shortest move (m) along a normal that parts two solids, found by halving."""
    low, high = 0.0, longest
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if _part(first, second, middle * normal, depth) else (middle, high)
    return high


def overlapping_pairs(
    blocks: Blocks, pairs: np.ndarray, depth: np.ndarray | float, convex: np.ndarray
) -> Iterator[tuple[int, int, np.ndarray | None]]:
    """Those of the pairs (N, 2) that overlap by more than a depth (N,) m, in order, each with a place (3,) m where they
    do unless both are convex; convex (B,), as are_convex."""
    depth = np.broadcast_to(depth, len(pairs))
    both = convex[pairs].all(axis=1)
    apart = np.zeros(len(pairs), dtype=bool)
    apart[both] = widest_gaps(blocks, pairs[both])[0] >= -depth[both]
    apart[~both] = _gaps_of_hulls(blocks, pairs[~both]) >= -depth[~both]
    for n in np.flatnonzero(~apart).tolist():
        a, b = map(int, pairs[n])
        if both[n]:
            if _penetration(blocks, a, b)[0] > depth[n]:
                yield a, b, None
        elif (place := shared_place(solid(blocks, a), solid(blocks, b), float(depth[n]))) is not None:
            yield a, b, place


def overlap(blocks: Blocks, a: int, b: int, depth: float, convex: bool) -> tuple[bool, np.ndarray | None]:
    """Whether two blocks overlap by more than depth (m); if not, and both are convex, the axis that parts them best, a
    unit vector (3,) from a to b.
    """
    if not convex:
        return shared_place(solid(blocks, a), solid(blocks, b), depth) is not None, None
    shift, axis = _penetration(blocks, a, b)
    return shift > depth, axis


def _require_thick(blocks: Blocks, names: Sequence[str] | None, size: np.ndarray, depth: float) -> None:
    """Blocks thinner than what counts as touching can neither touch nor overlap."""
    thickness = size.min(axis=1)
    if not np.all(thickness > depth):
        b = int(np.argmin(np.where(np.isfinite(thickness), thickness, -1.0)))
        what = names[b] if names else f"block {b} (unit {blocks.unit[b]})"
        raise GeometryError(
            f"{what} is {thickness[b]:.3g} m thin in a specimen of {extent(blocks):.4g} m; it must be more than "
            f"{depth:.3g} m"
        )


def widest_gaps(blocks: Blocks, pairs: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(N,) m the widest gap that a face of one block leaves to the whole other one, below 0 where no face parts them;
    and (N,) the number of that face.
    """
    widest, facing = np.full(len(pairs), -np.inf), np.zeros(len(pairs), dtype=np.int64)
    if len(pairs) == 0:
        return widest, facing
    which, number = np.unique(pairs, return_inverse=True)
    few, pairs = selected(blocks, which), number.reshape(-1, 2)
    _, face_normal, face_centroid = face_areas_normals_centroids(few)
    faces = np.arange(len(face_normal))
    face, _ = pad(faces[:, None], few.block_face_start, faces)
    face = face[:, :, 0]
    normal = face_normal[face]
    offset = np.einsum("bfi,bfi->bf", normal, face_centroid[face])
    corners, _ = pad(few.points, few.face_start[few.block_face_start], few.face_points)
    face += (blocks.block_face_start[which] - few.block_face_start[:-1])[:, None]
    for begin in range(0, len(pairs), CHUNK):
        for a, b in (pairs[begin : begin + CHUNK].T, pairs[begin : begin + CHUNK, ::-1].T):
            gap = np.einsum("pfi,pki->pfk", normal[a], corners[b]).min(axis=2) - offset[a]
            best = gap.argmax(axis=1)
            wider = np.flatnonzero(gap.max(axis=1) > widest[begin : begin + CHUNK])
            widest[begin + wider] = gap[wider, best[wider]]
            facing[begin + wider] = face[a[wider], best[wider]]
    return widest, facing


def _gaps_of_hulls(blocks: Blocks, pairs: np.ndarray) -> np.ndarray:
    """(N,) m the widest gap between blocks, convex or not, along the normals of faces of both; below 0 without any."""
    widest = np.full(len(pairs), -np.inf)
    if len(pairs) == 0:
        return widest
    which, number = np.unique(pairs, return_inverse=True)
    few, pairs = selected(blocks, which), number.reshape(-1, 2)
    normals = face_areas_normals_centroids(few)[1]
    normal = pad(normals, few.block_face_start, np.arange(len(normals)))[0]
    corners, _ = pad(few.points, few.face_start[few.block_face_start], few.face_points)
    farthest = np.stack([(corners[b] @ normal[b].T).max(axis=0) for b in range(few.count)])
    chunk = max(1, TABLE // (normal.shape[1] * corners.shape[1]))
    for begin in range(0, len(pairs), chunk):
        for a, b in (pairs[begin : begin + chunk].T, pairs[begin : begin + chunk, ::-1].T):
            gap = np.einsum("pfi,pki->pfk", normal[a], corners[b]).min(axis=2) - farthest[a]
            np.maximum(widest[begin : begin + chunk], gap.max(axis=1), out=widest[begin : begin + chunk])
    return widest


def _penetration(blocks: Blocks, a: int, b: int) -> tuple[float, np.ndarray]:
    """Least shift (m) that parts two convex blocks along any separating axis, face normals and crossed edges; and that
    axis (3,), from a to b.
    """
    (corners_a, edges_a), (corners_b, edges_b) = (_corners_and_edges(blocks, block) for block in (a, b))
    normals = face_areas_normals_centroids(selected(blocks, np.array([a, b])))[1]
    axes = np.concatenate([normals, np.cross(edges_a[:, None], edges_b[None]).reshape(-1, 3)])
    length = np.linalg.norm(axes, axis=1)
    good = length > 1e-12 * length.max()
    axes = axes[good] / length[good, None]
    heights_a, heights_b = corners_a @ axes.T, corners_b @ axes.T
    forth, back = heights_a.max(axis=0) - heights_b.min(axis=0), heights_b.max(axis=0) - heights_a.min(axis=0)
    shift = np.minimum(forth, back)
    axis = int(shift.argmin())
    return float(shift[axis]), axes[axis] * (1.0 if forth[axis] <= back[axis] else -1.0)


def _corners_and_edges(blocks: Blocks, block: int) -> tuple[np.ndarray, np.ndarray]:
    """The corners (K, 3) m of a block, and its edges (E, 3) m as vectors, each once."""
    faces = [blocks.face(f) for f in blocks.faces_of(block)]
    corners, number = np.unique(np.concatenate(faces), axis=0, return_inverse=True)
    number = number.reshape(-1)
    after = np.concatenate([np.roll(n, -1) for n in np.split(number, np.cumsum([len(face) for face in faces])[:-1])])
    low, high = np.unique(np.sort(np.stack([number, after]), axis=0), axis=1)
    return corners, corners[high] - corners[low]
