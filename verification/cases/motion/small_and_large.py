"""Walls that crack in small and in large displacement: they differ by what linear turns leave out, a share theta^2.

A turn theta moves a point at a distance r by theta r; a linear turn leaves theta^2 r / 2 out. So much may gaps differ,
which is no share theta^2 of the stress: joints open by little, and stress is their stiffness times that. So curves and
energies may differ by theta^2 h over the opening at which a joint cracks, h the size of a block, which is what turns.

Both run as one motion: the same masses, time step, contact points and drive, and without local damping, which would
enlarge rounding.

Reference: the same scene in small displacement.
"""

from typing import Any

import numpy as np

from geometry.polyhedra.measures import bounds
from masonry.laboratory.result import Result
from verification.case import Case, Findings, Tolerance
from verification.scene_runs import assembled, load, result_of

ROLLERS = {
    "contact.rollers_rollers.law": "friction",
    "contact.rollers_rollers.normal_stiffness": "250 GPa/m",
    "contact.rollers_rollers.shear_stiffness": "104 GPa/m",
    "contact.rollers_rollers.tan_friction_angle": 0.6,
}
"""Rollers never meet, but in large displacement it must be said what would happen."""
SCENES: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "wallette-mode-1-218": ({"drive.displacement": "0.03 mm", "specimen.points_per_edge": 4}, {}),
    "wallette-mode-2-218": ({"drive.displacement": "0.06 mm", "specimen.points_per_edge": 4}, {}),
    "bending-0": ({"drive.displacement": "0.1 mm"}, ROLLERS),
}
"""How far each is driven: beyond its peak; and what large displacement needs besides."""
SAME = {
    "drive.accuracy": None,
    "drive.steps": 20000,
    "solver.masses": "real",
    "solver.damping": 0,
    "specimen.contact_points": "vertex",
}
COLUMNS = ("stress", "external_work", "elastic_contacts", "fracture_mode_1", "fracture_mode_2")


def both(name: str) -> tuple[Result, Result]:
    """A scene in small and in large displacement, with the time step of the large one."""
    settings, more = SCENES[name]
    more = more | {"displacements": "large"}
    step = {"solver.time_step": f"{assembled(name, SAME | settings | more).model.dt!r} s"}
    return result_of(name, SAME | settings | step), result_of(name, SAME | settings | step | more)


def run() -> Findings:
    """Gaps, the crack, curve and energies of two wallettes and a beam."""
    findings = Findings()
    for name in SCENES:
        small, large = both(name)
        findings.note(f"{name}, small", small)
        findings.note(f"{name}, large", large)
        compare(findings, name, small, large)
    return findings


def compare(findings: Findings, name: str, small: Result, large: Result) -> None:
    """All that is held against theta^2, of one scene."""
    low, high = bounds(small.specimen.blocks)
    square = max(result.summary["rotation_max_rad"] for result in (small, large)) ** 2
    wall, block = float((high.max(axis=0) - low.min(axis=0)).max()), float((high - low).max(axis=1).mean())
    joint = load(name).contact_of("unit_unit")
    share = square * block * joint.normal_stiffness / joint.tensile_strength
    before, after = small.history.frames[-1], large.history.frames[-1]
    gaps = [float(np.abs(getattr(before, key) - getattr(after, key)).max()) for key in ("opening", "slip")]
    tolerance = Tolerance(1.0, 0.5, "theta^2 r / 2 at most, r no longer than the wall", "invariance")
    value = max(gaps) / (square * wall)
    findings.check(f"{name}: gaps, over theta^2 times the length of the wall", "1", value, 0.0, tolerance, scale=1.0)
    reason = "these are two kinds of motion"
    findings.at_most(f"{name}: openings or slips that are the same", "1", gaps.count(0.0), 0, reason)
    strong = [bool(load(name).contact_of(group).cohesion) for group in large.joint_groups]  # rollers only press
    cracked = int((np.array(strong)[large.joint_group] & ((before.damage > 0.9) != (after.damage > 0.9))).sum())
    findings.at_most(f"{name}: contacts cracked in one alone", "1", cracked, 0, "the crack is the same")
    for key in COLUMNS:
        one, other = small.history.rows[key], large.history.rows[key]
        most = float(np.abs(one - other).max() / np.abs(one).max())
        findings.at_most(f"{name}: {key}, over its largest", "1", most, share, "theta^2 h over the opening of a crack")
    peaks = [result.summary["peak_stress_pa"] for result in (small, large)]
    findings.at_most(f"{name}: peak, over that in small", "1", abs(peaks[1] / peaks[0] - 1.0), share, "as the curve")
    findings.at_most(f"{name}: energy balance open by", "1", large.summary["energy_imbalance"], 1e-12, "round-off")
    for line in ("redetection", "area"):
        lost = abs(large.history.rows[line][-1]) / large.history.rows["external_work"][-1]
        findings.at_most(f"{name}: {line} over the work", "1", lost, 1e-6, "bonds hand over what they hold")


CASE = Case(
    name="small-and-large",
    row="A38",
    title="Walls that crack, in small and in large displacement",
    area="Invariance",
    run=run,
    scene="wallette-mode-1-218",
    no_problems="one motion, told twice; nothing is left to choose",
)
