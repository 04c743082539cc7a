"""Blocks that take up the same space: convex ones found by the separating axis theorem; refused with a message."""

from collections.abc import Iterator, Sequence
from itertools import islice

import numpy as np

from geometry.blocks import Blocks, GeometryError
from geometry.polyhedra.box_pairs import overlapping_boxes
from geometry.polyhedra.construct import selected
from geometry.polyhedra.intersect import are_convex, share_space, solid
from geometry.polyhedra.measures import bounds, extent, face_areas_normals_centroids, volumes
from geometry.polyhedra.polygons import pad

CHUNK = 4096


def check_overlaps(blocks: Blocks, names: Sequence[str] | None = None, allowed: float = 0.0) -> None:
    """Raise GeometryError for the first two blocks that overlap by more than 1e-9 of the specimen's size.

    names (B,) says what to call each block; without it, its number and unit. allowed: m that they may overlap by.
    """
    depth = max(1e-9 * extent(blocks), allowed)
    low, high = bounds(blocks)
    _require_thick(blocks, names, high - low, depth)
    pairs = overlapping_boxes(low + depth / 2, high - depth / 2)
    is_box = np.abs(volumes(blocks) / np.prod(high - low, axis=1) - 1) < 1e-12
    convex = np.ones(blocks.count, dtype=bool) if is_box.all() else are_convex(blocks, depth)
    sure = is_box[pairs].all(axis=1)
    overlapping = [tuple(pair) for pair in pairs[sure][:1]]
    overlapping += islice(overlapping_pairs(blocks, pairs[~sure], depth, convex), 1)
    if overlapping:
        a, b = min(overlapping)
        raise GeometryError(_message(blocks, names, low, high, a, b, allowed))


def overlapping_pairs(
    blocks: Blocks, pairs: np.ndarray, depth: np.ndarray | float, convex: np.ndarray
) -> Iterator[tuple[int, int]]:
    """Those of the pairs (N, 2) that overlap by more than a depth (N,) m, in order; convex (B,), as are_convex."""
    depth = np.broadcast_to(depth, len(pairs))
    both = convex[pairs].all(axis=1)
    apart = np.zeros(len(pairs), dtype=bool)
    apart[both] = widest_gaps(blocks, pairs[both])[0] >= -depth[both]
    for n in np.flatnonzero(~apart).tolist():
        a, b = map(int, pairs[n])
        if overlap(blocks, a, b, float(depth[n]), bool(both[n]))[0]:
            yield a, b


def overlap(blocks: Blocks, a: int, b: int, depth: float, convex: bool) -> tuple[bool, np.ndarray | None]:
    """Whether two blocks overlap by more than depth (m); if not, and both are convex, the axis that parts them best, a
    unit vector (3,) from a to b.
    """
    if not convex:
        return share_space(solid(blocks, a), solid(blocks, b), depth), None
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
    one, two = corners_a @ axes.T, corners_b @ axes.T
    forth, back = one.max(axis=0) - two.min(axis=0), two.max(axis=0) - one.min(axis=0)
    shift = np.minimum(forth, back)
    least = int(shift.argmin())
    return float(shift[least]), axes[least] * (1.0 if forth[least] <= back[least] else -1.0)


def _corners_and_edges(blocks: Blocks, block: int) -> tuple[np.ndarray, np.ndarray]:
    """The corners (K, 3) m of a block, and its edges (E, 3) m as vectors, each once."""
    faces = [blocks.face(f) for f in blocks.faces_of(block)]
    corners, number = np.unique(np.concatenate(faces), axis=0, return_inverse=True)
    number = number.reshape(-1)
    after = np.concatenate([np.roll(n, -1) for n in np.split(number, np.cumsum([len(face) for face in faces])[:-1])])
    low, high = np.unique(np.sort(np.stack([number, after]), axis=0), axis=1)
    return corners, corners[high] - corners[low]


def _message(
    blocks: Blocks, names: Sequence[str] | None, low: np.ndarray, high: np.ndarray, a: int, b: int, allowed: float
) -> str:
    start, end = np.maximum(low[a], low[b]), np.minimum(high[a], high[b])
    size, place = end - start, (start + end) / 2
    axis = int(np.argmin(size))
    called = [f"{names[i]!r}" if names is not None else f"{i} (unit {blocks.unit[i]})" for i in (a, b)]
    limit = f"overlap by no more than {allowed * 1e3:.4g} mm (--tolerance)" if allowed else "touch but not overlap"
    return (
        f"blocks {called[0]} and {called[1]} overlap by {size[0]:.4g} x {size[1]:.4g} x {size[2]:.4g} m around "
        f"({place[0]:.4g}, {place[1]:.4g}, {place[2]:.4g}) m; blocks may {limit}: "
        f"move one by {size[axis]:.4g} m along {'xyz'[axis]}, or make it that much smaller"
    )
