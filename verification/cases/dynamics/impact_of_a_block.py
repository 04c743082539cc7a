"""A rigid block hits a joint that only presses, without damping.

        | v       m x'' = -k x while x < 0:   it stays for pi sqrt(m/k), with at most F = v sqrt(m k), and leaves with v
      __v__
     |  m  |      Leapfrog moves the same spring with sin(w' dt/2) = w dt/2, and from x = 0 with v exactly:
     |_____|        duration   pi/w'                              (w dt)^2/24 too short
     ///////  k     force      v sqrt(mk)/sqrt(1 - (w dt)^2/4)    (w dt)^2/8 too large
                    velocity   at most as much too large as the force, where the release falls between two steps

Steps are pi/(w (N + 1/2)) long, which puts the release between two steps: the worst case.

Reference: the half sine, by hand.
"""

import numpy as np

from masonry.model.model import Stepping
from verification.case import Case, Findings, Line, Tolerance
from verification.checks.free_motion import follow, loose
from verification.fixtures import models, shapes

SPEED, KN, SIZE = 1e-3, 1e9, (0.2, 0.1)
HEIGHT = 0.1
MASS = models.STONE.density * SIZE[0] * SIZE[1] * HEIGHT
STIFFNESS = KN * SIZE[0] * SIZE[1]
OMEGA = float(np.sqrt(STIFFNESS / MASS))
COUNTS = (20, 40, 80, 160)


def hit(findings: Findings, count: int) -> tuple[np.ndarray, float, float, float]:
    """Time (s) and force (N), duration (s), peak (N) and the speed (m/s) at which it leaves."""
    setup = shapes.setup(shapes.stack([HEIGHT, HEIGHT], SIZE), ["rigid", "rigid"])
    dt = np.pi / (OMEGA * (count + 0.5))
    stepping = Stepping("real", dt, damping=0.0)
    model = models.make(setup, loose(KN), stepping, [models.everything(0)])
    model.bodies.rigid.v[1, 2] = -SPEED
    steps = count + 20
    look = follow(
        findings, f"impact, {count} steps", model, steps,
        lambda m: np.array([-m.contacts.force[:, 2].sum(), m.bodies.rigid.q[1, 2], m.bodies.rigid.v[1, 2]]),
    )  # fmt: skip
    force, place, speed = look.T
    out = int(np.argmax((place > 0) & (np.arange(steps + 1) > 1)))
    duration = dt * (out - place[out] / (place[out] - place[out - 1]))
    top = int(np.argmax(force))
    a, b, c = force[top - 1 : top + 2]
    peak = b + (a - c) ** 2 / (8 * (2 * b - a - c))
    return np.array([dt * np.arange(steps + 1), force]), float(duration), float(peak), float(speed[-1])


def run() -> Findings:
    """Duration, peak force and restitution at four steps."""
    findings = Findings()
    exact = np.array([np.pi / OMEGA, SPEED * np.sqrt(MASS * STIFFNESS), SPEED])
    runs = [hit(findings, count) for count in COUNTS]
    errors = np.array([np.array(values[1:]) / exact - 1.0 for values in runs])
    square = (np.pi / (COUNTS[-1] + 0.5)) ** 2
    names = ("duration", "peak force", "velocity after over velocity before")
    for k, (name, unit, expected) in enumerate(
        zip(names, ("s", "N", "1"), (square / 24, square / 8, square / 8), strict=True)
    ):
        size = float(exact[k]) if k < 2 else 1.0
        order = float(np.log2(errors[-2, k] / errors[-1, k]) / np.log2((COUNTS[-1] + 0.5) / (COUNTS[-2] + 0.5)))
        tolerance = Tolerance(3 * expected, expected, "three times the leading term of leapfrog")
        findings.check(f"{name}, {COUNTS[-1]} steps", unit, float(errors[-1, k] + 1) * size, size, tolerance)
        tolerance = Tolerance(5e-4, 1e-4, "leapfrog; the next term is (w dt)^2 = 4e-4 of the first")
        findings.check(f"order of the {name} in dt", "1", order, 2.0, tolerance)
    t, force = runs[1][0]
    wanted = exact[1] * np.maximum(np.sin(OMEGA * np.minimum(t, exact[0])), 0.0)
    lines = (Line("40 steps", 1e3 * t, force, "points"), Line("half sine", 1e3 * t, wanted, "dashed"))
    findings.plot("Force of the impact", "time (ms)", "force (N)", *lines)
    steps = np.array(COUNTS) + 0.5
    curves = tuple(Line(name, steps, np.abs(errors[:, k])) for k, name in enumerate(names))
    findings.plot("Error against steps", "steps of the impact", "error (1)", *curves, log=True)
    return findings


CASE = Case(
    "impact-of-a-block",
    "A16",
    "A rigid block hits a joint",
    area="Dynamics",
    run=run,
    quick=True,
    problems=("oscillator",),
)
