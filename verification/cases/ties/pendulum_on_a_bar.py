"""A block that swings on a bar by 60 degrees, and one that falls into a slack rope.

    pendulum    T = 4 K(sin(a/2)) sqrt(L/g),  a = 60 deg, L = 1 m; on a bar so stiff that its length stays
    rope        slack s, stiffness k, weight W:  it stretches by d = (W + sqrt(W^2 + 2 k W s)) / k, and bears k d

Reference: by hand; K is the complete elliptic integral of the first kind.
"""

import math
from typing import Any

import numpy as np
from scipy.special import ellipk

from verification.case import Case, Findings, Line, Tolerance
from verification.scene_runs import run as run_scene

ANGLE, LENGTH, GRAVITY, WEIGHT = math.radians(60.0), 1.0, 9.81, 2.0 * 9.81
SLACK, STIFFNESS = 0.05, 1e5
FALLS: dict[str, Any] = {
    "gravity": {"z": "-9.81 m/s^2"},
    "settle": {"steps": 0},
    "drive": None,
    "bar.0.strength": None,
}


def run() -> Findings:
    """The period, and the deepest place and the greatest force of the rope."""
    findings = Findings()
    swings = FALLS | {
        "displacements": "large",
        "support": [{"on": "foot", "fix": "all"}],
        "bar.0.ends": [
            ["0 m", "0 m", "0 m"],
            [f"{-math.sin(ANGLE)!r} m", "0 m", f"{math.cos(ANGLE)!r} m"],
        ],
        "solver": {"masses": "real", "damping": 0, "duration": "5 s", "rows": 2000},
    }
    result = run_scene("block-on-a-bar", swings).result
    assert result is not None
    findings.note("pendulum", result)
    rows = result.history.rows
    time, across = rows["time"], rows["x"] + LENGTH * math.sin(ANGLE)
    back = np.flatnonzero((across[:-1] < 0.0) & (across[1:] >= 0.0))
    passes = time[back] - across[back] * np.diff(time)[back] / np.diff(across)[back]
    period = 4.0 * float(ellipk(math.sin(ANGLE / 2.0) ** 2)) * math.sqrt(LENGTH / GRAVITY)
    tolerance = Tolerance(3e-4, 4e-5, "the bar stretches by 4e-5 of its length, and rows lie 2.5 ms apart")
    findings.check("period", "s", passes[1] - passes[0], period, tolerance)
    findings.plot("Pendulum", "time (s)", "x (m)", Line("run", time, across))
    caught = FALLS | {
        "support": [{"on": "foot", "fix": "all"}, {"on": "block", "fix": ["x", "y", "rotation"]}],
        "bar.0.ends": [["0 m", "0 m", "0 m"], ["0 m", "0 m", "1 m"]],
        "bar.0.slack": f"{SLACK} m",
        "bar.0.young_modulus": f"{STIFFNESS * (1.0 + SLACK) / 1e-4!r} Pa",
        "solver": {"masses": "real", "damping": 0, "duration": "0.15 s", "rows": 3000, "step_fraction": 0.002},
        "gauge.0.direction": "z",
    }
    fallen = run_scene("block-on-a-bar", caught).result
    assert fallen is not None
    findings.note("rope", fallen)
    stretch = (WEIGHT + math.sqrt(WEIGHT**2 + 2.0 * STIFFNESS * WEIGHT * SLACK)) / STIFFNESS
    tolerance = Tolerance(1e-5, 1e-6, "rows, and the step in which it catches")
    value = fallen.history.rows["x"].min()
    findings.check("deepest place of what the rope catches", "m", value, -(SLACK + stretch), tolerance)
    tolerance = Tolerance(1e-4, 1e-5, "as before")
    findings.check("greatest force of the rope", "N", fallen.history.rows["bar"].max(), STIFFNESS * stretch, tolerance)
    return findings


CASE = Case(
    name="pendulum-on-a-bar",
    row="A67",
    title="A pendulum on a bar, and a rope that catches",
    area="Dynamics",
    run=run,
    quick=True,
    scene="block-on-a-bar",
    no_problems="leapfrog of one block",
)
