"""Blocks that start in motion: their velocities on the dofs."""

import numpy as np

from masonry.model.kinds import KIND
from masonry.model.layout import Layout


def velocities_of(
    layout: Layout, kind: str, rows: np.ndarray, velocity: np.ndarray, spin: np.ndarray, about: np.ndarray
) -> np.ndarray:
    """(n, dofs) of a rigid motion on rows of a kind: velocity (3,) m/s of the point `about` (3,) m, and spin (3,)
    rad/s, in the dofs that v of these bodies has.

    Rigid: velocity of the centroid along x, y, z, spin about the block's principal axes. Affine: velocity of the
    centroid, then the rate of the gradient, rows along x, y, z and columns along the principal axes. Tets: velocity of
    each node.
    """
    moves = velocity + np.cross(spin, layout.place[kind][rows] - about)
    rates = KIND[kind].spin(layout.axes[layout.owner[kind][rows]], spin)
    return np.concatenate([moves, rates], axis=1)
