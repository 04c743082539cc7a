"""Small gaps and overlaps closed: facing faces go to a common plane and the corners of their blocks with them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from geometry.blocks import Blocks, GeometryError
from geometry.joints.find import find_joints
from geometry.joints.gaps import ALMOST, Facing, described, facing_faces, require_small
from geometry.polyhedra.convexity import outside
from geometry.polyhedra.flat.meeting import meet
from geometry.polyhedra.measures import extent, face_areas_normals_centroids, volumes
from geometry.polyhedra.overlaps import check_overlaps, least_allowed
from geometry.polyhedra.polygons import pad
from geometry.polyhedra.weld import weld

SUSPICIOUS = 10.0
"""Gaps up to so many times the tolerance are taken for mistakes."""
PASSES = 3
FARTHEST = 5.0
"""Times the tolerance that a corner may move: where faces meet at a flat angle it moves more than they do."""
NEAR = 1e-4
"""Of the width within which blocks touch: how near corners of more than three faces come to all of them."""


@dataclass(frozen=True)
class Mended:
    """Blocks without small gaps and overlaps; what was there; what is left on purpose; relative change of volumes; and
    by how much (m) blocks may still overlap at edges and corners."""

    blocks: Blocks
    gaps: Facing
    left: Facing
    volume_change: np.ndarray
    deepest: float = 0.0


def mend(blocks: Blocks, tolerance: float, names: Sequence[str], open_gaps: bool = False) -> Mended:
    """Close gaps and overlaps of up to tolerance (m) between faces that look at each other.

    All faces that meet in one joint go to the plane of their area-weighted mean; corners go to where their block's
    planes then meet. Blocks without such gaps stay as they are, bit for bit. Raises GeometryError for gaps and overlaps
    larger than the tolerance, up to ten times of it (open_gaps lets larger gaps be), for blocks that overlap still, for
    joints that would be lost, and for what cannot be mended; names (B,) says what to call each block.
    """
    width, most = 1e-9 * extent(blocks), tolerance * (1 + ALMOST)
    before = volumes(blocks)
    for n in range(PASSES):
        facing = facing_faces(blocks, SUSPICIOUS * tolerance, tolerance)
        require_small(blocks, facing, names, tolerance, open_gaps)
        off = np.abs(facing.size)
        small = (off > width) & (off <= most + width)
        if n == 0:
            first, against = facing.chosen(small), facing.chosen(off <= most + width)
        if not small.any():
            break
        blocks = _moved(blocks, facing.chosen(off <= most + width), tolerance, names, width)
    else:
        raise GeometryError("gaps and overlaps come back after they are mended; mend the solids in the CAD program")
    after = volumes(blocks)
    if np.any(after <= 0):
        raise GeometryError(f"'{names[int(np.argmin(after))]}' is thinner than its gaps; take a smaller tolerance")
    _require_convex(blocks, names, width)
    _require_joints(blocks, against, names, tolerance)
    check_overlaps(blocks, names, tolerance)
    left = facing.chosen(off > most + width)
    return Mended(blocks, first, left, after / before - 1, least_allowed(blocks, tolerance))


def _require_convex(blocks: Blocks, names: Sequence[str], width: float) -> None:
    """Raise GeometryError for a face that folded as its corners moved, as at an edge that is shorter than the gap."""
    corners, count = pad(blocks.points, blocks.face_start, blocks.face_points)
    off = outside(corners, count)
    f = int(np.argmax(off))
    if off[f] > width:
        raise _unmended(
            names[blocks.face_block()[f]],
            "its face at {} folds as its corners move",
            corners[f, : count[f]].mean(axis=0),
        )


def _require_joints(blocks: Blocks, against: Facing, names: Sequence[str], tolerance: float) -> None:
    """Raise GeometryError where two blocks that faced each other within the tolerance make no joint."""
    if not len(against.size):
        return
    owner, joints = blocks.face_block(), find_joints(blocks)
    pairs = owner[against.face_a] * blocks.count + owner[against.face_b]
    lost = ~np.isin(pairs, joints.block_a * blocks.count + joints.block_b)
    if lost.any():
        gone = against.chosen(lost)
        raise GeometryError(
            f"joints that would be lost: {len(np.unique(pairs[lost]))}, as gaps and overlaps are mended, of faces that "
            f"lie within the tolerance of {tolerance * 1e3:.4g} mm of each other: "
            f"{'; '.join(described(blocks, gone, names))}; mend the solids where they were made, or take a smaller "
            "tolerance"
        )


def _moved(blocks: Blocks, facing: Facing, tolerance: float, names: Sequence[str], width: float) -> Blocks:
    """The blocks with every cluster of facing faces in one plane."""
    plane = _planes(blocks, width)
    area, normal, centroid = face_areas_normals_centroids(blocks)
    owner = blocks.face_block()
    count = int(plane.max()) + 1
    link = coo_array((np.ones(len(facing.size)), (plane[facing.face_a], plane[facing.face_b])), shape=(count, count))
    cluster = connected_components(link, directed=False)[1]
    wrong = np.unique(cluster[plane[facing.face_a[np.abs(facing.size) > width]]])
    axis, offset = normal.copy(), np.einsum("fi,fi->f", normal, centroid)
    moving = np.zeros(len(area), dtype=bool)
    order = np.argsort(cluster[plane], kind="stable")
    ends = (
        np.searchsorted(cluster[plane][order], wrong, side="left"),
        np.searchsorted(cluster[plane][order], wrong, side="right"),
    )
    for begin, end in zip(*ends, strict=True):
        faces = order[begin:end]
        side = np.where(normal[faces] @ normal[faces[0]] > 0, 1.0, -1.0)
        mean = area[faces] @ (normal[faces] * side[:, None])
        mean /= np.linalg.norm(mean)
        level = float(area[faces] @ (centroid[faces] @ mean) / area[faces].sum())
        shift = np.abs(centroid[faces] @ mean - level)
        if shift.max() > tolerance:
            worst = owner[faces[np.argmax(shift)]]
            raise GeometryError(
                f"gaps and overlaps add up along {len(faces)} faces round '{names[worst]}': one plane for all would "
                f"move a face of it by {shift.max() * 1e3:.3g} mm, more than the tolerance; mend the solids "
                "where they were made"
            )
        axis[faces], offset[faces], moving[faces] = mean * side[:, None], level * side, True
    moved, met = _corners_moved(blocks, plane, axis, offset, moving, FARTHEST * tolerance, names, width)
    return moved if met else _met(blocks, moved, cluster[plane], FARTHEST * tolerance, names, width)


def _planes(blocks: Blocks, width: float) -> np.ndarray:
    """(F,) a number for each face, the same for faces of one block that lie in one plane and look the same way."""
    _, normal, centroid = face_areas_normals_centroids(blocks)
    corners, _ = pad(blocks.points, blocks.face_start, blocks.face_points)
    number = np.arange(len(normal))
    for b in range(blocks.count):
        faces = np.array(blocks.faces_of(b))
        alike = normal[faces] @ normal[faces].T > 0.999
        for i, j in np.argwhere(np.triu(alike, 1)).tolist():
            f, g = faces[i], faces[j]
            if np.abs((corners[g] - centroid[f]) @ normal[f]).max() <= width:
                number[g] = min(number[g], number[f])
    return number


def _corners_moved(
    blocks: Blocks,
    plane: np.ndarray,
    axis: np.ndarray,
    offset: np.ndarray,
    moving: np.ndarray,
    farthest: float,
    names: Sequence[str],
    width: float,
) -> tuple[Blocks, bool]:
    """Corners of moving faces at the least-squares meeting point of the planes of their faces, as near as can be; and
    whether all planes meet there."""
    points, owner = blocks.points[blocks.face_points].copy(), blocks.face_block()
    face_of = np.repeat(np.arange(len(plane)), np.diff(blocks.face_start))
    mine = np.flatnonzero(np.isin(owner, owner[moving])[face_of])
    first, vertex = _vertices(points[mine], owner[face_of[mine]], width)
    moves = np.zeros(len(first), dtype=bool)
    moves[vertex[moving[face_of[mine]]]] = True
    pair, corner = np.unique(vertex * len(plane) + plane[face_of[mine]], return_index=True)
    corner = corner[moves[pair // len(plane)]]
    faces, of = face_of[mine[corner]], vertex[corner]
    start = np.flatnonzero(np.diff(of, prepend=-1))
    count = np.diff(np.append(start, len(of)))
    old = points[mine[first]]
    lacking = offset[faces] - np.einsum("ni,ni->n", axis[faces], old[of])
    step, missed = np.zeros_like(old), np.zeros(len(old))
    for n in np.unique(count):
        rows = start[count == n][:, None] + np.arange(n)
        inverse = np.linalg.pinv(axis[faces[rows]], rcond=1e-3)
        step[of[rows[:, 0]]] = moves_by = np.einsum("nij,nj->ni", inverse, lacking[rows])
        missed[of[rows[:, 0]]] = np.abs(np.einsum("nji,ni->nj", axis[faces[rows]], moves_by) - lacking[rows]).max(
            axis=1
        )
    lost = (np.linalg.norm(step, axis=1) > farthest) | (missed > farthest)
    if lost.any():
        v = int(np.argmax(lost))
        raise _no_corner(names[owner[face_of[mine[first[v]]]]], int(np.sum(of == v)), old[v])
    there = moves[vertex]
    points[mine[there]] = (old + step)[vertex[there]]
    return replace(blocks, points=points, face_points=np.arange(len(points))), bool(missed.max() <= width)


def _vertices(points: np.ndarray, block: np.ndarray, width: float) -> tuple[np.ndarray, np.ndarray]:
    """Corners (N, 3) of blocks (N,) that lie together within a width are one vertex of their block: the first corner of
    each vertex (V,), and the vertex (N,) of each corner, in their order."""
    apart = block[:, None] * max(1.0, 1e3 * width)
    return weld(np.concatenate([points, apart], axis=1), width)


def _met(
    before: Blocks, blocks: Blocks, plane: np.ndarray, farthest: float, names: Sequence[str], width: float
) -> Blocks:
    """Blocks with a corner of more than three faces that fails to lie in all of them: corners and planes (F,) move
    until they agree. Each face corner of the blocks is a point of its own."""
    corners = np.diff(blocks.face_start[blocks.block_face_start])
    first, vertex = _vertices(before.points[before.face_points], np.repeat(np.arange(blocks.count), corners), width)
    place = np.zeros((len(first), 3))
    place[vertex] = blocks.points
    pair = np.unique(np.stack([vertex, np.repeat(plane, np.diff(blocks.face_start))]), axis=1)
    number = np.unique(pair[1], return_inverse=True)[1].reshape(-1)
    place, off = meet(place, pair[0], number, NEAR * width, NEAR * width)
    step = np.linalg.norm(place[vertex] - before.points[before.face_points], axis=1)
    if off.max() > width / 2 or step.max() > farthest:
        worst = int(np.argmax(step))
        b = int(np.searchsorted(np.cumsum(corners), worst, side="right"))
        raise _no_corner(names[b], int(np.sum(pair[0] == vertex[worst])), blocks.points[worst])
    return replace(blocks, points=place[vertex])


def _no_corner(name: str, faces: int, place: np.ndarray) -> GeometryError:
    return _unmended(name, f"its {faces} faces at {{}} do not meet in a corner any more", place)


def _unmended(name: str, why: str, place: np.ndarray) -> GeometryError:
    at = "({:.4g}, {:.4g}, {:.4g}) m".format(*place)
    return GeometryError(
        f"'{name}' cannot be mended: {why.format(at)}; mend it where it was made, or leave it by a smaller tolerance"
    )
