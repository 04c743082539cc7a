"""Small gaps and overlaps closed: facing faces go to a common plane and the corners of their blocks with them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from geometry.blocks import Blocks, GeometryError
from geometry.joints.gaps import Facing, facing_faces, require_small
from geometry.polyhedra.measures import extent, face_areas_normals_centroids, volumes
from geometry.polyhedra.overlaps import check_overlaps
from geometry.polyhedra.polygons import pad
from geometry.polyhedra.weld import weld

SUSPICIOUS = 10.0
"""Gaps up to so many times the tolerance are taken for mistakes."""
PASSES = 3
FARTHEST = 5.0
"""Times the tolerance that a corner may move: where faces meet at a flat angle it moves more than they do."""


@dataclass(frozen=True)
class Mended:
    """Blocks without small gaps and overlaps; what was there; what is left on purpose; relative change of volumes."""

    blocks: Blocks
    found: Facing
    left: Facing
    volume_change: np.ndarray


def mend(blocks: Blocks, tolerance: float, names: Sequence[str], open_gaps: bool = False) -> Mended:
    """Close gaps and overlaps of up to tolerance (m) between faces that look at each other.

    All faces that meet in one joint go to the plane of their area-weighted mean; corners go to where their block's
    planes then meet. Blocks without such gaps stay as they are, bit for bit. Raises GeometryError for gaps and overlaps
    larger than the tolerance, up to ten times of it (open_gaps lets larger gaps be), for blocks that overlap still, and
    for what cannot be mended; names (B,) says what to call each block.
    """
    width = 1e-9 * extent(blocks)
    before = volumes(blocks)
    first: Facing | None = None
    for _ in range(PASSES):
        facing = facing_faces(blocks, SUSPICIOUS * tolerance, tolerance)
        require_small(blocks, facing, names, tolerance, open_gaps)
        off = np.abs(facing.size)
        small = (off > width) & (off <= tolerance + width)
        first = facing.chosen(small) if first is None else first
        if not small.any():
            break
        blocks = _moved(blocks, facing.chosen(off <= tolerance + width), tolerance, names, width)
    else:
        raise GeometryError("gaps and overlaps come back after they are mended; mend the solids in the CAD program")
    after = volumes(blocks)
    if np.any(after <= 0):
        raise GeometryError(f"'{names[int(np.argmin(after))]}' is thinner than its gaps; take a smaller tolerance")
    check_overlaps(blocks, names)
    return Mended(blocks, first, facing.chosen(off > tolerance + width), after / before - 1)


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
    return _corners_moved(blocks, plane, axis, offset, moving, FARTHEST * tolerance, names, width)


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
) -> Blocks:
    """Corners of moving faces at the least-squares meeting point of the planes of their faces, as near as can be."""
    points = blocks.points[blocks.face_points].copy()
    face_of = np.repeat(np.arange(len(plane)), np.diff(blocks.face_start))
    for b in np.unique(blocks.face_block()[moving]).tolist():
        begin, end = (blocks.face_start[blocks.block_face_start[k]] for k in (b, b + 1))
        vertex = weld(points[begin:end], width)[1]
        for v in np.unique(vertex[moving[face_of[begin:end]]]):
            here = begin + np.flatnonzero(vertex == v)
            faces = face_of[here][np.unique(plane[face_of[here]], return_index=True)[1]]
            old = points[here[0]]
            lacking = offset[faces] - axis[faces] @ old
            step = np.linalg.pinv(axis[faces], rcond=1e-3) @ lacking
            if np.linalg.norm(step) > farthest or np.abs(axis[faces] @ step - lacking).max() > width:
                x, y, z = old
                raise GeometryError(
                    f"'{names[b]}' cannot be mended: its {len(faces)} faces at ({x:.4g}, {y:.4g}, {z:.4g}) m do not "
                    "meet in a corner any more; mend it where it was made, or leave it by a smaller tolerance"
                )
            points[here] = old + step
    return Blocks(
        points=points,
        face_start=blocks.face_start,
        face_points=np.arange(len(points)),
        block_face_start=blocks.block_face_start,
        unit=blocks.unit,
        group=blocks.group,
        groups=blocks.groups,
    )
