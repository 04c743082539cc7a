"""A joint in pure bending between rigid blocks: what points at the ends of n cells add to its stiffness.

       q ^ |______________| v q        shear q on both ends of the upper block: a couple M = q (h b) L, no force
           |    upper     |
           |==============|            n cells in the depth L, points at their ends
           |    lower     |
            ////////////// held

    K = kn b L^3/12 (1 + 2/n^2)

by the trapezoidal rule, which takes the integral of x^2 over a cell of width c too large by c^3/6: an identity, not an
estimate. Facets of tets with a third of their area at each corner have it: nine cells are 2.5 % too stiff in bending,
three 22 %. Points at Gauss's places, the default, have no such excess, and those of Gauss and Lobatto, which reach to
the edge, none from three on; two of them are the ends alone (n = 1).
"""

import numpy as np

from verification.case import Case, Findings, Tolerance
from verification.references.interface.envelopes import Law
from verification.references.interface.mesh import grids
from verification.references.interface.model import model
from verification.scene_runs import result_of

KN, LENGTH, WIDTH, HEIGHT, SHEAR = 2e11, 0.2, 0.1, 0.08, 1e5
COUPLE = SHEAR * HEIGHT * WIDTH * LENGTH
EXACT = KN * WIDTH * LENGTH**3 / 12
CELLS = (1, 2, 3, 4, 9, 16)
SCENE = "joint-in-bending"


def stiffness(findings: Findings, rule: str, points: int) -> float:
    """N m/rad of a run at rest under the couple."""
    knobs = {"specimen.contact_points": rule, "specimen.points_per_edge": points}
    result = findings.note(f"{points} points, {rule}", result_of(SCENE, knobs))
    corner, moved = result.specimen.blocks.points, result.history.frames[-1].corners
    upper = moved[:, 2] != 0.0
    slope = np.polyfit(corner[upper, 0], moved[upper, 2], 1)[0]
    return float(COUPLE / -slope)


def of_facets(cells: int) -> float:
    """The same of tets' facets lumped at their corners: twice the energy of a turn of 1 rad."""
    x = np.linspace(-0.5 * LENGTH, 0.5 * LENGTH, cells + 1)
    y = np.array([0.0, WIDTH])
    body = grids([(x, y, np.array([-HEIGHT, 0.0])), (x, y, np.array([0.0, HEIGHT]))])
    joint = model(body, 1e9, 0.0, lambda a, b: Law("elastic", KN, KN)).joints[0]
    return float(KN * joint.weight @ joint.place[:, 0] ** 2)


def run() -> Findings:
    """The identity for points of runs and of facets, and Gauss's points without the excess."""
    findings = Findings()
    for n in CELLS:
        identity = EXACT * (1 + 2 / n**2)
        at_edges = identity if n == 1 else EXACT
        tolerance = Tolerance(1e-12, 1e-13, "three times by two points, exact by more: rounding, once all is at rest")
        value = stiffness(findings, "vertex", n + 1)
        findings.check(f"bending stiffness, {n + 1} points at vertices", "N m/rad", value, at_edges, tolerance)
        tolerance = Tolerance(1e-12, 1e-14, "an identity: rounding")
        findings.check(f"bending stiffness, facets of tets, {n} cells", "N m/rad", of_facets(n), identity, tolerance)
    tolerance = Tolerance(1e-12, 1e-13, "two Gauss points are exact to the third power: rounding")
    findings.check("bending stiffness, 2 Gauss points", "N m/rad", stiffness(findings, "gauss", 2), EXACT, tolerance)
    return findings


CASE = Case(
    "joint-in-bending",
    "A3",
    "A joint in pure bending: the excess of points at vertices",
    area="Elastic assemblies",
    run=run,
    quick=True,
    scene=SCENE,
    problems=("cantilever-rigid",),
)
