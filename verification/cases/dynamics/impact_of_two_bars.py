"""Two equal bars of rigid blocks, joined by springs, meet at a relative speed v.

     |--->  v/2          -v/2  <---|         c = h sqrt(k/m)      Z = sqrt(k m)     L = N h
     [][][][][][][][] [][][][][][][][]
           N blocks      N blocks            continuum: force Z v/2 (that is rho c A v/2) for 2 L/c, then they part

Until the ends are heard of, the lattice has a closed form of its own: the gap of neighbours in the middle closes with
v J0(2 w t), w = sqrt(k/m), so that

     F(t) = (Z v/2) * integral of J0(x) from 0 to 2 w t          -> Z v/2 as t grows,

and the time at which they part is the first zero of the middle spring's force in the modes of 2 N blocks. The program
is held to these in dt (order 2), and to the continuum in the number of blocks: the front of a wave in a lattice is
smeared over N^(1/3) blocks, so the duration is wrong by N^(-2/3).

Reference: d'Alembert; the lattice of Schroedinger (1914), Annalen der Physik 44, 916.
"""

import numpy as np
from scipy.optimize import brentq
from scipy.special import itj0y0

from masonry.model.model import Model, Stepping
from verification.case import Case, Findings, Line, Tolerance
from verification.checks.free_motion import follow, glued
from verification.fixtures import models, shapes

SPEED, KN, SIDE, PITCH = 1e-3, 1e10, 0.1, 0.1
AREA, MASS = SIDE**2, models.STONE.density * SIDE**2 * PITCH
OMEGA = float(np.sqrt(KN * AREA / MASS))
FORCE = 0.5 * SPEED * float(np.sqrt(KN * AREA * MASS))


def bars(count: int, fraction: float) -> tuple[Model, np.ndarray]:
    """Two bars of `count` blocks upon each other at a share of the stable step; and which contacts lie between them."""
    blocks = shapes.stack([PITCH] * (2 * count), (SIDE, SIDE))
    setup = shapes.setup(blocks, ["rigid"] * (2 * count))
    model = models.make(setup, glued(KN, KN), Stepping("real", fraction / OMEGA, damping=0.0))
    between = (setup.joints.block_a == count - 1) & (setup.joints.block_b == count)
    model.state.intact_n[between], model.state.secant[between] = 0.0, 0.0  # torn: the middle only presses
    model.bodies.rigid.v[:count, 2], model.bodies.rigid.v[count:, 2] = 0.5 * SPEED, -0.5 * SPEED
    return model, between


def meet(findings: Findings, count: int, fraction: float, until: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times (1/w), force (N), and velocity (m/s) of the centre of the upper bar, up to a time `until` (1/w)."""
    model, between = bars(count, fraction)
    name = f"{count} blocks a bar, {fraction:g} w dt"

    def look(m: Model) -> np.ndarray:
        return np.array([-m.contacts.force[between, 2].sum(), m.bodies.rigid.v[count:, 2].mean()])

    seen = follow(findings, name, model, round(until / fraction), look, every=2)
    return 2 * fraction * np.arange(len(seen)), seen[:, 0], seen[:, 1]


def parting(t: np.ndarray, force: np.ndarray, count: int) -> float:
    """Time (1/w) at which the force falls to zero, on a straight line through the last two values above it."""
    out = int(np.argmax((force <= 0.0) & (t > count)))
    return float(t[out - 1] + force[out - 1] / (force[out - 2] - force[out - 1]) * (t[1] - t[0]))


def released(count: int) -> float:
    """Time (1/w) at which the springs of the glued lattice first pull in the middle: by its modes, in closed form."""
    j = np.arange(1, 2 * count)[:, None]
    place = np.arange(2 * count) + 0.5
    shape = np.cos(np.pi * j * place / (2 * count)) / np.sqrt(count)
    omega = 2 * np.sin(np.pi * j[:, 0] / (4 * count))
    closing = (shape[:, :count].sum(axis=1) - shape[:, count:].sum(axis=1)) * (shape[:, count - 1] - shape[:, count])

    def force(t: float) -> float:
        return float(np.sum(closing * np.sin(omega * t) / omega))

    times = np.linspace(1.5 * count, 2.5 * count, 4001)
    after = int(np.argmax(np.array([force(t) for t in times]) < 0.0))
    return float(brentq(force, times[after - 1], times[after], xtol=1e-12))


def run() -> Findings:
    """The lattice's curve and its order; the continuum's force and duration."""
    findings = Findings()
    off = []
    for fraction in (0.08, 0.04, 0.02):
        t, force, _ = meet(findings, 50, fraction, 60.0)
        wanted = FORCE * itj0y0(2 * t)[0]
        off.append(float(np.abs(force - wanted).max() / FORCE))
    lines = (Line("bars of 50 blocks", t, force / FORCE), Line("lattice", t[::20], wanted[::20] / FORCE, "points"))
    findings.plot("Force of the impact", "w t (1)", "force over Z v/2 (1)", *lines)
    # a frequency f of leapfrog is off by (f dt)^2/24: the tail sqrt(1/(pi w t)) at 2 w is shifted by 2 w t of that
    expected = float(np.sqrt(60 / np.pi) * 2 * (2 * 0.02) ** 2 / 24)
    tolerance = Tolerance(
        3 * expected, expected, "the phase that leapfrog gains at the highest frequency by the end of the curve"
    )
    findings.check("force against the lattice, largest deviation over Z v/2", "1", off[2], 0.0, tolerance, scale=1.0)
    findings.check("order of the force in dt", "1", np.log2(off[1] / off[2]), 2.0, Tolerance(0.02, 5e-3, "leapfrog"))
    late = []
    for fraction in (0.04, 0.02):
        t, force, _ = meet(findings, 50, fraction, 110.0)
        late.append(parting(t, force, 50) / released(50) - 1.0)
    tolerance = Tolerance(1e-4, 3e-5, "leapfrog, at the low frequencies of the front")
    value = (late[1] + 1) * released(50) / OMEGA
    findings.check("duration against the lattice, 50 blocks", "s", value, released(50) / OMEGA, tolerance)
    tolerance = Tolerance(0.05, 0.01, "leapfrog")
    findings.check("order of the duration in dt", "1", np.log2(late[0] / late[1]), 2.0, tolerance)
    lost = []
    for count in (100, 200):
        t, force, speed = meet(findings, count, 0.1, 2.6 * count)
        lost.append(1.0 - float(speed[-1]) / (0.5 * SPEED))
    first, longer = t <= count, released(count) / (2 * count) - 1.0
    tail = float((2 * count) ** -1.5 * np.sqrt(2 / np.pi))
    mean = float(np.trapezoid(force[first], t[first]) / count)
    tolerance = Tolerance(3 * tail, tail, "what the integral of J0 still swings, averaged: sqrt(2/pi) (2 N)^(-3/2)")
    findings.check("mean force up to L/c, 200 blocks", "N", mean, FORCE, tolerance)
    tolerance = Tolerance(
        3 * longer, longer, "by as much as the front is smeared, of order N^(-2/3): that of the lattice in closed form"
    )
    findings.check("duration, 200 blocks", "s", parting(t, force, count) / OMEGA, 2 * count / OMEGA, tolerance)
    tolerance = Tolerance(0.02, 5e-3, "what rings on in the bars: N^(-2/3) of the energy")
    value = np.log2(lost[0] / lost[1])
    findings.check("order of the velocity kept in the number of blocks", "1", value, 2 / 3, tolerance)
    findings.plot(
        "Bars of 200 blocks",
        "w t (1)",
        "force over Z v/2 (1)",
        Line("lattice of the program", t, force / FORCE),
        Line("continuum", np.array([0, 0, 400, 400, 520]), np.array([0, 1, 1, 0, 0]), "dashed"),
    )
    return findings


CASE = Case(
    "impact-of-two-bars",
    "A16",
    "Two bars meet",
    area="Dynamics",
    run=run,
    quick=True,
    problems=("oscillator",),
)
