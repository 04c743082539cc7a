"""A block on an incline: it slides iff tan(theta) > tan(phi), and then as a free body.

              ___
          ___/ m /      along the incline    x(t) = g (sin theta - mu cos theta) integral of (t - s) p(s) ds,
         /  /___/       p(s) the share of gravity that acts: a quintic rise to 1 over Tr. At t >= Tr the integral is
     ___/    \\         Tr^2/7 + (Tr/2)(t - Tr) + (t - Tr)^2/2, for p is odd about Tr/2 and its first moment is 5/14.
    /_theta___\\__

Coulomb (1773): T <= mu N. The threshold needs gravity that rises slowly: put on at once, springs swing to twice their
static load, and the block slips below tan(phi). Local damping of eq. (3) takes its share of the force that accelerates
also from a free slide: x falls to (1 - xi) of it, so motion in real time needs damping = 0.
"""

from math import atan, cos, radians, sin, tan

import numpy as np

from masonry.laboratory.result import Result
from verification.case import Case, Findings, Line, Tolerance
from verification.fixtures.thresholds import threshold
from verification.scene_runs import result_of

MU, G = 0.6, 9.81
LENGTH, HEIGHT = 0.4, 0.05
NORMAL, SHEAR, DENSITY = 2e11, 1e11, 2000.0

SCENE = "incline"


def weight(theta: float) -> dict[str, str]:
    """Overrides that turn gravity (rad) in place of the incline."""
    return {"gravity.x": f"{G * sin(theta)!r} m/s^2", "gravity.z": f"{-G * cos(theta)!r} m/s^2"}


def slid(result: Result) -> np.ndarray:
    """(frames,) m: how far the block has gone along the incline."""
    corners = slice(8, 16)
    return np.array([frame.corners[corners, 0].mean() for frame in result.history.frames])


def run() -> Findings:
    """The angle at which it begins to slide, and the slide."""
    findings = Findings()
    elastic = DENSITY * HEIGHT * G / SHEAR

    def slides(angle: float) -> bool:
        result = findings.note(f"theta = {angle:.5f} rad", result_of(SCENE, weight(angle)))
        return bool(slid(result)[-1] > 20 * elastic)

    angle, width = threshold(slides, 0.95 * atan(MU), 1.05 * atan(MU), 9)
    tolerance = Tolerance(
        1e-3,
        width * (1 + MU**2) / MU,
        "the catalogue's 0.1 %; bisection ends within 1e-4, and a block is called sliding after 20 elastic slips",
    )
    findings.check("tan(theta) at which it slides", "1", tan(angle), MU, tolerance)
    motion(findings)
    return findings


def motion(findings: Findings) -> None:
    """The free slide at 45 degrees, without damping and with xi = 0.8."""
    theta = radians(45.0)
    plain, damped = (
        findings.note(
            f"sliding, xi = {xi}", result_of(SCENE, weight(theta) | {"solver.masses": "real", "solver.damping": xi})
        )
        for xi in (0.0, 0.8)
    )
    rise = 2000 * float(plain.summary["time_step_s"])
    times = np.array([frame.time for frame in plain.history.frames])
    after = times >= rise
    exact = G * (sin(theta) - MU * cos(theta)) * (rise**2 / 7 + rise / 2 * (times - rise) + (times - rise) ** 2 / 2)
    x = slid(plain)
    worst = int(np.argmax(np.where(after, np.abs(x / exact - 1), 0)))
    lag = DENSITY * HEIGHT * G * cos(theta) * MU / SHEAR
    tolerance = Tolerance(
        5 * lag / exact[after][0],
        lag / exact[after][0],
        "the block is ahead by the elastic slip mu N/ks, 1e-5 of the way; rounding in dt/rise adds as much",
    )
    findings.check("x(t), the worst of all frames after the rise", "m", x[worst], exact[worst], tolerance)
    dt = float(damped.summary["time_step_s"]) / float(plain.summary["time_step_s"])
    ratio = slid(damped)[-1] / dt**2 / x[-1]
    tolerance = Tolerance(
        1e-4, 2e-5, "(1 - xi) of the force accelerates; the elastic slip is a larger share of the shorter way"
    )
    findings.check("x with xi = 0.8 over x with xi = 0", "1", ratio, 0.2, tolerance)
    lines = (Line("masonry", times, x, "points"), Line("closed form", times[after], exact[after], "dashed"))
    findings.plot("Slide at 45 degrees", "time (s)", "x (m)", *lines)


CASE = Case(
    name="incline",
    row="A12",
    title="A block slides on an incline",
    area="Friction and stability",
    run=run,
    quick=True,
    scene=SCENE,
    problems=("oscillator",),
)
