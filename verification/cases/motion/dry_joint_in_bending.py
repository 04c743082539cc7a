"""A block on a dry joint that stays closed, opens on one side, and turns about its normal.

        ____
       |    | W      N across the joint, e = h tan(slope) from its middle, tilts it, on springs k_n over b x w:
       |    |          closed, e < b/6:  12 N e/(k_n w b^3 - 12 N h)
     __|____|__        open,   e > b/6:  2 N/(k_n w d^2),   d = 3 (b/2 - e) wide
                     friction slows a spin about the normal by  mu W r/I,  r = (sqrt(2) + ln(1 + sqrt(2)))/6 b, a square

Patches have points at their corners, where a block turns over; with patch_points = "spread" most of their area lies
inside. By the corners alone a closed joint bends three times as stiff, and friction bears 1.85 times the moment: that
is checked as well.

Reference: springs over the face that do not pull, and friction over it, integrated by hand.
"""

from math import atan, cos, degrees, log, sqrt

from verification.case import Case, Findings, Tolerance
from verification.fixtures.dry_blocks import DENSITY, G, block, box, leaning, slab
from verification.scene_runs import Settings, result_of

SCENE, HALF, HIGH, DEPTH = "dry-block", 0.05, 0.1, 0.2
WIDE, STIFFNESS, FRICTION, SPIN, WHILE = 2.0 * HALF, 1e10, 0.5, 20.0, 0.02
"""m; Pa/m; tan of the angle of friction; rad/s; s."""
CLOSED, OPEN = 0.1, 0.25
"""Eccentricity over the width of the joint, of which a quarter is open at the second one."""
RESTING: Settings = {
    "specimen.box": block(HALF, HIGH),
    "contact.unit_unit.tan_friction_angle": 2.0,
    "contact.unit_unit.shear_stiffness": "50 GPa/m",
    "settle.steps": 40000,
    "solver.damping": 0.8,
    "solver.duration": "0.01 s",
}
TURNING: Settings = {
    "specimen.box": [slab(), box("block", (-HALF, -HALF, 0.0), (WIDE, WIDE, WIDE), 1)],
    "contact.unit_unit.tan_friction_angle": FRICTION,
    "motion": [{"on": "block", "spin": [0, 0, f"{SPIN} rad/s"]}],
    "settle.steps": 4000,
    "solver.duration": f"{WHILE} s",
}


def tilt(share: float) -> float:
    """rad, with the weight at a share of the width from the middle of the face."""
    across = DENSITY * G * WIDE * DEPTH * 2.0 * HIGH * cos(atan(share * WIDE / HIGH))
    if share > 1.0 / 6.0:
        return 2.0 * across / (STIFFNESS * DEPTH * (3.0 * (0.5 - share) * WIDE) ** 2)
    return 12.0 * across * share * WIDE / (STIFFNESS * DEPTH * WIDE**3 - 12.0 * across * HIGH)


def tilted(findings: Findings, points: str, share: float) -> float:
    """The same of a run, over the closed form."""
    slope = degrees(atan(share * WIDE / HIGH))
    knobs = {**RESTING, **leaning(slope), "specimen.patch_points": points}
    result = findings.note(f"{points}, leaning by {slope:.3g} deg", result_of(SCENE, knobs))
    return float(result.summary["rotation_max_rad"]) / tilt(share)


def slowed(findings: Findings, points: str) -> float:
    """Loss of spin about the normal by friction, over the closed form."""
    result = findings.note(f"{points}, spinning", result_of(SCENE, {**TURNING, "specimen.patch_points": points}))
    mass = DENSITY * WIDE**3
    inertia = mass * WIDE**2 / 6.0
    left = sqrt(2.0 * float(result.history.rows["kinetic"][-1]) / inertia)
    lever = (sqrt(2.0) + log(1.0 + sqrt(2.0))) / 6.0 * WIDE
    return (SPIN - left) / (FRICTION * mass * G * lever / inertia * WHILE)


def run() -> Findings:
    """Tilt of a closed and an open joint, and spin, with points at the corners and spread."""
    findings = Findings()
    at_corners = sqrt(2.0) * HALF / ((sqrt(2.0) + log(1.0 + sqrt(2.0))) / 6.0 * WIDE)
    tolerance = Tolerance(5e-4, 1e-4, "all moments of area are exact")
    findings.check("tilt of a closed joint", "1", tilted(findings, "spread", CLOSED), 1.0, tolerance)
    tolerance = Tolerance(0.1, 0.07, "two rows of points on either side of the middle")
    findings.check("tilt of an open joint", "1", tilted(findings, "spread", OPEN), 1.0, tolerance)
    tolerance = Tolerance(0.02, 0.006, "four points inside and four at the corners")
    findings.check("friction on a spin", "1", slowed(findings, "spread"), 1.0, tolerance)
    tolerance = Tolerance(5e-4, 1e-4, "half of the area on either edge", "same discretisation")
    value = tilted(findings, "corners", CLOSED)
    findings.check("tilt of a closed joint, corners alone", "1", value, 1.0 / 3.0, tolerance)
    tolerance = Tolerance(0.01, 1e-3, "all of the area on the corners", "same discretisation")
    findings.check("friction on a spin, corners alone", "1", slowed(findings, "corners"), at_corners, tolerance)
    return findings


CASE = Case(
    name="dry-joint-in-bending",
    row="A39",
    title="A dry joint that stays closed, opens, and twists",
    area="Friction and stability",
    run=run,
    scene=SCENE,
    no_problems="it is at rest, and its stiffness is checked itself",
)
