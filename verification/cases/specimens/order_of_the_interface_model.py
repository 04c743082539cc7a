"""The interface model against a closed form of two blocks and a joint: the order of both tiers.

A stress function of plane stress that leaves a joint at z = 0 with a linear normal stress and no shear, nu = 0:

    phi = 4 a (x^3 z^2 - x z^4) + b x^3/6 + c x^2/2        phi is z times a harmonic function, and pure bending
    sigma_zz = 24 a x z^2 + b x + c    sigma_xx = a (8 x^3 - 48 x z^2)    tau_xz = -a (24 x^2 z - 16 z^3)
    E u_x = a (2 x^4 - 24 x^2 z^2 + 6 z^4) - b z^2/2      E u_z = 8 a x z^3 + (b x + c) z

The joint opens by (b x + c)/kn, so the upper block moves besides as a rigid body: up by c/kn, and turned by b/kn. The
displacements on the outline of the blocks are given; those inside, and of the joint, are found.

Expected: strain energy norm of the error h^1 for linear tets and h^2 for quadratic ones; displacement of linear tets
h^2. Tier 2 stands for the truth in other cases, so its order is what they rest on. With ends that are not free to move
along x the exact field would be singular in the corners and show the order of the corner instead.
"""

from dataclasses import dataclass

import numpy as np
from skfem import Basis, Functional, asm

from verification.case import Case, Findings, Line, Tolerance
from verification.references.interface.envelopes import Law
from verification.references.interface.mesh import grids
from verification.references.interface.model import InterfaceModel, model
from verification.references.interface.newton import EquilibriumPath

Array = np.ndarray
YOUNG, KN = 10e9, 1e11
A, B, C = 3e10, 2e7, 1e6
HALF_WIDTH, HEIGHT, THICKNESS, NEAR = 0.05, 0.1, 0.02, 1e-9
CELLS = (2, 4, 8)


@dataclass(frozen=True)
class Error:
    """Relative errors over the volume: of the stress in the energy norm, of the displacement in the mean square."""

    stress: float
    displacement: float


def exact(x: Array, z: Array, upper: Array) -> Array:
    """(3, ...) m."""
    along = (A * (2 * x**4 - 24 * x**2 * z**2 + 6 * z**4) - 0.5 * B * z**2) / YOUNG - upper * B / KN * z
    up = (8 * A * x * z**3 + (B * x + C) * z) / YOUNG + upper * (B * x + C) / KN
    return np.stack([along, 0.0 * x, up])


def strains(x: Array, z: Array) -> tuple[Array, Array, Array]:
    """Strains xx, zz and xz, of no unit."""
    xx, xz = A * (8 * x**3 - 48 * x * z**2), -A * (24 * x**2 * z - 16 * z**3)
    return xx / YOUNG, (24 * A * x * z**2 + B * x + C) / YOUNG, xz / YOUNG


def blocks(cells: int, degree: int) -> InterfaceModel:
    """Two blocks, `cells` along x and along z of each; the outline moves as it must."""
    across = np.linspace(-HALF_WIDTH, HALF_WIDTH, cells + 1), np.array([0.0, THICKNESS])
    body = grids([(*across, np.linspace(z, z + HEIGHT, cells + 1)) for z in (-HEIGHT, 0.0)])
    assembled = model(body, YOUNG, 0.0, lambda a, b: Law("elastic", KN, 0.5 * KN), degree)
    assembled.hold("y", lambda x, block: np.ones(len(x), dtype=bool))
    assembled.hold("xz", lambda x, block: (np.abs(x[:, 0]) > HALF_WIDTH - NEAR) | (np.abs(x[:, 2]) > HEIGHT - NEAR))
    moved = exact(assembled.place[:, 0], assembled.place[:, 2], assembled.block == 1)[
        assembled.axis, np.arange(len(assembled.axis))
    ]
    assembled.driven = np.where(assembled.held, moved, 0.0)
    return assembled


def error(cells: int, degree: int) -> Error:
    """Solve, and compare with the closed form."""
    assembled = blocks(cells, degree)
    path = EquilibriumPath(assembled)
    path.go(1.0)
    u = path.displacements()

    @Functional
    def wrong(w):
        g, (xx, zz, xz) = w["u"].grad, strains(w.x[0], w.x[2])
        shear = (0.5 * (g[0, 2] + g[2, 0]) - xz) ** 2 + 0.25 * (g[0, 1] + g[1, 0]) ** 2
        return (g[0, 0] - xx) ** 2 + g[1, 1] ** 2 + (g[2, 2] - zz) ** 2 + 2 * shear + 0.5 * (g[1, 2] + g[2, 1]) ** 2

    @Functional
    def right(w):
        xx, zz, xz = strains(w.x[0], w.x[2])
        return xx**2 + zz**2 + 2 * xz**2

    @Functional
    def apart(w):
        return np.sum((w["u"] - exact(w.x[0], w.x[2], w.x[2] > 0.0)) ** 2, axis=0)

    @Functional
    def moved(w):
        return np.sum(exact(w.x[0], w.x[2], w.x[2] > 0.0) ** 2, axis=0)

    basis = Basis(assembled.body.mesh, assembled.basis.elem, intorder=8)
    here = basis.interpolate(u)
    stress = np.sqrt(asm(wrong, basis, u=here) / asm(right, basis))
    return Error(float(stress), float(np.sqrt(asm(apart, basis, u=here) / asm(moved, basis))))


def run() -> Findings:
    """Orders between the two finest meshes, and the errors there."""
    findings, lines = Findings(), []
    h = np.array([2 * HALF_WIDTH / n for n in CELLS]) * 1e3
    measured = (
        (1, "displacement", 2.0, "linear tets, vertices: displacement"),
        (1, "stress", 1.0, "linear tets, vertices: stress"),
        (2, "stress", 2.0, "quadratic tets, Gauss: stress"),
    )
    errors = {degree: [error(n, degree) for n in CELLS] for degree in (1, 2)}
    for degree, what, order, name in measured:
        values = np.array([getattr(e, what) for e in errors[degree]])
        tolerance = Tolerance(
            0.1, 0.03, "the order of the elements, with what the next power of h still adds on these meshes"
        )
        findings.check(f"{name}: order of the error", "1", np.log2(values[-2] / values[-1]), order, tolerance)
        lines.append(Line(name, h, values))
    findings.plot("Error against the size of elements", "h (mm)", "relative error", *lines, log=True)
    return findings


CASE = Case(
    "order-of-the-interface-model",
    "A7",
    "The interface model's own order, against a closed form with a joint",
    area="Elastic assemblies",
    run=run,
    quick=True,
    no_problems="the finite element model alone: its orders are in the case",
)
