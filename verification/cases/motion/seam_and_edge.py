"""A block pushed over the seam of two slabs, and over the edge of the last one.

         v                         F = mu W on either slab, over the seam, and on until the centre passes the edge;
        ____                       friction dissipates mu W s; then it topples about the edge
      _|____|______ ___________    no ripple as the patch passes from one slab to the other
     |_____________|___________|

Reference: Coulomb. Codes that keep points by number, or count a shared edge twice, show ripples of force here.

Held upright and pushed beyond the edge, the block bears (mu W)^2 / (2 k_s A) of shear energy on an area A that gets
smaller. What leaves with dA is 1 / A of it, whatever the step: (mu W)^2 / (2 k_s) (1 / A_end - 1 / A_start) in all.
"""

import numpy as np

from verification.case import Case, Findings, Line, Tolerance
from verification.fixtures.dry_blocks import DENSITY, G, box
from verification.scene_runs import result_of

SCENE, FRICTION, SIZE = "dry-block", 0.5, (0.1, 0.1, 0.05)
EDGE = 0.25
"""m, end of the second slab; the block's centre starts at -0.1 m."""
KNOBS = {
    "contact.unit_unit.tan_friction_angle": FRICTION,
    "settle.steps": 20000,
    "drive": {"on": "block", "direction": "x", "displacement": "200 mm", "rate": "0.5 m/s", "ramp": 0.1},
    "solver.duration": None,
    "solver.rows": 800,
}


def boxes(start: float) -> list[dict[str, object]]:
    """Two slabs that meet at x = 0, and the block with its centre at `start` (m)."""
    return [
        box("slab", (-0.5, -0.2, -0.1), (0.5, 0.4, 0.1), 0),
        box("slab beyond", (0.0, -0.2, -0.1), (EDGE, 0.4, 0.1), 1),
        box("block", (start - 0.5 * SIZE[0], -0.05, 0.0), SIZE, 2),
    ]


def supports(*dofs: str) -> list[dict[str, object]]:
    """Both slabs held, and some dofs of the block."""
    tables: list[dict[str, object]] = [{"on": name, "fix": "all"} for name in ("slab", "slab beyond")]
    return tables + ([{"on": "block", "fix": list(dofs)}] if dofs else [])


def run() -> Findings:
    """The ripple over the seam, the loss, and where it topples."""
    findings, limit = Findings(), FRICTION * DENSITY * G * float(np.prod(SIZE))
    flat = {"specimen.box": boxes(-0.1), "support": supports("y", "rotation"), **KNOBS}
    result = findings.note("over the seam", result_of(SCENE, flat))
    rows = result.history.rows
    travel, off = rows["displacement"], np.abs(rows["force"] - limit)
    moving = (travel > 0.03) & (travel < 0.19)
    tolerance = Tolerance(1e-9, 2e-10, "friction is the weight's on any patch")
    findings.check("force on either slab and over the seam", "N", off[moving].max(), 0.0, tolerance, scale=limit)
    tolerance = Tolerance(1e-9, 2e-10, "no edge is felt at any step")
    findings.check("greatest force of all steps", "N", result.summary["peak_force_n"], limit, tolerance)
    no_blow(findings, flat, limit)
    tolerance = Tolerance(3e-4, 1e-4, "mu W s, less what the shear springs hold before it slides")
    value = rows["friction"][-1]
    findings.check("dissipated by friction", "J", value, limit * float(rows["displacement"][-1]), tolerance)
    lost = float(rows["redetection"][-1] + abs(rows["area"][-1]))
    quantity = "lost at re-detection and by areas, over friction"
    findings.at_most(quantity, "1", lost / float(rows["friction"][-1]), 1e-6, "points pass on what they hold")
    leave_with_area(findings, limit)
    free = {"specimen.box": boxes(0.1), "support": supports(), **KNOBS}
    rows = findings.note("over the edge", result_of(SCENE, free)).history.rows
    tipped = np.flatnonzero(rows["z"] < -1e-3 * SIZE[2])
    at = float(rows["displacement"][tipped[0]]) if len(tipped) else np.inf
    tolerance = Tolerance(3e-2, 1e-2, "its fall takes a while to be seen, at 0.5 m/s")
    findings.check("way of the centre at which it topples", "m", at, EDGE - 0.1, tolerance, scale=EDGE - 0.1)
    findings.plot("A block pushed over an edge", "way (mm)", "force over weight (1)",
                  Line("run", rows["displacement"] * 1e3, rows["force"] / limit * FRICTION))  # fmt: skip
    return findings


def no_blow(findings: Findings, flat: dict[str, object], limit: float) -> None:
    """The greatest force where a pressure sinks the block into the slabs, whose edges then face it from the side."""
    for pressure in (0.1, 1.0):
        load = {"on": "block.z+", "stress": {"z": f"-{pressure} MPa"}}
        pressed = findings.note(f"under {pressure:g} MPa", result_of(SCENE, flat | {"traction": [load]}))
        tolerance = Tolerance(1e-9, 2e-10, "an edge that is only sunk meets nothing")
        reference = limit + FRICTION * pressure * 1e6 * SIZE[0] * SIZE[1]
        findings.check(
            f"greatest force under {pressure:g} MPa", "N", pressed.summary["peak_force_n"], reference, tolerance
        )


def leave_with_area(findings: Findings, limit: float) -> None:
    """Loss of shear energy as the block slides off the edge upright, with two steps and two stiffnesses."""
    drive = {"on": "block", "direction": "x", "displacement": "180 mm", "rate": "0.5 m/s", "ramp": 0.1}
    upright = {"specimen.box": boxes(0.1), "support": supports("y", "rotation"), **KNOBS, "drive": drive}
    for word, ks, fraction in (("", 5.0, 0.8), (", half the step", 5.0, 0.4), (", a tenth of k", 0.5, 0.8)):
        knobs = {f"contact.unit_unit.{key}_stiffness": f"{k} GPa/m" for key, k in (("normal", 2.0 * ks), ("shear", ks))}
        run_of = result_of(SCENE, upright | knobs | {"solver.step_fraction": fraction})
        rows = findings.note(f"off the edge{word}", run_of).history.rows
        left = SIZE[1] * (EDGE - 0.1 + 0.5 * SIZE[0] - float(rows["displacement"][-1]))
        known = limit**2 / (2e9 * ks) * (1.0 / left - 1.0 / (SIZE[0] * SIZE[1]))
        lost, normal = float(rows["redetection"][-1]), abs(float(rows["area"][-1]))
        tolerance = Tolerance(1e-2, 5e-3, "patches are cut anew at each hundredth of their size")
        findings.check(f"shear energy that leaves with the area{word}", "J", lost, known, tolerance)
        reason = "a patch that is alone holds what it held"
        findings.at_most(f"normal energy that does{word}", "J", normal, 1e-9 * known, reason)


CASE = Case(
    name="seam-and-edge",
    row="A32",
    title="A block pushed over a seam and over an edge",
    area="Friction and stability",
    run=run,
    scene=SCENE,
    no_problems="friction does not depend on the step",
)
