"""A block that slides on a level table, or down a slope, under records of the ground.

    u'' = -a - mu g sign(u') while it slides; it sticks while |a| <= mu g       table: to and fro
    u'' = -a - k, u' >= 0                                                       slope: one way down

The ground's acceleration is straight between samples, so that each interval is solved exactly
(`verification/references/sliding.py`). The records are made by seed; recorded ones are taken besides where the folder
that the environment variable MASONRY_RECORDS names has them: Kobe 1995 TAK-090 and Imperial Valley 1979 BCR-230, for
which slips are known to six digits.

Reference: Newmark (1965), Geotechnique 15, 139.
"""

import os
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from masonry.ground.ground_motion import Motion
from verification.case import Case, Findings, Tolerance
from verification.references.sliding import Slip, slide
from verification.scene_runs import load, result_of

SCENE = "block-on-ground"
G = 9.80665
FOLDER = "MASONRY_RECORDS"
MADE: dict[str, Any] = {"spectrum": "kanai-tajimi", "duration": "12 s", "peak": "0.4 g"}
RECORDS = {"Kobe": "Kobe_1995_TAK-090.csv", "Imperial Valley": "Imperial_Valley_1979_BCR-230.csv"}
SLOPE, YIELD = np.radians(30.0), 0.1
WHY = "where the slip turns, the joint gives back what it held: mu g times its period too fast; of the largest slip"
DIGIT = "the last digit that is printed"


class LevelSlip(NamedTuple):
    """A record on a level table: largest acceleration over g, friction, and slips at the end, least and most (cm)."""

    record: str
    peak: float
    friction: float
    known: tuple[float, float, float]


LEVELS = (
    LevelSlip("Kobe", 0.4, 0.1, (5.27555, -11.90720, 15.95440)),
    LevelSlip("Kobe", 0.5, 0.05, (27.65271, -33.87431, 29.74853)),
    LevelSlip("Kobe", 0.4, 0.2, (-6.19640, -7.74997, 0.25706)),
    LevelSlip("Imperial Valley", 0.4, 0.1, (-3.27638, -3.69671, 2.24453)),
    LevelSlip("Imperial Valley", 0.5, 0.05, (1.38755, -2.82523, 8.71700)),
)
DOWN = {"Imperial Valley": (8.849, 11.647), "Kobe": (62.90, 72.46)}
"""cm, one way down, of the record towards +x and of its mirror."""


def recorded(name: str) -> dict[str, Any] | None:
    """The keys of [ground] for a recorded motion, where the folder has it."""
    folder = os.environ.get(FOLDER)
    file = Path(folder) / RECORDS[name] if folder else None
    return {"record": str(file), "x": "acceleration"} if file is not None and file.is_file() else None


def motion_of(ground: dict[str, Any]) -> Motion:
    """Motion of the ground along x."""
    shaken = load(SCENE, {"ground": ground}).shaken
    assert shaken is not None
    return shaken.motions["x"]


def slips(findings: Findings, name: str, keys: dict[str, Any]) -> Slip:
    """Of a run."""
    rows = findings.note(name, result_of(SCENE, {"solver.rows": 4000, **keys})).history.rows
    return Slip(float(rows["slip"][-1]), float(rows["slip"].min()), float(rows["slip"].max()))


def level(findings: Findings, name: str, ground: dict[str, Any], friction: float) -> Slip:
    """A block on a level table against the exact slips."""
    motion = motion_of(ground)
    wanted = slide(motion.time, motion.acceleration, friction * G, friction * G)
    made = slips(findings, name, {"ground": ground, "contact.table_units.tan_friction_angle": friction})
    most = max(abs(wanted.minimum), wanted.maximum)
    worst = max(abs(value - reference) for value, reference in zip(made, wanted, strict=True))
    words = f"{name}: slip at the end, least and most, the worst difference from the exact ones"
    findings.check(words, "m", worst, 0.0, Tolerance(1.5e-3, 4e-4, WHY, "converged run"), scale=most)
    return wanted


def down_a_slope(findings: Findings, name: str, ground: dict[str, Any], sides: tuple[float, ...]) -> list[float]:
    """One way down, of the record and of its mirror, in the plane of the base."""
    friction = np.tan(SLOPE) + YIELD / np.cos(SLOPE)
    gravity = {"x": f"{float(G * np.sin(SLOPE))!r} m/s^2", "z": f"{float(-G * np.cos(SLOPE))!r} m/s^2"}
    far = []
    for side in sides:
        mirrored = {key: value for key, value in ground.items() if key != "peak"}
        motion = motion_of(ground)
        own = motion_of(mirrored)
        mirrored["scale"] = side * motion.peak_acceleration / own.peak_acceleration
        motion = motion_of(mirrored)
        wanted = slide(motion.time, motion.acceleration, YIELD * G, 1e9).end
        words = f"{name}, {'as it is' if side > 0 else 'mirrored'}, down a slope"
        keys = {"contact.table_units.tan_friction_angle": float(friction), "gravity": gravity}
        value = slips(findings, words, {"ground": mirrored, **keys}).end
        tolerance = Tolerance(1e-3, 1e-4, WHY, "converged run")
        findings.check(f"{words}: slip", "m", value, wanted, tolerance, scale=abs(wanted))
        far.append(wanted)
    return far


def recorded_levels(findings: Findings) -> None:
    """Of the table of known slips."""
    for one in LEVELS:
        if (ground := recorded(one.record)) is not None:
            name = f"{one.record} {one.peak:g} g, friction {one.friction:g}"
            slip = level(findings, name, {**ground, "peak": f"{one.peak} g"}, one.friction)
            for key, value, known in zip(Slip._fields, slip, one.known, strict=True):
                findings.at_most(f"{name}: slip, {key}, off what is known", "m", abs(value - 0.01 * known), 1e-7, DIGIT)


def recorded_slopes(findings: Findings) -> None:
    """Down a slope."""
    for name, known in DOWN.items():
        if (ground := recorded(name)) is not None:
            slips = down_a_slope(findings, name, {**ground, "peak": "0.4 g"}, (1.0, -1.0))
            for value, far in zip(slips, known, strict=True):
                words = f"{name}: slip down a slope, off what is known"
                findings.at_most(words, "m", abs(value - 0.01 * far), 1e-4, DIGIT)


def run() -> Findings:
    """Made records, and recorded ones where they are at hand."""
    findings = Findings()
    for seed, friction in ((1, 0.1), (2, 0.05)):
        made = {"made": {**MADE, "seed": seed}, "x": "first"}
        level(findings, f"made by seed {seed}, friction {friction:g}", made, friction)
    down_a_slope(findings, "made by seed 1", {"made": {**MADE, "seed": 1}, "x": "first"}, (1.0,))
    recorded_levels(findings)
    recorded_slopes(findings)
    if any(recorded(name) is None for name in RECORDS):
        findings.remarks.append(f"Recorded motions are left out: no folder of the variable {FOLDER} has them.")
    return findings


CASE = Case(
    "slip-under-records",
    "A47",
    "A block slides under records of the ground",
    area="Dynamics",
    run=run,
    scene=SCENE,
    no_problems="rigid-plastic sliding: exact but for the stiffness of the joint",
)
