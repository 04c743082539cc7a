"""Bonds: contacts with strength left, between material points, in a frame that turns with the block on side a.

The law sees what it sees in small displacement: d = R^T (x_b - x_a), split along the normal of the undeformed shape,
where R turns with side a. Its force, turned forward by R, acts on both blocks at the material point of side b. So the
forces derive from the energy that the law books, and no couple is left: with d held in the frame of a, the rate of d is
the velocity of b less that of a at one and the same point.
"""

from typing import NamedTuple

import numpy as np

from masonry.jit.compiler import inner


class Bonds(NamedTuple):
    """What C bonds need besides the arrays of contacts, which hold displacements and forces in the frame of side a.

    rows    (C, 2) rows of u of both sides
    frames  (B, 3, 3) rotation of each block; of one that deforms, that of its polar decomposition
    owner   (C,) block of side a: row of `frames`
    u       (S, 3) m, displacement of the material points from the start
    force   (C, 3) N on side a
    apart   (C, 3) m, u_b - u_a
    alive   (C,) whether the bond holds; the law of one that does not sees no more motion, and books nothing more
    """

    rows: np.ndarray
    frames: np.ndarray
    owner: np.ndarray
    u: np.ndarray
    force: np.ndarray
    apart: np.ndarray
    alive: np.ndarray


@inner
def to_frames(bonds, ranges, local):
    """Write the displacement of side b against side a, in the frame of a, to row 1 + c of `local` (1 + C, 3).

    ranges  (2 G,) first contact of each group with strength, and the one behind its last
    """
    rows, frames, owner, u, apart, alive = bonds.rows, bonds.frames, bonds.owner, bonds.u, bonds.apart, bonds.alive
    for g in range(len(ranges) // 2):
        for c in range(ranges[2 * g], ranges[2 * g + 1]):
            if not alive[c]:
                continue
            a, b, f = rows[c, 0], rows[c, 1], owner[c]
            x, y, z = u[b, 0] - u[a, 0], u[b, 1] - u[a, 1], u[b, 2] - u[a, 2]
            apart[c, 0], apart[c, 1], apart[c, 2] = x, y, z
            for i in range(3):
                local[1 + c, i] = frames[f, 0, i] * x + frames[f, 1, i] * y + frames[f, 2, i] * z


@inner
def from_frames(bonds, ranges, local):
    """Turn the forces (C, 3) of the law, in the frames of side a, to x, y, z."""
    frames, owner, force, alive = bonds.frames, bonds.owner, bonds.force, bonds.alive
    for g in range(len(ranges) // 2):
        for c in range(ranges[2 * g], ranges[2 * g + 1]):
            if not alive[c]:
                continue
            f = owner[c]
            x, y, z = local[c, 0], local[c, 1], local[c, 2]
            for i in range(3):
                force[c, i] = frames[f, i, 0] * x + frames[f, i, 1] * y + frames[f, i, 2] * z
