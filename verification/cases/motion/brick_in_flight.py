"""A brick in free flight, and one that hits a plane with a corner.

    spin (0.1, 10, 0.1) rad/s along the edges:      one corner, no friction, no loss, no weight, 1 m/s down:
    Euler's equations about the middle axis         J = 2 v_n/(1/m + n.[I^-1 (r x n) x r])

          ____                                                  /\\
         /___/|   omega                                        /  \\  | v
         |___|/                                               _\\__/__v_

Reference: Euler's equations (period 4.67394379 s, rates by elliptic functions); impulse and momentum of a rigid body.
"""

from dataclasses import replace
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from geometry.blocks import Specimen
from geometry.specimens.boxes import boxes
from masonry.assembly.assemble import Assembly
from masonry.timeloop import timeloop
from verification.case import Case, Findings, Tolerance
from verification.scene_runs import assembled

SCENE, SIZE = "brick-in-flight", (0.24, 0.115, 0.06)
RATES, MOMENTUM = np.array([0.73406383, -9.95913163, -0.76760219]), 0.168923949
HITS: dict[str, Any] = {
    "contact.unit_unit": {
        "normal_stiffness": "1e6 GPa/m",
        "shear_stiffness": "1e6 GPa/m",
        "tan_friction_angle": 0.0,
    },
    "gravity": None,
    "settle": None,
    "motion": [{"on": "block", "velocity": [0, 0, "-1 m/s"]}],
    "solver.duration": "0.015 ms",  # it turns on at once, and its rates change as it turns
    "solver.step_fraction": 0.2,
}
ABOVE = 1e-6
"""m, which it flies before it hits."""
AFTER, IMPULSE = np.array([0.0, 0.0, -0.33878798, -9.02687, -15.81370, 7.02372]), 2.189934


def flown(seconds_a_step: float) -> Assembly:
    """The brick after 2 s of flight."""
    built = assembled(SCENE, {"solver.time_step": f"{seconds_a_step!r} s", "gravity": None, "settle": None})
    timeloop.run(built.model, built.plan, built.recording)
    return built


def in_flight() -> Findings:
    """Rates along the brick's edges after 2 s by three steps, and the angular momentum."""
    findings, states = Findings(), []
    for step in (5e-4, 2.5e-4, 1.25e-4):
        body = flown(step).model.bodies.rigid
        states.append(body.frame[0].T @ body.v[0, 3:])
    errors = [float(np.abs(rates - RATES).max()) for rates in states]
    tolerance = Tolerance(0.05, 0.01, "Buss's step is of second order")
    findings.check("order of the error in the step", "1", np.log2(errors[1] / errors[2]), 2.0, tolerance)
    limit = states[2] + (states[2] - states[1]) / 3.0
    tolerance = Tolerance(1e-6, 2e-7, "fourth order is left")
    findings.check("rates after 2 s, extrapolated", "rad/s", np.abs(limit - RATES).max(), 0.0, tolerance, scale=1.0)
    tolerance = Tolerance(1e-8, 1e-9, "nothing changes it, to the bit; the closed form has nine digits")
    findings.check("angular momentum", "kg m2/s", np.linalg.norm(body.momentum[0]), MOMENTUM, tolerance)
    return findings


def turned_brick() -> Specimen:
    """The brick, turned by Rz(30) Ry(35) Rx(20) deg, with its lowest corner ABOVE a slab whose top is at z = 0."""
    middle = np.full(3, 1.0)
    specimen = boxes(
        [
            ("slab", (-1.0, -1.0, -0.1), (2.0, 2.0, 0.1), "units", 0, (1, 1, 1)),
            ("block", tuple(middle - 0.5 * np.array(SIZE)), SIZE, "units", 1, (1, 1, 1)),
        ],
        0.01,
    )
    blocks = specimen.blocks
    first, last = (int(blocks.face_start[blocks.block_face_start[k]]) for k in (1, 2))
    own = np.unique(blocks.face_points[first:last])
    turned = Rotation.from_euler("ZYX", [30.0, 35.0, 20.0], degrees=True).apply(blocks.points[own] - middle)
    points = blocks.points.copy()
    points[own] = turned - [0.0, 0.0, turned[:, 2].min() - ABOVE]
    return replace(specimen, blocks=replace(blocks, points=points))


def on_a_corner() -> Findings:
    """Velocity and spin after the impact, and what contacts have given."""
    findings = Findings()
    built = assembled("dry-block", HITS, specimen=turned_brick())
    outcome = timeloop.run(built.model, built.plan, built.recording)
    body = built.model.bodies.rigid
    after, mass = body.v[1], float(built.model.masses["rigid"][1, 0])
    for k, name in ((2, "speed upwards"), (3, "spin about x"), (4, "spin about y"), (5, "spin about z")):
        tolerance = Tolerance(1e-3, 2e-4, "the brick turns while its corner presses")
        findings.check(f"{name} after the impact", "m/s" if k == 2 else "rad/s", after[k], AFTER[k], tolerance)
    findings.check("impulse", "N s", mass * float(after[2] + 1.0), IMPULSE, Tolerance(1e-3, 2e-4, "as the speed"))
    rows = outcome.history.rows
    left = float(rows["kinetic"][-1] / rows["kinetic"][0])
    tolerance = Tolerance(1e-3, 3e-4, "no friction and no dashpot")
    findings.check("kinetic energy after over before", "1", left, 1.0, tolerance)
    return findings


ONE: dict[str, Any] = {"problems": ("brick-in-flight",)}
NONE: dict[str, Any] = {"no_problems": "its spring is so stiff"}
CASES = tuple(
    Case(name=name, row="A28", title=title, area="Dynamics", run=run, scene=scene, **chosen)
    for name, title, run, scene, chosen in (
        ("brick-in-flight", "A brick in free flight", in_flight, SCENE, ONE),
        ("brick-on-a-corner", "A brick that hits a plane with a corner", on_a_corner, "dry-block", NONE),
    )
)
