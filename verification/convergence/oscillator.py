"""A block on its joint, on which gravity is put: the undamped oscillator, in real time.

     | g p(t)      m x'' + k x = m g p(t),  p the quintic rise of the dead loads over the first half of the time
    [m]            k = kn A, w = sqrt(k/m);  motion by quadrature of Duhamel's integral
    ===            energy of motion m x'^2/2 and of the joint k x^2/2 at the end

Central differences are of second order: the error falls with the square of the time step.
"""

import numpy as np

from verification.problem import Problem
from verification.scene_runs import SceneRun

SIDE, HEIGHT, DENSITY, KN, GRAVITY = 0.2, 0.1, 2000.0, 1e9, 9.81
PERIODS = 2.25
OMEGA = (KN / (DENSITY * HEIGHT)) ** 0.5
MASS, DURATION = DENSITY * HEIGHT * SIDE**2, PERIODS * 2 * np.pi / OMEGA

SCENE = "oscillator"
MOTION, SPRING = "energy of motion", "energy of the joint"


def measured(one: SceneRun) -> dict[str, float]:
    """At the end (J); kinetic energy is that of half a step before, which is part of the error."""
    return {MOTION: float(one.rows["kinetic"][-1]), SPRING: float(one.rows["elastic_contacts"][-1])}


def exact(one: SceneRun) -> dict[str, float]:
    """Duhamel's integral by Gauss points."""
    half = DURATION / 2
    nodes, weights = np.polynomial.legendre.leggauss(60)
    s = 0.5 * half * (nodes + 1)
    r = s / half
    rise = r**3 * (10 - 15 * r + 6 * r**2)
    late = half + s
    x = v = 0.0
    for time, load in ((s, rise), (late, np.ones_like(late))):
        x += GRAVITY / OMEGA * 0.5 * half * float(np.sum(weights * load * np.sin(OMEGA * (DURATION - time))))
        v += GRAVITY * 0.5 * half * float(np.sum(weights * load * np.cos(OMEGA * (DURATION - time))))
    return {MOTION: 0.5 * MASS * v * v, SPRING: 0.5 * KN * SIDE**2 * x * x}


def time_steps() -> dict[str, dict[str, object]]:
    """The same time in more and more steps."""
    return {f"{n} steps": {"settle.steps": n, "solver.time_step": f"{DURATION / n!r} s"} for n in COUNTS}


COUNTS = (16, 32, 64, 128, 256, 512, 1024)
PROBLEMS = (
    Problem(
        *("oscillator", "Undamped oscillator in real time", SCENE, {"time step": time_steps()}),
        measure=measured,
        exact=exact,
        units={MOTION: "J", SPRING: "J"},
        shipped=("", ""),
    ),
)
