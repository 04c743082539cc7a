"""Rotational inertia of masses at the nodes of tets, beside that of the tets."""

import numpy as np

from geometry.blocks import TetMesh
from masonry.model.layout import tet_volumes


def inertia_excess(mesh: TetMesh, centroid: np.ndarray) -> np.ndarray:
    """(B,) by what share the polar moment of masses at the nodes, a quarter of each tet, is larger than that of the
    tets; 0 for blocks without. Of a tet it is V/20 (sum |r|^2 + |sum r|^2), at its corners V/4 sum |r|^2."""
    block = np.repeat(np.arange(len(centroid)), np.diff(mesh.tet_start))
    arm, volume = mesh.nodes[mesh.tets] - centroid[block][:, None], tet_volumes(mesh)
    squares = np.einsum("tki,tki->t", arm, arm)
    spread = (squares + np.sum(arm.sum(axis=1) ** 2, axis=1)) / 20.0
    lumped, exact = (np.bincount(block, volume * part, len(centroid)) for part in (squares / 4.0, spread))
    return np.asarray(np.divide(lumped - exact, exact, out=np.zeros_like(exact), where=exact > 0.0))
