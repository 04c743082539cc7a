"""The edges of blocks that move apart: where the face beyond an edge goes on, and whether it still does."""

from dataclasses import dataclass

import numpy as np

from geometry.blocks import Blocks
from geometry.polyhedra.indexing import ranges
from geometry.polyhedra.measures import edges_by_place, face_areas_normals_centroids, volumes
from masonry.pictures.hidden_surfaces import BENT, SAME_PLANE

PARTED = 0.02
"""Share of the size of a block: two edges that are farther apart do not go on in one another."""


@dataclass(frozen=True)
class Continued:
    """The edges beyond which another face of the same unit goes on in the same plane before loading.

    An edge is numbered by its first corner in `Blocks.face_points`.

    following  (E,) the corner at the other end of each edge
    edge       (n,) an edge that goes on
    neighbour  (n,) the same edge as part of the face beyond it
    inner      (n,) whether both faces belong to one block
    reach      (n,) m, how far apart the two may be and still count as one
    """

    following: np.ndarray
    edge: np.ndarray
    neighbour: np.ndarray
    inner: np.ndarray
    reach: np.ndarray

    def kinds(self, blocks: Blocks) -> tuple[np.ndarray, np.ndarray]:
        """Of the edges (E,) of the same blocks, moved: which bound a unit or what is left of it, and which a block."""
        corner = blocks.points[blocks.face_points]
        middle = 0.5 * (corner + corner[self.following])
        together = np.linalg.norm(middle[self.edge] - middle[self.neighbour], axis=1) <= self.reach
        unit, block = np.ones(len(corner), dtype=bool), np.ones(len(corner), dtype=bool)
        unit[self.edge[together]] = False
        block[self.edge[self.inner]] = False
        return unit, block


def continued(blocks: Blocks) -> Continued:
    """The edges of blocks before loading that go on: in the same plane, or in one block with hardly a bend, as on the
    facets of a curved surface."""
    face, following, ends = edges_by_place(blocks)
    block = blocks.face_block()[face]
    key = np.unique(np.column_stack([ends, blocks.unit[block], blocks.group[block]]), axis=0, return_inverse=True)[1]
    order = np.argsort(key.ravel(), kind="stable")
    number = np.bincount(key.ravel())
    start = np.cumsum(number) - number
    edge, other = ranges(start[key.ravel()], number[key.ravel()])
    other = order[other]
    inner = block[edge] == block[other]
    normal = face_areas_normals_centroids(blocks)[1]
    cosine = np.einsum("ni,ni->n", normal[face[edge]], normal[face[other]])
    on = (edge != other) & (cosine > np.where(inner, BENT, SAME_PLANE))
    edge, other, inner = edge[on], other[on], inner[on]
    width = np.cbrt(volumes(blocks))
    return Continued(following, edge, other, inner, PARTED * np.minimum(width[block[edge]], width[block[other]]))
