"""A skewed block on an elastic joint: all its frequencies, with masses, inertias and stiffnesses by hand.

         __________          u(x) = t + H (x - c): 12 dofs; a rigid block has those with H r = theta x r, 6 of them
        /    c    /  edge e3
       /_________/           M   m for t;  m/12 sum of e_k e_k^T for each row of H (an affine image of a cube)
       ===========  joint    K   integral of N^T D N over the face a, b about f,  D = kn n n^T + ks (1 - n n^T):
       ///////////               N(f)^T D N(f) A + A/12 (N'(a)^T D N'(a) + N'(b)^T D N'(b));  and V C

The frequencies of the program are those of its own step: what velocity a unit of each dof gives in one step from
rest, over dt, is -M^-1 K, column by column. So wrong inertias show here, which no answer at rest depends on.

Reference: mechanics; sums over six and twelve dofs.
"""

import numpy as np

from verification.case import Case, Findings, Tolerance
from verification.checks.free_motion import glued
from verification.fixtures import models, shapes

SIZE = np.array([0.2, 0.1, 0.08])
SKEW = np.array([[1.0, 0.3, 0.2], [0.1, 1.0, -0.2], [0.0, 0.15, 0.9]])
KN, KS = 2e11, 8e10
EYE = np.eye(3)


def move(r: np.ndarray) -> np.ndarray:
    """(3, 12) displacement of a point at r from the centroid for a unit of t and of H, row by row."""
    return np.hstack([EYE, np.kron(EYE, r)])


def by_hand() -> tuple[np.ndarray, np.ndarray]:
    """Mass (kg, kg m2) and stiffness (N/m, N, N m) of the twelve dofs."""
    edges = SKEW * SIZE  # in columns
    volume, (a, b, c) = float(np.linalg.det(edges)), edges.T
    mass = models.STONE.density * volume
    spread = mass / 12 * edges @ edges.T
    inertia = np.zeros((12, 12))
    inertia[:3, :3], inertia[3:, 3:] = mass * EYE, np.kron(EYE, spread)
    across = np.cross(a, b)
    area = float(np.linalg.norm(across))
    n, below = across / area, -0.5 * c
    glue = KN * np.outer(n, n) + KS * (EYE - np.outer(n, n))
    slopes = [move(side) - move(0 * side) for side in (a, b)]
    parts = [(area, move(below)), *((area / 12, slope) for slope in slopes)]
    stiffness = sum(weight * m.T @ glue @ m for weight, m in parts)
    lame, mu = models.STONE.lame()
    own = lame * np.einsum("ij,kl->ijkl", EYE, EYE)
    own += mu * (np.einsum("ik,jl->ijkl", EYE, EYE) + np.einsum("il,jk->ijkl", EYE, EYE))
    stiffness[3:, 3:] += volume * own.reshape(9, 9)
    return inertia, stiffness


def rotations() -> np.ndarray:
    """(12, 6) the dofs of an affine block for those of a rigid one: H = theta x."""
    values = np.zeros((12, 6))
    values[:3, :3] = EYE
    for k in range(3):
        values[3:, 3 + k] = np.cross(EYE[k], EYE).T.ravel()
    return values


def run() -> Findings:
    """Six frequencies of the rigid block, twelve of the affine one."""
    findings = Findings()
    inertia, stiffness = by_hand()
    for kind, base in (("rigid", rotations()), ("affine", np.eye(12))):
        squares = np.linalg.eigvals(np.linalg.solve(base.T @ inertia @ base, base.T @ stiffness @ base))
        wanted = np.sort(np.sqrt(squares.real))
        blocks = shapes.skewed(shapes.stack([SIZE[2], SIZE[2]], (SIZE[0], SIZE[1])), SKEW)
        model = models.make(shapes.setup(blocks, [kind, kind]), glued(KN, KS), holds=[models.everything(0)])
        had = np.sort(np.sqrt(np.linalg.eigvals(-models.acceleration_matrix(model)).real))
        for k, (value, reference) in enumerate(zip(had, wanted, strict=True)):
            tolerance = Tolerance(1e-12, 1e-13, "sums of some hundred products and an eigenvalue: rounding")
            findings.check(f"{kind}: frequency {k + 1} of {len(wanted)}", "rad/s", value, reference, tolerance)
    return findings


CASE = Case(
    "free-block-on-a-joint",
    "A20",
    "Frequencies of a skewed block on a joint: masses and inertias",
    area="Dynamics",
    run=run,
    quick=True,
    no_problems="one step of a linear system: the same at any setting, to rounding",
)
