"""The proven stable step where blocks turn and deform: row sums by the norms of 3-vectors, from wherever one looks.

model/stable_step.py adds |K_ij| along x, y, z: true at the start, and no longer once a block has turned. Here every dof
that is a vector (a move, a column of H, a node) counts by its length, and K_ij by its 2-norm. max_i |x_i| is a norm
too, so w_max^2 <= max_i sum_j ||K_ij|| / m_i holds as Gershgorin's does, where the three masses of a vector are equal.
Then no turn changes the sums, neither of blocks nor of normals: levers about a rigid block's own axes keep their
length, and a material point's lever in a deforming block is its place at the start.

Assumed: every contact of the start counts as closed, with its largest stiffness; the two material points of a bond stay
within `slack` of each other; overlaps are small against levers (of the stiffness of turning normals, force over lever,
nothing is counted); no line of a block gets longer than `stretch` times its length, which `observe` tells.
St Venant-Kirchhoff: K(F) = (1 x F) K(1) (1 x F^T) + geometric part, so the first grows by no more than stretch^2; the
second is V S, and only tension adds to the highest frequency: S <= (3 lambda + 2 mu) (stretch^2 - 1) / 2.
`row_sums` takes the place of the sums of stable_step.py; `stable_step` and `scaled_masses` go on from there.
"""

import numpy as np

from masonry.model.kinds import KIND
from masonry.model.layout import DOFS, KINDS, Layout, tet_gradients, tet_volumes
from masonry.model.stable_step import BETWEEN, CHUNK, Side, unscale

STRETCH = 1.02
"""What no line is assumed to exceed: masonry breaks at a thousandth of that strain."""


def row_sums(
    layout: Layout,
    sides: tuple[Side, Side],
    stiffness: np.ndarray,
    lame: np.ndarray,
    length: np.ndarray,
    stretch: float = STRETCH,
    slack: float = 0.0,
) -> dict[str, np.ndarray]:
    """Row sums per kind, as `stable_step` and `scaled_masses` take them.

    stiffness  (C,) N/m, the larger of the normal and the shear stiffness of each contact, dilation included
    lame       (B, 2) Pa, of rigid blocks 0
    length     (B, 3) m, of `lengths`
    """
    sums = {kind: np.zeros((layout.rows(kind), DOFS[kind])) for kind in KINDS}
    contact_row_sums(sums, sides, stiffness, slack)
    affine_row_sums(sums["affine"], layout, lame[layout.members["affine"]], length, stretch)
    tet_row_sums(sums["tets"], layout, lame, stretch)
    unscale(sums, layout, length)
    return sums


def contact_row_sums(
    sums: dict[str, np.ndarray], sides: tuple[Side, Side], stiffness: np.ndarray, slack: float = 0.0
) -> None:
    """Add the contacts' share; stiffness (C,) N/m is the larger of normal and shear one, dilation included.

    A side moves by no more than the sum of its dofs' lengths, each times its lever over that dof's length.
    """
    both_levers = [levers(side, slack) for side in sides]
    both = stiffness * sum(1.0 + lever.sum(axis=1) for lever in both_levers)
    for side, lever in zip(sides, both_levers, strict=True):
        form = side.form
        for code, kind in enumerate(KINDS):
            which = np.flatnonzero(form == code)
            rotations = both[which, None] * lever[which]
            moves = np.repeat(both[which, None], 3, axis=1)
            per_column = {"rigid": rotations, "affine": np.tile(rotations, 3), "tets": rotations[:, :0]}[kind]
            np.add.at(sums[kind], side.row[which], np.concatenate([moves, per_column], axis=1))
        which = np.flatnonzero(form == BETWEEN)
        if len(which):
            assert side.corner is not None and side.fraction is not None
            fractions = side.fraction[which] * both[which, None]
            np.add.at(sums["tets"], side.corner[which], np.repeat(fractions[:, :, None], 3, axis=2))


def levers(side: Side, slack: float = 0.0) -> np.ndarray:
    """(C, 3) levers over the lengths of turns about a rigid block's axes, of columns of H; 0 for points of tets."""
    over_length = np.zeros(side.arm.shape)
    for code, kind in enumerate(KIND.values()):
        which = side.form == code
        over_length[which] = kind.levers(side.arm[which], side.length[which], slack)
    return over_length


def of_stretch(lame: np.ndarray, stretch: float) -> tuple[float, np.ndarray]:
    """By how much the material part of K grows, and the largest tension S (n,) Pa; lame (n, 2) Pa."""
    return stretch**2, (3.0 * lame[:, 0] + 2.0 * lame[:, 1]) * 0.5 * (stretch**2 - 1.0)


def affine_row_sums(
    sums: np.ndarray, layout: Layout, lame: np.ndarray, length: np.ndarray, stretch: float = STRETCH
) -> None:
    """Add the blocks' own stiffness to the rows of H; lame (b, 2) Pa of the affine blocks.

    Of two columns of H: V (lambda e_k e_l^T + mu e_l e_k^T + mu d_kl), of norm lambda + 2 mu or the larger of both.
    """
    which = layout.members["affine"]
    growth, tension = of_stretch(lame, stretch)
    norm = np.repeat(np.abs(lame).max(axis=1)[:, None, None], 9, axis=1).reshape(-1, 3, 3)
    norm[:, range(3), range(3)] = (lame[:, 0] + 2.0 * lame[:, 1])[:, None]
    own = length[which]
    rows = ((growth * norm + tension[:, None, None]) / own[:, None, :]).sum(axis=2) / own
    sums[:, 3:] += np.tile(rows * layout.volume[which][:, None], 3)


def tet_row_sums(sums: np.ndarray, layout: Layout, lame_of_block: np.ndarray, stretch: float = STRETCH) -> None:
    """Add the tets' share; lame_of_block (B, 2) Pa."""
    mesh = layout.mesh
    if mesh is None:
        return
    gradients, volumes = tet_gradients(mesh), tet_volumes(mesh)
    lame = np.repeat(lame_of_block, np.diff(mesh.tet_start), axis=0)
    growth, tension = of_stretch(lame, stretch)
    for first in range(0, len(volumes), CHUNK):
        chunk = slice(first, first + CHUNK)
        size = np.sqrt(np.einsum("tai,tai->ta", gradients[chunk], gradients[chunk]))
        lengths = size[:, :, None] * size[:, None, :]
        cosine = np.einsum("tai,tbi->tab", gradients[chunk], gradients[chunk]) / lengths
        norm = growth * pair_norm(lame[chunk, 0, None, None], lame[chunk, 1, None, None], np.clip(cosine, -1.0, 1.0))
        rows = ((norm + tension[chunk, None, None]) * lengths).sum(axis=2) * volumes[chunk, None]
        np.add.at(sums, mesh.tets[chunk], np.repeat(rows[:, :, None], 3, axis=2))


def pair_norm(lame: np.ndarray, mu: np.ndarray, cosine: np.ndarray) -> np.ndarray:
    """2-norm of lambda a b^T + mu b a^T + mu (a b) 1, for unit vectors a, b with a cosine between them."""
    sine_squared = 1.0 - cosine**2
    of_squares = ((lame + 2.0 * mu) * cosine) ** 2 + (lame**2 + mu**2) * sine_squared + (mu * cosine) ** 2
    det = mu * (lame + 2.0 * mu) * cosine**2 - lame * mu * sine_squared
    within = np.sqrt(0.5 * (of_squares + np.sqrt(np.maximum(of_squares**2 - 4.0 * det**2, 0.0))))
    return np.maximum(within, np.abs(mu * cosine))
