"""How good blocks, joints and tets are: what is shortest, smallest and flattest, and which block to blame.

All measures take time in proportion to the number of faces, joints or tets.
"""

from dataclasses import dataclass

import numpy as np

from geometry.blocks import Blocks, Joints, TetMesh
from geometry.polyhedra.measures import volumes
from geometry.polyhedra.polygons import areas_normals_centroids, pad


@dataclass(frozen=True)
class Worst:
    """The worst value of a measure, the blocks it belongs to, and its ratio to the usual value.

    value  m, m2 or m3; a tet's radius ratio has no unit      blocks  one, or the two of a joint
    """

    value: float
    blocks: tuple[int, ...]
    ratio: float = 1.0


@dataclass(frozen=True)
class Quality:
    """None where there is nothing to measure.

    shortest_edge        of a block; ratio to h, the edge of a cube with the mean volume of the blocks of its group
    smallest_block       the least volume over the mean of its group
    shortest_joint_edge  of an overlap polygon; ratio to the smaller h of its two blocks
    smallest_joint       area of an overlap polygon; ratio to the smaller h^2 of its two blocks
    flattest_tet         3 inradius / circumradius, 1 for the regular tet
    """

    shortest_edge: Worst
    smallest_block: Worst
    shortest_joint_edge: Worst | None
    smallest_joint: Worst | None
    flattest_tet: Worst | None


def quality(blocks: Blocks, joints: Joints, mesh: TetMesh | None = None) -> Quality:
    """Measures of a specimen with one block at least."""
    volume = volumes(blocks)
    mean = (np.bincount(blocks.group, volume) / np.maximum(np.bincount(blocks.group), 1))[blocks.group]
    size = np.cbrt(mean)
    edge = _edges(blocks.points[blocks.face_points], blocks.face_start)
    owner = np.repeat(blocks.face_block(), np.diff(blocks.face_start))
    return Quality(
        shortest_edge=_worst(edge, size[owner], owner[:, None], int(np.argmin(edge))),
        smallest_block=_worst(volume, mean, np.arange(blocks.count)[:, None], int(np.argmin(volume / mean))),
        shortest_joint_edge=_joint_edge(joints, size),
        smallest_joint=_joint_area(joints, size),
        flattest_tet=_flattest(mesh),
    )


def radius_ratios(mesh: TetMesh) -> np.ndarray:
    """(T,) 3 inradius / circumradius: 1 for the regular tet, 0 for a flat one."""
    corner = mesh.nodes[mesh.tets]
    a, b, c = (corner[:, k] - corner[:, 0] for k in (1, 2, 3))
    ab, bc, ca = np.cross(a, b), np.cross(b, c), np.cross(c, a)
    volume = np.abs(np.einsum("ti,ti->t", a, bc)) / 6
    surface = sum(np.linalg.norm(vector, axis=1) for vector in (ab, bc, ca, ab + bc + ca)) / 2
    squares = (np.einsum("ti,ti->t", edge, edge)[:, None] for edge in (a, b, c))
    centre = np.linalg.norm(sum(square * vector for square, vector in zip(squares, (bc, ca, ab), strict=True)), axis=1)
    return 108 * volume**2 / (surface * centre)  # inradius 3 V / surface, circumradius |centre| / (12 V)


def _edges(corner: np.ndarray, start: np.ndarray) -> np.ndarray:
    """Length of the edge that begins at each corner of polygons one after another."""
    following = np.arange(1, len(corner) + 1)
    following[start[1:] - 1] = start[:-1]
    return np.linalg.norm(corner[following] - corner, axis=1)


def _worst(value: np.ndarray, usual: np.ndarray, blocks: np.ndarray, worst: int) -> Worst:
    return Worst(float(value[worst]), tuple(blocks[worst].tolist()), float(value[worst] / usual[worst]))


def _sides(joints: Joints) -> np.ndarray:
    """(J, 2) blocks of each overlap polygon."""
    sides = np.zeros((len(joints.patch_start) - 1, 2), dtype=np.int64)
    sides[joints.patch] = np.stack([joints.block_a, joints.block_b], axis=1)
    return sides


def _joint_edge(joints: Joints, size: np.ndarray) -> Worst | None:
    if len(joints.area) == 0:
        return None
    sides = np.repeat(_sides(joints), np.diff(joints.patch_start), axis=0)
    edge = _edges(joints.patch_points, joints.patch_start)
    return _worst(edge, size[sides].min(axis=1), sides, int(np.argmin(edge)))


def _joint_area(joints: Joints, size: np.ndarray) -> Worst | None:
    if len(joints.area) == 0:
        return None
    corners, _ = pad(joints.patch_points, joints.patch_start, np.arange(len(joints.patch_points)))
    area, sides = areas_normals_centroids(corners)[0], _sides(joints)
    return _worst(area, size[sides].min(axis=1) ** 2, sides, int(np.argmin(area)))


def _flattest(mesh: TetMesh | None) -> Worst | None:
    if mesh is None or len(mesh.tets) == 0:
        return None
    ratio = radius_ratios(mesh)
    worst = int(np.argmin(ratio))
    return Worst(float(ratio[worst]), (int(np.searchsorted(mesh.tet_start, worst, side="right")) - 1,))
