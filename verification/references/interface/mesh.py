"""Tets of several blocks in one mesh, numbered so that facets on two sides of a joint list their corners alike."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree
from skfem import MeshTet

Array = np.ndarray
SAME = 1e-8
"""Of the extent of the mesh: points nearer than this coincide."""


@dataclass(frozen=True)
class TetSolid:
    """Blocks made of tets; a point where blocks meet is there once for each of them.

    mesh    scikit-fem's     block  (T,) of each tet
    place   (P,) number of the place of each vertex: the same for vertices of different blocks that coincide
    number  (P,) the mesh's number of each node as it was given
    """

    mesh: MeshTet
    block: Array
    place: Array
    number: Array


def solid(nodes: Array, tets: Array, block: Array) -> TetSolid:
    """From nodes (P, 3) m, each of one block only, tets (T, 4) and their blocks (T,).

    Vertices are numbered by place, then by block: scikit-fem sorts the corners of a facet by number, so the two facets
    of a joint have coinciding corners in the same order, and their quadrature points coincide.
    """
    near = cKDTree(nodes).query_pairs(SAME * np.ptp(nodes, axis=0).max(), output_type="ndarray")
    links = coo_matrix((np.ones(len(near)), (near[:, 0], near[:, 1])), shape=(len(nodes), len(nodes)))
    _, place = connected_components(links, directed=False)
    owner = np.zeros(len(nodes), dtype=np.int64)
    owner[tets] = block[:, None]
    order = np.lexsort((owner, place))
    number = np.argsort(order)
    mesh = MeshTet(np.ascontiguousarray(nodes[order].T), np.ascontiguousarray(number[tets].T))
    return TetSolid(mesh, np.asarray(block), place[order], number)


def grids(axes: list[tuple[Array, Array, Array]]) -> TetSolid:
    """Boxes divided into bricks by planes at x, y and z (m), one tuple a block; each brick is six tets."""
    nodes, tets, block, start = [], [], [], 0
    for b, (x, y, z) in enumerate(axes):
        part = MeshTet.init_tensor(np.asarray(x), np.asarray(y), np.asarray(z))
        nodes.append(part.p.T)
        tets.append(part.t.T + start)
        block.append(np.full(part.t.shape[1], b))
        start += part.p.shape[1]
    return solid(np.concatenate(nodes), np.concatenate(tets), np.concatenate(block))


def facet_pairs(body: TetSolid) -> tuple[Array, Array, Array]:
    """Facets (F,) of side a and of side b that lie on each other, and the blocks (F, 2) they belong to, a < b."""
    outer = body.mesh.boundary_facets()
    block = body.block[body.mesh.f2t[0, outer]]
    key = np.sort(body.place[body.mesh.facets[:, outer]], axis=0)
    order = np.lexsort((block, key[2], key[1], key[0]))
    same = np.flatnonzero(np.all(key[:, order[1:]] == key[:, order[:-1]], axis=0))
    a, b = order[same], order[same + 1]
    return outer[a], outer[b], np.stack([block[a], block[b]], axis=1)
