"""The weight of loose earth above blocks, up to a level: a dead load on the faces that look up to it.

Earth is a column above each face: it presses straight down, by its height there. It does not press sideways, holds
nothing and carries nothing; of a fill that does, this is the safe side. Where masses are real, each column moves with
the block below it.
"""

from typing import NamedTuple

import numpy as np

from geometry.blocks import Blocks, Joints, Specimen
from geometry.joints.covered import covered_fractions
from geometry.polyhedra.measures import face_areas_normals_centroids
from geometry.polyhedra.polygons import cut, pad
from masonry.errors import SceneError
from masonry.model.layout import KINDS, Layout
from masonry.model.loads import add_force
from masonry.scene.tables.loads_and_supports import Fill

UPWARD, COVERED = 1e-6, 1e-6
"""Cosine above which a face looks up; the share of it that lies in joints, above which it bears no earth."""


class Columns(NamedTuple):
    """Earth above faces that look up: owner (F,), the block below; volume (F,) m3; centre (F, 3) m, of its pressure."""

    owner: np.ndarray
    volume: np.ndarray
    centre: np.ndarray


def columns_of(fill: Fill, where: str, specimen: Specimen, joints: Joints, chosen: np.ndarray) -> Columns:
    """Those of a fill on some blocks (n,). Raises SceneError where the level is below all of them."""
    blocks = specimen.blocks
    faces = open_faces(blocks, joints, chosen, f"{where}.on = '{fill.on}'")
    volume, centre = _volumes(blocks, faces, fill.level)
    if not volume.any():
        raise SceneError(
            f"{where}.level: no free face of '{fill.on}' looks up below {fill.level:.6g} m; raise the level"
        )
    under = volume > 0.0
    return Columns(blocks.face_block()[faces[under]], volume[under], centre[under])


def weight_of(columns: Columns, layout: Layout, specific: float) -> dict[str, np.ndarray | None]:
    """The load by kind; specific: weight of the earth, N/m3, > 0."""
    load, down = dict.fromkeys(KINDS), np.array([0.0, 0.0, -specific])
    for block, volume, centre in zip(columns.owner.tolist(), columns.volume, columns.centre, strict=True):
        add_force(layout, load, block, volume * down, centre - layout.centroid[block])
    return load


def open_faces(blocks: Blocks, joints: Joints, chosen: np.ndarray, where: str) -> np.ndarray:
    """The free faces of these blocks that look up. SceneError for one that a joint covers in part."""
    _, normal, _ = face_areas_normals_centroids(blocks)
    owner = blocks.face_block()
    up = np.flatnonzero((normal[:, 2] > UPWARD) & np.isin(owner, chosen))
    covered = covered_fractions(blocks, joints)[up]
    partly = up[(covered > COVERED) & (covered < 1.0 - COVERED)]
    if len(partly):
        raise SceneError(
            f"{where}: a face of block {owner[partly[0]]} that looks up lies under another block in part; name "
            "blocks that bear the fill alone"
        )
    return up[covered <= COVERED]


def _volumes(blocks: Blocks, faces: np.ndarray, level: float) -> tuple[np.ndarray, np.ndarray]:
    """(F,) m3 of earth above each face, and (F, 3) m, where on the face it presses.

    Exact: over a triangle the height is linear, and the middles of its edges integrate its product with a place.
    """
    corners, count = (array[faces] for array in pad(blocks.points, blocks.face_start, blocks.face_points))
    corners, count = cut(corners, count, level - corners[:, :, 2])
    first = np.broadcast_to(corners[:, :1], corners[:, 1:-1].shape)
    triangle = np.stack([first, corners[:, 1:-1], corners[:, 2:]], axis=2)
    flat = 0.5 * np.cross(triangle[:, :, 1] - triangle[:, :, 0], triangle[:, :, 2] - triangle[:, :, 0])[:, :, 2]
    middle = 0.5 * (triangle + np.roll(triangle, -1, axis=2))
    columns = flat[:, :, None] / 3.0 * (level - middle[..., 2])
    volume = np.where(count > 2, columns.sum(axis=(1, 2)), 0.0)
    moment = np.einsum("ftm,ftmi->fi", columns, middle)
    return volume, moment / np.where(volume > 0.0, volume, 1.0)[:, None]
