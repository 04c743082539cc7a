"""Fields of a frame, areas of a summary, widths of cracks, as a run shows them, against what they must be.

    fields of a frame   a block that slid under compression: displacement of corners, opening -s/kn, slip u,
                        stresses -s and tau(u), damage 1 - exp(-(u - tau_m/ks) c0/G_II)
    areas of a summary  damaged from 5 % on, broken from 95 % on: all of both joints, or nothing
    table of cycles     an elastic joint pulled twice: openings, stresses and places of the turns
    width of a crack    of faces that opened by 3 um and slid by 4 um: 5 um; closed ones show their slip alone

Reference: by hand; eqs (8), (17) of the paper.
"""

from dataclasses import replace

import numpy as np

from masonry.pictures.camera import front_view
from masonry.pictures.crack_lines import crack_lines
from verification.case import Case, Findings, Tolerance
from verification.cases.friction import triplet
from verification.references.closed_forms import Joint, shear
from verification.scene_runs import result_of

KN, PULLS = 150e9, (20e-6, 30e-6)
ROUNDING = Tolerance(1e-13, 1e-15, "sums of some products: rounding")


def of_a_frame(findings: Findings) -> None:
    """The last frame of the triplet whose middle unit has slid by 1 mm, and the cracks drawn of it."""
    joint, s = Joint(), triplet.S
    result = findings.note("triplet", result_of(triplet.SCENE))
    frame, blocks, joints = result.history.frames[-1], result.specimen.blocks, result.joints
    slip, upwards = frame.displacement, joints.normal[:, 2]
    owner = np.unique(blocks.face_points[blocks.face_start[blocks.block_face_start[1]] :][:24])
    tau = float(shear("exponential", joint, slip, s))
    harm = 1.0 - np.exp(-(slip - float(joint.peak(s)) / joint.ks) * joint.c0 / float(joint.mode_2_energy(s)))
    pairs = (
        ("displacement of the middle unit's corners along x", "m", frame.corners[owner, 0], slip, slip),
        ("opening of the joints", "m", frame.opening, -s / joint.kn, s / joint.kn),
        ("slip of the joints", "m", frame.slip, slip, slip),
        ("normal stress", "Pa", frame.normal_stress, -s, s),
        ("shear stress", "Pa", frame.shear_stress, tau, tau),
        ("damage in shear", "1", frame.damage_shear, harm, 1.0),
        ("damage", "1", frame.damage, harm, 1.0),
        ("damage in tension", "1", frame.damage_tension, 0.0, 1.0),
    )
    for name, unit, values, wanted, scale in pairs:
        worst = values[int(np.argmax(np.abs(values - wanted)))]
        tolerance = Tolerance(1e-12, 4e-13, "what the settled compression still swings by, and rounding")
        findings.check(f"frame: {name}, where it is furthest off", unit, worst, wanted, tolerance, scale=scale)
    view = front_view(blocks.points)
    for words, opening, width in (("open", 3e-6, 5e-6), ("pressed", -3e-6, 4e-6)):
        apart = replace(frame, opening=np.full(len(upwards), opening), slip=np.full(len(upwards), 4e-6))
        shown = crack_lines(joints, apart, view).opening
        value = shown[int(np.argmax(np.abs(shown - width)))]
        findings.check(f"width of a crack, {words}, where it is furthest off", "m", value, width, ROUNDING)


def of_a_summary(findings: Findings) -> None:
    """Areas that count as damaged (5 % and more) and broken (95 %), on both sides of each threshold."""
    joint, s = Joint(), triplet.S
    both = 2.0 * triplet.AREA
    for damage, broken, damaged in ((0.04, 0.0, 0.0), (0.06, 0.0, both), (0.94, 0.0, both), (0.96, both, both)):
        slip = float(joint.peak(s) / joint.ks - np.log1p(-damage) * joint.mode_2_energy(s) / joint.c0)
        few = {"drive.displacement": f"{slip!r} m", "drive.steps": 4000, "solver.rows": 20}
        summary = findings.note(f"triplet, damage {damage:g}", result_of(triplet.SCENE, few)).summary
        for name, wanted in (("broken", broken), ("damaged", damaged)):
            tolerance = Tolerance(1e-13, 1e-15, "a sum of areas: rounding")
            value = sum(summary[f"{name}_area_m2"].values())
            findings.check(f"{name} area at a damage of {damage:g}", "m2", value, wanted, tolerance, scale=both)


def of_cycles(findings: Findings) -> None:
    """An elastic joint pulled twice and let go: widest opening, greatest stress, farthest place, nothing spent."""
    cycles = findings.note("two cycles", result_of("joint-pulled-twice")).summary["cycles"]
    findings.check("cycles", "1", len(cycles), len(PULLS), Tolerance(1e-14, 0.0, "a count: exact"))
    for number, (cycle, pull) in enumerate(zip(cycles, PULLS, strict=False), start=1):
        for key, unit, wanted, scale in (
            ("widest_opening_m", "m", pull, pull),
            ("farthest_m", "m", pull, pull),
            ("highest_stress_pa", "Pa", KN * pull, KN * pull),
            ("stiffness_pa_per_m", "Pa/m", KN, KN),
            ("dissipated_j", "J", 0.0, 1e-3),
        ):
            tolerance = Tolerance(1e-12, 1e-14, "the drive turns at a step, and a row is taken there: rounding")
            findings.check(f"cycle {number}: {key}", unit, cycle[key], wanted, tolerance, scale=scale)


def run() -> Findings:
    """Frames and cracks, summaries, and cycles."""
    findings = Findings()
    for part in (of_a_frame, of_a_summary, of_cycles):
        part(findings)
    return findings


CASE = Case(
    "what-is-shown",
    "A8",
    "Fields of frames, areas of summaries and widths of cracks",
    area="Contact laws",
    run=run,
    quick=True,
    scene=triplet.SCENE,
    no_problems="what is read off a state: exact",
)
