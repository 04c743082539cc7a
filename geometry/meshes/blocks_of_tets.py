"""Blocks from tets: connected parts of a group, their surface as faces, their nodes numbered block by block."""

from collections.abc import Sequence

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from geometry.blocks import Blocks, GeometryError, TetMesh
from geometry.joints.boundary import TET_FACES
from geometry.polyhedra.merged_faces import merged_faces

FLATTEST = 1e-12
"""Six times the volume of a tet over the cube of its longest edge, below which it has none."""


def blocks_of_tets(
    points: np.ndarray, tets: np.ndarray, group: np.ndarray, part: np.ndarray, names: Sequence[str]
) -> tuple[Blocks, TetMesh]:
    """One block for each set of tets (T, 4) that hang together over faces and agree in group and part (T,).

    points (P, 3) m. Blocks come in the order of their first tets; each is a unit of its own. Raises GeometryError for
    tets without volume and tets that overlap.
    """
    tets = _turned(points, tets)
    block, outer = _connected(tets, np.unique(np.stack([group, part]), axis=1, return_inverse=True)[1].ravel())
    count = int(block.max()) + 1
    mesh, number = _block_by_block(points, tets, block, count)
    face, of = outer
    faces, owner = merged_faces(mesh.nodes, number[face, TET_FACES[of].T].T, block[face])
    first = np.unique(block, return_index=True)[1]
    corner, used = np.unique(np.concatenate(faces), return_inverse=True)
    blocks = Blocks(
        points=mesh.nodes[corner],
        face_start=np.concatenate([[0], np.cumsum([len(loop) for loop in faces])]),
        face_points=used.astype(np.int64),
        block_face_start=np.searchsorted(owner, np.arange(count + 1)),
        unit=np.arange(count),
        group=group[first].astype(np.int64),
        groups=tuple(names),
    )
    return blocks, mesh


def _turned(points: np.ndarray, tets: np.ndarray) -> np.ndarray:
    """The tets with positive volume."""
    corner = points[tets]
    edge = corner[:, 1:] - corner[:, :1]
    volume = np.einsum("ti,ti->t", edge[:, 0], np.cross(edge[:, 1], edge[:, 2]))
    longest = np.linalg.norm(corner - np.roll(corner, 1, axis=1), axis=2).max(axis=1)
    flat = ~(np.abs(volume) > FLATTEST * longest**3)
    if flat.any():
        tet = int(np.argmax(flat))
        where = ", ".join(f"{x:.4g}" for x in corner[tet].mean(axis=0))
        raise GeometryError(f"{flat.sum()} tets have no volume; the first is tet {tet} at ({where}) m")
    turned = tets.copy()
    turned[volume < 0] = turned[volume < 0][:, [1, 0, 2, 3]]
    return turned


def _connected(tets: np.ndarray, label: np.ndarray) -> tuple[np.ndarray, tuple[np.ndarray, np.ndarray]]:
    """Block (T,) of every tet, and the surface: tet and number (0 to 3) of each face that a block has on one side."""
    face = tets[:, TET_FACES]
    sorted_face = np.sort(face, axis=2).reshape(-1, 3)
    after_lowest = (np.argmin(face, axis=2) + 1) % 3
    second = np.take_along_axis(face, after_lowest[:, :, None], axis=2)[:, :, 0]
    positive = (second == sorted_face.reshape(-1, 4, 3)[:, :, 1]).ravel()
    order = np.lexsort(sorted_face.T[::-1])
    ordered = sorted_face[order]
    same = np.all(ordered[1:] == ordered[:-1], axis=1)
    if np.any(same[1:] & same[:-1]):
        raise GeometryError("three tets share one face: some of them overlap")
    side_a, side_b = order[:-1][same], order[1:][same]
    if np.any(positive[side_a] == positive[side_b]):
        tet = int(side_a[np.argmax(positive[side_a] == positive[side_b])]) // 4
        raise GeometryError(f"tet {tet} overlaps the tet on its face, or is there twice")
    joined = label[side_a // 4] == label[side_b // 4]
    link = coo_array((np.ones(joined.sum()), (side_a[joined] // 4, side_b[joined] // 4)), shape=(len(tets),) * 2)
    part = connected_components(link, directed=False)[1]
    rank = np.argsort(np.argsort(np.unique(part, return_index=True)[1]))
    inside = np.zeros(len(tets) * 4, dtype=bool)
    inside[side_a[joined]] = inside[side_b[joined]] = True
    surface = np.flatnonzero(~inside)
    return rank[part], (surface // 4, surface % 4)


def _block_by_block(points: np.ndarray, tets: np.ndarray, block: np.ndarray, count: int) -> tuple[TetMesh, np.ndarray]:
    """The mesh in the order of blocks, and the new node numbers (T, 4) of the tets in their old order."""
    key = block[:, None] * len(points) + tets
    unique, number = np.unique(key, return_inverse=True)
    number = number.reshape(-1, 4).astype(np.int64)
    order = np.argsort(block, kind="stable")
    mesh = TetMesh(
        nodes=points[unique % len(points)],
        node_start=np.searchsorted(unique // len(points), np.arange(count + 1)),
        tets=number[order],
        tet_start=np.searchsorted(block[order], np.arange(count + 1)),
    )
    return mesh, number
