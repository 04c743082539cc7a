"""A block on ground that goes to and fro once, forth alone: how far it slides, as Newmark (1965) has it.

    a ^   .-.             it slips from sin(w t0) = mu g/a0 until both have one velocity,
      |  /   \\            v1 + mu g (t - t0) = a0 (1 - cos(w t))/w, the ground's being 2 a0/w from half a period on
      | /     \\           slip: the area between the two velocities
      +--------+----- t
The same with forces of inertia in the frame of the ground, and with a table that moves: one motion, to rounding.

Reference: Newmark (1965), Geotechnique 15, 139; the areas by hand.
"""

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.scene_runs import result_of

G, A0, MU, PERIOD = 9.80665, 0.5, 0.2, 1.0
W = 2.0 * np.pi / PERIOD
SCENE = "block-on-ground"
WHY = "elastic slip of the joint, and the formula that is taken for straight over 1e-5 of its peak"


def slip() -> tuple[float, float, float]:
    """When it begins and ends to slip (s), and how far (m)."""
    a0, k = A0 * G, MU * G
    begin = np.arcsin(k / a0) / W
    first = a0 / W * (1.0 - np.cos(W * begin))
    last = 2.0 * a0 / W
    end = begin + (last - first) / k
    half = 0.5 * PERIOD
    ground = a0 / W * (half - np.sin(W * half) / W - (begin - np.sin(W * begin) / W)) + last * (end - half)
    block = 0.5 * (first + last) * (end - begin)
    return float(begin), float(end), float(ground - block)


def run() -> Findings:
    """Slip at the end, and the same with a table that moves."""
    findings = Findings()
    curves = {}
    for words, keys in {"forces of inertia": {}, "a table that moves": {"ground.as": "base"}}.items():
        result = findings.note(words, result_of(SCENE, {"solver.duration": "1 s", **keys}))
        curves[words] = result.history.rows
    begin, end, wanted = slip()
    (inertia, base) = (rows["slip"] for rows in curves.values())
    findings.check("slip at the end", "m", -float(inertia[-1]), wanted, Tolerance(1e-4, 1e-5, WHY))
    away = float(np.abs(inertia - base).max())
    tolerance = Tolerance(
        1e-11, 1e-12, "both have the velocity of the ground in the middle of each step: rounding", "invariance"
    )
    findings.check("slip with a table that moves, against forces of inertia", "m", away, 0.0, tolerance, scale=wanted)
    rows = curves["forces of inertia"]
    since = rows["time"] - rows["time"][-1] + 1.0
    moving = since[np.abs(np.gradient(rows["slip"], rows["time"])) > 1e-3]
    why = "between two rows, of which there are 200 a second"
    findings.check("begin of the slip", "s", moving[0], begin, Tolerance(1e-2, 4e-3, why), scale=1.0)
    findings.check("end of the slip", "s", moving[-1], end, Tolerance(1e-2, 4e-3, why), scale=1.0)
    findings.plot("Slip", "time (s)", "slip (m)", Line("forces of inertia", since, inertia), Line("table", since, base))
    return findings


CASE = Case(
    "newmarks-block",
    "A45",
    "A block slides on ground that moves once",
    area="Dynamics",
    run=run,
    quick=True,
    scene=SCENE,
    no_problems="rigid-plastic sliding: exact but for the stiffness of the joint",
)
