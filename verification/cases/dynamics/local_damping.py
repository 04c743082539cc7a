"""A block on a spring with Cundall's local damping, F_d = -xi |F| sign(v).

      |----|         Damping takes xi of the force on the way in and adds xi of it on the way out:
      | m  |           amplitudes of half cycles    sqrt((1 - xi)/(1 + xi))          (1/3 at xi = 0.8)
      |____|           half period                  pi/(2 w) [1/sqrt(1 - xi) + 1/sqrt(1 + xi)]
      ////// k       In free fall it takes xi of the weight: acceleration (1 - xi) g.

The sign is that of the velocity half a step before, and none at rest. So the first step is undamped, which makes the
first amplitude xi (w dt)^2/(2 (1 - xi)) too large; and where the velocity turns round after a share r of a step, the
rest of that step has 1 + xi of the force in place of 1 - xi, and the half cycle ends 2 xi (1 - r) dt/(1 - xi) early.

Reference: by hand, eq. (3) of the paper.
"""

import numpy as np

from masonry.model.model import Model, Stepping
from verification.case import Case, Findings, Line, Tolerance
from verification.checks.free_motion import follow, glued, loose
from verification.fixtures import models, shapes

XI, START, KN, SIZE, HEIGHT, GRAVITY = 0.8, 1e-5, 1e9, (0.2, 0.1), 0.1, 9.81
MASS = models.STONE.density * SIZE[0] * SIZE[1] * HEIGHT
OMEGA = float(np.sqrt(KN * SIZE[0] * SIZE[1] / MASS))
HALF = np.pi / (2 * OMEGA) * (1 / np.sqrt(1 - XI) + 1 / np.sqrt(1 + XI))
RATIO = float(np.sqrt((1 - XI) / (1 + XI)))
FRACTIONS = (4e-3, 2e-3, 1e-3)


def made(law: tuple, dt: float, gravity: float = 0.0) -> Model:
    """A block on a held one."""
    setup = shapes.setup(shapes.stack([HEIGHT, HEIGHT], SIZE), ["rigid", "rigid"])
    return models.make(
        setup, law, Stepping("real", dt, damping=XI), [models.everything(0)], gravity=(0.0, 0.0, gravity)
    )


def swung(findings: Findings, fraction: float) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Places (m) at every step of a swing from rest; times (s), shares r and places (m) of its first turning points."""
    model = made(glued(KN, KN), 2 * fraction / OMEGA)
    model.bodies.rigid.q[1, 2] = START
    steps = int(2.3 * HALF / model.dt)
    name = f"swing, {fraction:g} of the limit"
    place, speed = follow(
        findings, name, model, steps, lambda m: np.array([m.bodies.rigid.q[1, 2], m.bodies.rigid.v[1, 2]])
    ).T
    reversals = np.flatnonzero(speed[1:-1] * speed[2:] < 0)[:2] + 1
    crossing = np.abs(speed[reversals]) / (np.abs(speed[reversals]) + np.abs(speed[reversals + 1]))
    a, b, c = place[reversals], place[reversals + 1], place[reversals + 2]
    return place, model.dt * (reversals + crossing), crossing, b - (a - c) ** 2 / (8 * (a - 2 * b + c))


def run() -> Findings:
    """Amplitudes, half periods, free fall."""
    findings = Findings()
    runs = [swung(findings, fraction) for fraction in FRACTIONS]
    place, when, crossing, where = runs[-1]
    dt = 2 * FRACTIONS[-1] / OMEGA
    first, square = -where[0] / START, (OMEGA * dt) ** 2
    undamped, late = XI / (2 * (1 - XI)) * square, 2 * XI / (1 - XI) * dt
    errors = [-w[0] / START / RATIO - 1 for *_, w in runs]
    tolerance = Tolerance(3 * undamped, undamped, "three times what the undamped first step adds")
    findings.check("first half cycle over the start", "1", first, RATIO, tolerance)
    tolerance = Tolerance(
        0.05, 0.01, "the turning point, whose share of a step differs, adds up to a tenth as much again"
    )
    findings.check("order of the first amplitude in dt", "1", np.log2(errors[-2] / errors[-1]), 2.0, tolerance)
    tolerance = Tolerance(
        3 * undamped, undamped, "at most (1 + xi)^2/(8 (1 - xi)) (w dt)^2 = 2 (w dt)^2 by the step in which it turns"
    )
    findings.check("second half cycle over the first", "1", -where[1] / where[0], RATIO, tolerance)
    tolerance = Tolerance(late / HALF, 0.5 * late / HALF, "the step in which it turns: at most 2 xi dt/(1 - xi)")
    findings.check("half period", "s", when[1] - when[0], HALF, tolerance)
    tolerance = Tolerance(
        3 * dt / HALF * OMEGA * dt, dt / HALF * OMEGA * dt, "of second order: (w dt)^2 over w times the period"
    )
    value = when[1] - when[0] + (1 - crossing[0]) * late
    findings.check("half period and what that step gains", "s", value, HALF, tolerance)
    model = made(loose(KN), 1e-5, GRAVITY)
    speed = follow(findings, "free fall", model, 200, lambda m: m.bodies.rigid.v[1, 2:3])[:, 0]
    tolerance = Tolerance(1e-12, 1e-14, "a constant force: rounding of 200 sums")
    value = (speed[-1] - speed[1]) / (199 * 1e-5)
    findings.check("acceleration of free fall, away from the joint", "m/s2", value, (1 - XI) * GRAVITY, tolerance)
    x = 1e3 * dt * np.arange(len(place))
    findings.plot("Swing", "time (ms)", "displacement (um)", Line("block", x, 1e6 * place))
    return findings


CASE = Case(
    "local-damping",
    "A19",
    "A block on a spring with local damping",
    area="Dynamics",
    run=run,
    quick=True,
    problems=("oscillator",),
)
