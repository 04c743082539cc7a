"""The step of two rigid blocks on one spring: the proven bound is the limit itself, from both sides.

     ______
    |  m   |      both blocks are free; one contact point in the middle of the face, k = kn A:  2/w = 2 sqrt(m/2k)
    |______|      the row sums of both are 2 k, so bound/limit = 1;  with dilation 2 k (1 + tan psi);
    |  k   |      with local damping over sqrt(1 + xi);  the step is the fraction of it that was asked for
    |  m   |      scaled masses: the blocks move with w dt/2 sqrt(1 + xi) = the fraction, as their own step shows
    |______|

Reference: leapfrog, by hand; Gershgorin.
"""

import numpy as np

from masonry.model.model import Model, Stepping
from verification.case import Case, Findings, Tolerance
from verification.checks.free_motion import glued
from verification.fixtures import models, shapes

KN, SIDES, HEIGHT = 2e11, (0.2, 0.1), 0.05
AREA = SIDES[0] * SIDES[1]
LIMIT = 2.0 * np.sqrt(models.STONE.density * AREA * HEIGHT / (2.0 * KN * AREA))
TAN, FRACTION = 0.3, 0.7


def blocks(stepping: Stepping, tan_dilation: float | None = None) -> Model:
    """Two free blocks with one contact point, which is soft in shear."""
    shape, interface = glued(KN, 1e-4 * KN)
    if tan_dilation is not None:
        interface = interface._replace(tan_dilation=tan_dilation, dilation_cutoff=1.0)
    setup = shapes.setup(shapes.stack([HEIGHT, HEIGHT], SIDES), ["rigid", "rigid"], points_per_edge=1)
    return models.make(setup, (shape, interface), stepping)


def moving(model: Model) -> float:
    """Highest frequency (rad/s), of the blocks against each other, from their own step."""
    return float(np.sqrt(np.linalg.eigvals(-models.acceleration_matrix(model)).real.max()))


def run() -> Findings:
    """Bounds and steps over the limit."""
    findings = Findings()
    plain = blocks(Stepping("real", damping=0.0, step_fraction=FRACTION))
    ratios = {
        "bound over the limit 2/w": (plain.bound / LIMIT, 1.0),
        "step over the limit": (plain.dt / LIMIT, FRACTION),
        "frequency of the step's own motion, times limit/2": (moving(plain) * LIMIT / 2.0, 1.0),
        "bound over the limit, with dilation": (
            blocks(Stepping("real", damping=0.0), TAN).bound / LIMIT, (1.0 + TAN) ** -0.5),
        "bound over the limit, with local damping": (blocks(Stepping("real", damping=0.8)).bound / LIMIT, 1.8**-0.5),
    }  # fmt: skip
    for damping in (0.0, 0.8):
        scaled = blocks(Stepping("scaled", damping=damping, step_fraction=FRACTION))
        ratio = moving(scaled) * scaled.dt / 2.0 * np.sqrt(1.0 + damping)
        ratios[f"scaled masses, xi = {damping:g}: w dt/2 sqrt(1 + xi)"] = ratio, FRACTION
    printed = blocks(Stepping("real", "equation-11", FRACTION, 0.0))
    ratios["eq. (11) by name, 2 f sqrt(m/k), over the limit"] = printed.dt / LIMIT, FRACTION * np.sqrt(2.0)
    for name, (value, wanted) in ratios.items():
        findings.check(name, "1", value, wanted, Tolerance(1e-12, 1e-15, "one spring: rounding"))
    return findings


CASE = Case(
    "step-of-one-spring",
    "A20",
    "The stable step of one spring, from both sides",
    area="Dynamics",
    run=run,
    quick=True,
    no_problems="a bound: there is nothing to choose",
)
