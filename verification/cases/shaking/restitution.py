"""A block hits a held slab, or another block, flat: it keeps the share of the speed that the contact asks for.

      | v0          contact.unit_unit.restitution = e;   on a spring and a dashpot that cannot pull, zeta of critical
     _v__           e = exp(-(pi - 2 a) tan a), sin a = zeta: the dashpot follows from it, for the mass of both,
    |____|          m1 m2/(m1 + m2), or of the one that moves
    |____|          speeds after it over the speed before:   v2 - v1 = e v0

Reference: by hand.
"""

from verification.case import Case, Findings, Tolerance
from verification.fixtures.dry_blocks import box, slab
from verification.scene_runs import result_of

SCENE, GAP = "dry-block", 0.02
SHARES = (0.8, 0.5, 0.2)


def kept(findings: Findings, restitution: float, free: bool) -> float:
    """Speed of parting over that of meeting, of two free blocks, or of one above the slab."""
    high = 1.0 if free else 0.0
    boxes = [slab(), box("block", (-0.05, -0.1, high + 0.1 + GAP), (0.1, 0.2, 0.2), 1)]
    boxes += [box("other", (-0.05, -0.1, high), (0.1, 0.2, 0.1), 2)] if free else []
    if not free:
        boxes[1] = box("block", (-0.05, -0.1, GAP), (0.1, 0.2, 0.2), 1)
    gauges = [{"name": name, "at": name, "direction": "z"} for name in (("block", "other") if free else ("block",))]
    knobs = {
        "specimen.box": boxes,
        "contact.unit_unit.normal_dashpot": None,
        "contact.unit_unit.restitution": restitution,
        "gravity": None,
        "settle": None,
        "motion": [{"on": "block", "velocity": [0, 0, "-1 m/s"]}],
        "solver.duration": f"{2.0 * GAP!r} s",
        "solver.step_fraction": 0.2,
        "gauge": gauges,
    }
    name = f"{restitution:g}, {'two blocks' if free else 'slab'}"
    rows = findings.note(name, result_of(SCENE, knobs)).history.rows
    span = float(rows["time"][-1] - rows["time"][-5])
    speeds = [float(rows[gauge["name"]][-1] - rows[gauge["name"]][-5]) / span for gauge in gauges]
    return speeds[0] - (speeds[1] if free else 0.0)


def run() -> Findings:
    """Restitutions on a slab and between free blocks."""
    findings = Findings()
    for restitution in SHARES:
        for free in (False, True):
            words = f"restitution {restitution:g}, {'between two free blocks' if free else 'on a held slab'}"
            tolerance = Tolerance(3.5e-4, 1.2e-4, "of second order in the step, a fifth of the bound")
            findings.check(words, "1", kept(findings, restitution, free), restitution, tolerance)
    return findings


CASE = Case(
    name="restitution",
    row="A59",
    title="Blocks that keep the share of their speed that is asked for",
    area="Dynamics",
    run=run,
    scene=SCENE,
    no_problems="the closed form of `bounce`, whose error against run time is there",
)
