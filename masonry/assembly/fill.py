"""The weight of loose earth above blocks, up to a level: a dead load on the faces that look up to it.

Earth is a column above each face: it presses straight down, by its height there. It does not press sideways, holds
nothing and carries nothing; of a fill that does, this is the safe side.
"""

import numpy as np

from geometry.blocks import Blocks, Joints, Specimen
from geometry.joints.covered import covered_shares
from geometry.polyhedra.measures import face_areas_normals_centroids
from masonry.errors import SceneError
from masonry.model.layout import KINDS, Layout
from masonry.model.loads import add_gravity
from masonry.scene.tables.loading import Fill

UPWARD, COVERED = 1e-6, 1e-6
"""Cosine above which a face looks up; the share of it that lies in joints, above which it bears no earth."""


def weight_of_fill(
    fill: Fill, where: str, specimen: Specimen, joints: Joints, layout: Layout, chosen: np.ndarray, gravity: float
) -> dict[str, np.ndarray | None]:
    """The load by kind; gravity: m/s2, > 0. Raises SceneError where the level is below all, and for blocks of tets."""
    blocks, load = specimen.blocks, dict.fromkeys(KINDS)
    if (layout.kind[chosen] == KINDS.index("tets")).any():
        raise SceneError(f"{where}.on = '{fill.on}': a fill acts on rigid and affine blocks, not on tets")
    faces = _open_faces(blocks, joints, chosen, f"{where}.on = '{fill.on}'")
    force, moment = _columns(blocks, layout.centroid, faces, fill.level)
    if not force.any():
        raise SceneError(
            f"{where}.level: no free face of '{fill.on}' looks up below {fill.level:.6g} m; raise the level"
        )
    weight = fill.density * gravity
    down = np.array([0.0, 0.0, -weight])
    add_gravity(layout, load, force / layout.volume, down)
    for b in np.flatnonzero(force):
        kind, row = KINDS[layout.kind[b]], layout.local[b]
        array = load[kind]
        assert array is not None
        if kind == "rigid":
            array[row, 3:] += layout.axes[b].T @ np.cross(moment[b], down)
        else:
            array[row, 3:] += np.outer(down, layout.axes[b].T @ moment[b]).ravel()
    return load


def _open_faces(blocks: Blocks, joints: Joints, chosen: np.ndarray, where: str) -> np.ndarray:
    """The free faces of these blocks that look up. SceneError for one that a joint covers in part."""
    _, normal, _ = face_areas_normals_centroids(blocks)
    owner = blocks.face_block()
    up = np.flatnonzero((normal[:, 2] > UPWARD) & np.isin(owner, chosen))
    covered = covered_shares(blocks, joints)[up]
    partly = up[(covered > COVERED) & (covered < 1.0 - COVERED)]
    if len(partly):
        raise SceneError(
            f"{where}: a face of block {owner[partly[0]]} that looks up lies under another block in part; name "
            "blocks that bear the fill alone"
        )
    return up[covered <= COVERED]


def _columns(blocks: Blocks, centroid: np.ndarray, faces: np.ndarray, level: float) -> tuple[np.ndarray, np.ndarray]:
    """(B,) m3 of earth above each block, and (B, 3) m4, its first moment about the centroid, taken at the faces.

    Exact: over a triangle the height is linear, and the middles of its edges integrate its product with an arm.
    """
    owner = blocks.face_block()
    volume, moment = np.zeros(blocks.count), np.zeros((blocks.count, 3))
    for f in faces.tolist():
        polygon = _below(blocks.points[blocks.face_points[blocks.face_start[f] : blocks.face_start[f + 1]]], level)
        for k in range(1, len(polygon) - 1):
            corner = polygon[[0, k, k + 1]]
            flat = 0.5 * np.cross(corner[1] - corner[0], corner[2] - corner[0])[2]
            middle = 0.5 * (corner + np.roll(corner, -1, axis=0))
            columns = flat / 3.0 * (level - middle[:, 2])
            volume[owner[f]] += columns.sum()
            moment[owner[f]] += columns @ (middle - centroid[owner[f]])
    return volume, moment


def _below(polygon: np.ndarray, level: float) -> np.ndarray:
    """What of a polygon (n, 3) lies below a level (m)."""
    kept = []
    for one, other in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        if one[2] <= level:
            kept.append(one)
        if (one[2] - level) * (other[2] - level) < 0.0:
            kept.append(one + (level - one[2]) / (other[2] - one[2]) * (other - one))
    return np.array(kept).reshape(-1, 3)
