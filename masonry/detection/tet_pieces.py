"""The tets at the surface of meshed blocks as convex pieces, each a body of its own: a tet moves as an affine block.

So contacts between meshed blocks lie between true points of the two meshes, whose forces go to the nodes of the tets.
Faces within a block are inner ones: they are never contact faces, and have no edges.
"""

from typing import NamedTuple

import numpy as np

from geometry.blocks import TetMesh
from masonry.detection.convex_parts import Convex

FACES = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))
"""Corners of a tet's faces, counter-clockwise seen from outside."""


class SurfaceTets(NamedTuple):
    """T tets with a face on the surface of their block, in the order of the mesh.

    node   (T, 4) of the mesh           block  (T,)
    outer  (T, 4) which of FACES lie on the surface
    centre (T, 3) m                     slope  (T, 4, 3) 1/m, gradients of the shape functions
    """

    node: np.ndarray
    block: np.ndarray
    outer: np.ndarray
    centre: np.ndarray
    slope: np.ndarray


def surface_tets(mesh: TetMesh, slopes: np.ndarray) -> SurfaceTets:
    """The tets at the surface; slopes (tets, 4, 3) 1/m of all. No two blocks share a node."""
    loops = np.sort(mesh.tets[:, FACES], axis=2).reshape(-1, 3)
    _, same, count = np.unique(loops, axis=0, return_inverse=True, return_counts=True)
    outer = (count[same.reshape(-1)] == 1).reshape(-1, 4)
    which = np.flatnonzero(outer.any(axis=1))
    block = np.repeat(np.arange(len(mesh.tet_start) - 1), np.diff(mesh.tet_start))
    node = mesh.tets[which]
    return SurfaceTets(node, block[which], outer[which], mesh.nodes[node].mean(axis=1), slopes[which])


def as_pieces(tets: SurfaceTets, nodes: np.ndarray, first: int) -> list[tuple[int, Convex, list[bool]]]:
    """Body, corners and faces, and which faces are inner ones, of each tet; bodies are numbered from `first` on."""
    loops = [list(face) for face in FACES]
    return [
        (first + k, Convex(nodes[node], loops), (~outer).tolist())
        for k, (node, outer) in enumerate(zip(tets.node, tets.outer, strict=True))
    ]
