"""A bar of two blocks pulled eccentrically: what lumping at vertices costs against Gauss points and quadratic tets.

        sigma = s0 + s1 x   on the end                     both blocks of height L, section h x b, nu = 0
       ^  ^ ^^^^^^|||
       |__________|
       |          |
       |==joint===|          load times its own displacement, by beams, which is exact here:
       |          |          C = N^2 (2 L/EA + 1/(kn A)) + M^2 (2 L/EI + 1/(kn I)),    N = s0 A, M = s1 I
       |__________|
        ////////// held

Displacements are quadratic in z and bilinear, so quadratic tets with Gauss points give 1/C to rounding. Linear tets are
too stiff by h^2, and more so with vertices, which alone make a joint in bending too stiff by 2/n^2 for n elements in
its depth. Past the elastic range the peak of the exponential joint is too high by nearly as much.
"""

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.references.interface.envelopes import Law
from verification.references.interface.mesh import grids
from verification.references.interface.model import InterfaceModel, model
from verification.references.interface.newton import EquilibriumPath

YOUNG, KN, KS, STRENGTH, ENERGY = 16.7e9, 150e9, 70e9, 0.58e6, 5.8
DEPTH, WIDTH, HEIGHT, NEAR = 0.1, 0.05, 0.1, 1e-9
EVEN, SLOPE = 1.0, 6.0 * 0.5 / DEPTH
"""The end's traction (Pa, Pa/m): a resultant at a quarter of the depth from the middle."""
AREA, SECOND_MOMENT = DEPTH * WIDTH, WIDTH * DEPTH**3 / 12
ELASTIC = Law("elastic", KN, KS)
SOFTENING = Law("exponential", KN, KS, fT=STRENGTH, c0=0.87e6, tan0=1.01, tan_res=0.73, G_I=ENERGY, G_II=58.0)
OPENING = 1e-7


def compliance() -> float:
    """C of the beam and its joint."""
    force, moment = EVEN * AREA, SLOPE * SECOND_MOMENT
    axial = 2 * HEIGHT / (YOUNG * AREA) + 1 / (KN * AREA)
    bending = 2 * HEIGHT / (YOUNG * SECOND_MOMENT) + 1 / (KN * SECOND_MOMENT)
    return force**2 * axial + moment**2 * bending


def bar(cells: int, degree: int, rule: str | int, law: Law) -> InterfaceModel:
    """Two blocks with `cells` elements in depth and in height."""
    across = np.linspace(-0.5 * DEPTH, 0.5 * DEPTH, cells + 1), np.array([0.0, WIDTH])
    body = grids([(*across, np.linspace(z, z + HEIGHT, cells + 1)) for z in (0.0, HEIGHT)])
    assembled = model(body, YOUNG, 0.0, lambda a, b: law, degree, rule)
    assembled.hold("xyz", lambda x, block: x[:, 2] < NEAR)
    assembled.hold("y", lambda x, block: np.ones(len(x), dtype=bool))
    assembled.load = assembled.traction(
        lambda x: np.stack([0 * x[0], 0 * x[0], EVEN + SLOPE * x[0]]), lambda x: x[2] > 2 * HEIGHT - NEAR
    )
    return assembled


def stiffness(cells: int, degree: int, rule: str | int) -> float:
    """Load over its own displacement, elastic."""
    beam = bar(cells, degree, rule, ELASTIC)
    path = EquilibriumPath(beam)
    path.go(1.0)
    return 1.0 / float(beam.load @ path.displacements())


def peak(cells: int, degree: int, rule: str | int) -> float:
    """The largest load factor of the softening joint."""
    path, factors = EquilibriumPath(bar(cells, degree, rule, SOFTENING)), [0.0]
    path.go(0.3 * STRENGTH / (1.0 + 3.0))
    while len(factors) < 200 and factors[-1] > 0.98 * max(factors[1:], default=0.0) - NEAR:
        path.open_by(OPENING)
        factors.append(path.state.factor)
    return max(factors)


def run() -> Findings:
    """Elastic stiffness by both degrees and rules, and the peaks."""
    findings, exact = Findings(), 1.0 / compliance()
    tolerance = Tolerance(1e-12, 5e-14, "the displacement is in the elements' space: rounding")
    value = stiffness(4, 2, 4)
    findings.check("stiffness, quadratic tets and Gauss points, 4 elements in depth", "1/J", value, exact, tolerance)
    cells, lines = (4, 8, 16), []
    for name, rule in (("vertices", "vertex"), ("Gauss points", 4)):
        errors = np.array([stiffness(n, 1, rule) / exact - 1.0 for n in cells])
        lines.append(Line(f"linear tets, {name}", np.array([DEPTH / n for n in cells]) * 1e3, errors))
        tolerance = Tolerance(0.1, 0.03, "an energy converges with h^2, from below while elements are few")
        value = np.log2(errors[1] / errors[2])
        findings.check(f"order of the stiffness, linear tets and {name}, 8 to 16 elements", "1", value, 2.0, tolerance)
    findings.plot("Error of the elastic stiffness", "h (mm)", "relative error", *lines, log=True)
    truth = peak(8, 2, 4)
    lumped = [peak(n, 1, "vertex") for n in (8, 16)]
    reason = "the stiffness is 1.8 % (0.5 %) high there, and the peak feels most of it"
    for n, factor, expected, limit in ((8, lumped[0], 1.5e-2, 3e-2), (16, lumped[1], 3e-3, 6e-3)):
        quantity = f"peak, linear tets and vertices, {n} elements in depth"
        findings.check(quantity, "1", factor, truth, Tolerance(limit, expected, reason, "refined model"))
    findings.remarks.append(f"peak factors: quadratic {truth:.6g}, vertices {lumped[0]:.6g} (8), {lumped[1]:.6g} (16)")
    return findings


CASE = Case(
    "eccentric-bar",
    "A7",
    "Eccentric tension: vertices against Gauss points and quadratic tets",
    area="Elastic assemblies",
    run=run,
    no_problems="the finite element model alone: its orders are in the case",
)
