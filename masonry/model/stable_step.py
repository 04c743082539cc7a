"""The proven stable time step: row sums of |K| (Gershgorin) over contacts, affine blocks and tets; eq. (11) by name.

For a diagonal mass matrix w_max^2 <= max_i sum_j |K_ij| / m_i, so dt <= 2/w_max holds at dt = 2 min sqrt(m_i/S_i).
Local damping lowers the limit: a dof answers with up to (1 + xi) F, so dt is divided by sqrt(1 + xi).
Turns and strains are scaled by a length along their axis, so that the sums add like to like.

Dashpots C act on velocities half a step old. Of M (v+ - v-) = -dt (K x + C v-) the energy
(v+ (M - dt C / 2 - dt^2 K / 4) v+ + x K x) / 2, x halfway between two steps, only falls; so a step is stable where
4 m_i >= 2 dt sum_j |C_ij| + dt^2 sum_j |K_ij| (`with_dashpots`). Of one oscillator with C = a1 K, z = a1 w / 2, that is
dt <= (2/w) (sqrt(1 + z^2) - z). A Maxwell branch, a spring r K with a dashpot behind it, is no stiffer than the spring.

Where dashpots make the step short it falls as C grows, and row sums of C are several times too large. Any diagonal D
with x C x <= x D x serves in their place. Sides of a contact move by v = J x, J the columns of the dofs of a body, and
with k (3, 3) its dashpot (v_b - v_a) k (v_b - v_a) <= 2 v_a k v_a + 2 v_b k v_b. So C <= blockdiag(2 C_b), with C_b the
sum of J^T k J over the contacts of a body b; and 2 C_b <= mu_b M_b, mu_b the largest eigenvalue of M_b^-1 2 C_b. So
D = mu_b m_i for each dof i of a body (`block_rates`). Of a point between nodes, v = sum of N_j v_j, v k v <= sum of
N_j v_j k v_j: a node gets 2 N_j k, and the row sums of nodes are no less. Where blocks turn, k is the same in all
directions, and so C_b about a block's own axes is what it was.
"""

from dataclasses import dataclass

import numpy as np

from geometry.jit_cache import compiled
from masonry.model.kinds import KIND
from masonry.model.layout import DOFS, KINDS, Layout, tet_gradients, tet_volumes

CHUNK = 8192
BETWEEN = len(KINDS)
"""Form of a side whose point lies between tet nodes, in a triangle of them; the other forms are the kinds."""
SOFTEST = 1e-3
"""No row sum is taken smaller than this share of the block's largest (a dof that nothing resists needs a mass)."""


@dataclass(frozen=True)
class Side:
    """One side of all contacts: kind of its body, row of its dofs, arm from the centroid along the block's axes.

    corner, fraction  (C, 3) nodes and shape functions of points between tet nodes, as in Joints; None without any
    """

    kind: np.ndarray
    row: np.ndarray
    arm: np.ndarray
    axes: np.ndarray
    length: np.ndarray
    corner: np.ndarray | None = None
    fraction: np.ndarray | None = None

    @property
    def form(self) -> np.ndarray:
        """(C,) kind of the body, or BETWEEN."""
        if self.corner is None:
            return self.kind
        return np.where(self.corner[:, 0] >= 0, BETWEEN, self.kind)

    def columns(self, kind: int, which: np.ndarray) -> np.ndarray:
        """(c, 3, n) displacement of the point for a unit of each dof, turns and strains divided by their length."""
        identity = np.broadcast_to(np.eye(3), (len(which), 3, 3))
        if kind == BETWEEN:
            assert self.fraction is not None
            return np.einsum("cj,ik->cijk", self.fraction[which], np.eye(3)).reshape(len(which), 3, 9)
        beyond = KIND[KINDS[kind]].columns(self.arm[which], self.axes[which], self.length[which])
        return np.concatenate([identity, beyond], axis=2)


def lengths(layout: Layout, block: np.ndarray, arm: np.ndarray) -> np.ndarray:
    """(B, 3) m along each axis of a block: the larger of its radius of gyration and the rms arm of its contacts."""
    count = np.bincount(block, minlength=len(layout.kind))[:, None]
    square = np.column_stack([np.bincount(block, arm[:, k] ** 2, minlength=len(layout.kind)) for k in range(3)])
    return np.sqrt(np.maximum(square / np.maximum(count, 1), layout.moment / layout.volume[:, None]))


def contact_row_sums(
    sums: dict[str, np.ndarray], sides: tuple[Side, Side], normal: np.ndarray, kn: np.ndarray, ks: np.ndarray
) -> None:
    """Add the contacts' share; kn, ks (C,) N/m are stiffnesses times area, kn with dilation included.

    A point between nodes, u = sum of N_j u_j with N_j >= 0 that add up to 1, gives node i a row of N_i k (1 + sum N_j),
    N_i times that of a point on a node: the bound needs no other proof.
    """
    a, b = sides
    pair = a.form * (BETWEEN + 1) + b.form
    for code in np.unique(pair):
        chosen = np.flatnonzero(pair == code)
        kinds = code // (BETWEEN + 1), code % (BETWEEN + 1)
        for first in range(0, len(chosen), CHUNK):
            which = chosen[first : first + CHUNK]
            n = normal[which]
            stiffness = np.einsum("c,ij->cij", ks[which], np.eye(3))
            stiffness += np.einsum("c,ci,cj->cij", kn[which] - ks[which], n, n)
            move_a, move_b = a.columns(kinds[0], which), b.columns(kinds[1], which)
            move = np.concatenate([-move_a, move_b], axis=2)
            row = np.abs(np.einsum("cki,ckl,clj->cij", move, stiffness, move, optimize=True)).sum(axis=2)
            split = move_a.shape[2]
            for side, kind, part in ((a, kinds[0], row[:, :split]), (b, kinds[1], row[:, split:])):
                if kind == BETWEEN:
                    assert side.corner is not None
                    np.add.at(sums["tets"], side.corner[which], part.reshape(-1, 3, 3))
                else:
                    np.add.at(sums[KINDS[kind]], side.row[which], part)


def affine_row_sums(sums: np.ndarray, layout: Layout, lame: np.ndarray, length: np.ndarray) -> None:
    """Add the blocks' own stiffness, V sigma : H, to the rows of H; lame (b, 2) Pa of the affine blocks."""
    which = layout.members["affine"]
    if len(which) == 0:
        return
    d = np.eye(3)
    axes = layout.axes[which]
    # C_ijkl = lambda d_ij d_kl + mu (d_ik d_jl + d_il d_jk), j and l taken along the block's axes
    bulk = np.einsum("cij,ckl->cijkl", axes, axes)
    shear = np.einsum("ik,jl->ijkl", d, d)[None] + np.einsum("cil,ckj->cijkl", axes, axes)
    stiffness = lame[:, 0, None, None, None, None] * bulk + lame[:, 1, None, None, None, None] * shear
    own = length[which]
    rows = (np.abs(stiffness) / own[:, None, None, None, :]).sum(axis=(3, 4)) / own[:, None, :]
    sums[:, 3:] += rows.reshape(len(which), 9) * layout.volume[which][:, None]


def tet_row_sums(sums: np.ndarray, layout: Layout, lame_of_block: np.ndarray) -> None:
    """Add the tets' share; lame_of_block (B, 2) Pa."""
    mesh = layout.mesh
    if mesh is None:
        return
    gradients, volumes = tet_gradients(mesh), tet_volumes(mesh)
    lame = np.repeat(lame_of_block, np.diff(mesh.tet_start), axis=0) * volumes[:, None]
    _add_rows_of_tets(sums, mesh.tets, gradients, lame)


@compiled
def _add_rows_of_tets(sums, tets, gradients, lame):
    """Add sum_bj |lambda g_ai g_bj + mu g_aj g_bi + mu g_a g_b d_ij| to row i of node a of each tet (T, 4), of which
    the gradients g (T, 4, 3) and Lame constants times volume (T, 2) are; as NumPy adds twelve numbers."""
    size = np.empty(12)
    for t in range(len(tets)):
        g, bulk, shear = gradients[t], lame[t, 0], lame[t, 1]
        for a in range(4):
            for i in range(3):
                for b in range(4):
                    for j in range(3):
                        k = bulk * (g[a, i] * g[b, j]) + shear * (g[a, j] * g[b, i])
                        if i == j:
                            k += shear * (g[a, 0] * g[b, 0] + g[a, 1] * g[b, 1] + g[a, 2] * g[b, 2])
                        size[4 * j + b] = abs(k)
                row = ((size[0] + size[1]) + (size[2] + size[3])) + ((size[4] + size[5]) + (size[6] + size[7]))
                sums[tets[t, a], i] += (((row + size[8]) + size[9]) + size[10]) + size[11]


def unscale(sums: dict[str, np.ndarray], layout: Layout, length: np.ndarray) -> None:
    """Turn the sums of scaled dofs into what their masses are compared with; floor what nothing resists."""
    for kind in ("rigid", "affine"):
        rows = sums[kind]
        if len(rows):
            np.maximum(rows, SOFTEST * rows.max(axis=1, keepdims=True), out=rows)
            rows[:, 3:] *= KIND[kind].lengths(length[layout.members[kind]]) ** 2
    if len(sums["tets"]):
        np.maximum(sums["tets"], SOFTEST * sums["tets"].max(), out=sums["tets"])


def add_block_matrices(
    matrices: dict[str, np.ndarray], side: Side, normal: np.ndarray, kn: np.ndarray, ks: np.ndarray
) -> None:
    """Add J^T k J of one side of the contacts to those of its blocks (rows, n, n), J the columns of scaled dofs."""
    for code, kind in enumerate(matrices):
        chosen = np.flatnonzero(side.form == code)
        for first in range(0, len(chosen), CHUNK):
            which = chosen[first : first + CHUNK]
            move = side.columns(code, which)
            along = np.einsum("ck,cki->ci", normal[which], move)
            each = np.einsum("c,cki,ckj->cij", ks[which], move, move, optimize=True)
            each += np.einsum("c,ci,cj->cij", kn[which] - ks[which], along, along, optimize=True)
            np.add.at(matrices[kind], side.row[which], each)


def block_matrices(layout: Layout) -> dict[str, np.ndarray]:
    """(rows, n, n) of zeros for the kinds that move as a whole, in the order of their codes."""
    kinds = [kind for kind in KINDS if not KIND[kind].nodal]
    return {kind: np.zeros((layout.rows(kind), DOFS[kind], DOFS[kind])) for kind in kinds}


def block_rates(
    matrices: dict[str, np.ndarray], masses: dict[str, np.ndarray], layout: Layout, length: np.ndarray
) -> dict[str, np.ndarray]:
    """(rows, dofs) N s/m, the largest eigenvalue of M_b^-1 2 C_b of each block times the masses of its dofs.

    matrices  C_b (rows, n, n) of scaled dofs    masses  real    length  (B, 3) m of all blocks
    """
    rates = {}
    for kind, matrix in matrices.items():
        root = np.sqrt(masses[kind])
        scaled = root.copy()
        scaled[:, 3:] /= KIND[kind].lengths(length[layout.members[kind]])
        relative = 2.0 * matrix / (scaled[:, :, None] * scaled[:, None, :])
        rates[kind] = np.linalg.eigvalsh(relative)[:, -1:] * root**2
    return rates


def with_dashpots(
    sums: dict[str, np.ndarray], rates: dict[str, np.ndarray], masses: dict[str, np.ndarray], damping: float
) -> dict[str, np.ndarray]:
    """Row sums of |K| that alone would ask for the step that both ask for; masses, real.

    rates  N s/m, of |C|, or a diagonal that is no less than C

    Local damping answers with up to (1 + damping) times the force, that of dashpots as well.
    """
    row_sums = {}
    for kind, stiffness in sums.items():
        mass = masses[kind] / (1.0 + damping)
        row_sums[kind] = (np.sqrt(rates[kind] ** 2 + 4.0 * stiffness * mass) + rates[kind]) ** 2 / (4.0 * mass)
    return row_sums


def stable_step(
    sums: dict[str, np.ndarray], masses: dict[str, np.ndarray], free: dict[str, np.ndarray], damping: float
) -> tuple[float, str, int, int]:
    """(dt, kind, row, dof): the proven bound in seconds and the dof that sets it."""
    best = (np.inf, "", 0, 0)
    for kind in KINDS:
        if not free[kind].any():
            continue
        with np.errstate(divide="ignore"):  # what touches nothing limits no step
            step = np.where(free[kind], 2.0 * np.sqrt(masses[kind] / sums[kind] / (1.0 + damping)), np.inf)
        row, i = np.unravel_index(np.argmin(step), step.shape)
        if step[row, i] < best[0]:
            best = (float(step[row, i]), kind, int(row), int(i))
    return best


def scaled_masses(
    sums: dict[str, np.ndarray], dt: float, step_fraction: float, damping: float
) -> dict[str, np.ndarray]:
    """Masses (quasi-static) for which every dof has its proven bound at dt/step_fraction."""
    return {kind: rows * (1.0 + damping) * (dt / (2.0 * step_fraction)) ** 2 for kind, rows in sums.items()}


def step_that_keeps_the_mass(
    sums: dict[str, np.ndarray], masses: dict[str, np.ndarray], free: dict[str, np.ndarray], fraction: float, xi: float
) -> float:
    """The dt (s) at which scaled masses only redistribute the mass of what moves: their sum is the real one."""
    unit = scaled_masses(sums, 1.0, fraction, xi)
    real = sum(float(masses[kind][:, :3][free[kind][:, :3]].sum()) for kind in KINDS)
    scaled = sum(float(unit[kind][:, :3][free[kind][:, :3]].sum()) for kind in KINDS)
    return float(np.sqrt(real / scaled)) if scaled > 0 else 1.0


def equation_11(layout: Layout, masses: dict[str, np.ndarray], stiffness: np.ndarray, fraction: float) -> float:
    """Eq. (11) as printed: 2 frac sqrt(smallest nodal mass / largest contact stiffness). No safe bound (errata)."""
    smallest = min(float(m[:, :3].min()) for m in masses.values() if len(m))
    return float(2.0 * fraction * np.sqrt(smallest / stiffness.max()))
