"""Blocks numbered by where they lie, whatever numbers they had: sums over them run in one order, to the same bits."""

from dataclasses import replace

import numpy as np

from geometry.blocks import Blocks, Specimen, TetMesh
from geometry.polyhedra.construct import selected
from geometry.polyhedra.measures import bounds, centroids, extent

LEVEL = 1e-6
"""Of the specimen's longest side: what lies nearer than that is level, so that rounding decides nothing in a wall."""


def by_place(blocks: Blocks) -> np.ndarray:
    """(B,) the blocks in order: the lowest first, along x and then y where they lie level.

    Boxes round the blocks decide, and where they are the same the centroids do.
    """
    low, high = (_level(corner, blocks) for corner in bounds(blocks))
    return np.lexsort((*_upwards(centroids(blocks)), *_upwards(high), *_upwards(low)))


def numbered_by_place(specimen: Specimen) -> Specimen:
    """The same specimen with its blocks in order, and points in that of the faces; units keep their numbers."""
    order = by_place(specimen.blocks)
    number = np.argsort(order)
    blocks = selected(specimen.blocks, order)
    _, first, point = np.unique(blocks.face_points, return_index=True, return_inverse=True)
    blocks = replace(
        blocks,
        points=blocks.points[blocks.face_points[np.sort(first)]],
        face_points=np.argsort(np.argsort(first))[point.reshape(-1)],
    )
    return replace(specimen, blocks=blocks, sets={name: np.sort(number[own]) for name, own in specimen.sets.items()})


def mesh_by_place(mesh: TetMesh, blocks: Blocks) -> TetMesh:
    """The mesh of these blocks in the order that `numbered_by_place` gives them, nodes by place and tets by nodes."""
    number = np.argsort(by_place(blocks))
    owner = number[np.repeat(np.arange(blocks.count), np.diff(mesh.node_start))]
    order = np.lexsort((*_upwards(mesh.nodes), *_upwards(_level(mesh.nodes, blocks)), owner))
    tets = np.argsort(order)[mesh.tets]
    turn = np.argsort(tets, axis=1)
    tets = np.take_along_axis(tets, turn, axis=1)
    odd = np.linalg.det(np.eye(4)[turn]) < 0.0
    tets[odd] = tets[odd][:, [0, 1, 3, 2]]
    owner, tets = owner[order], tets[np.lexsort(tets.T[::-1])]
    blocks_and_end = np.arange(blocks.count + 1)
    return TetMesh(
        nodes=mesh.nodes[order],
        node_start=np.searchsorted(owner, blocks_and_end),
        tets=tets,
        tet_start=np.searchsorted(owner[tets[:, 0]], blocks_and_end),
    )


def _level(points: np.ndarray, blocks: Blocks) -> np.ndarray:
    return np.round(points / (LEVEL * extent(blocks)))


def _upwards(points: np.ndarray) -> tuple[np.ndarray, ...]:
    """The keys of lexsort that put points (n, 3) in the order of z, then x, then y."""
    return points[:, 1], points[:, 0], points[:, 2]
