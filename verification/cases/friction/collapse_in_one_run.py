"""The load at which dry structures fall, by simulation in one run beside limit analysis: two answers, each alone.

    a run       encloses the factor between the greatest under which the specimen came to rest and the least under
                which it did not, 0.5 % apart
    the bound   the largest factor that forces in the joints can balance; exact where what slides dilates by its
                friction angle, and where nothing slides
    no dilation the factor to which friction without dilation comes on the way from the dead loads, which is no bound

A run without dilation must come to within 1 % of the last, and not beyond the bound; one that does not slide, or that
dilates by its friction angle, to the bound.
"""

import time
from math import atan, degrees
from typing import Any

import numpy as np

import masonry
from verification.case import Case, Findings, Line, Tolerance
from verification.fixtures.walls_with_openings import wall_3, wall_of
from verification.scene_runs import load
from verification.scene_runs import run as run_scene

ACCURACY = 0.005
ARCH, WALL = "arch-of-oppenheim", "wall-tilted"
WAITS: dict[str, Any] = {"gravity.tilt": None, "solver": {}, "curve": None, "assumptions": {}}
"""Ground that tilts slowly in the scene tilts by trials."""


def pattern(**limit: Any) -> dict[str, Any]:
    """Another load that grows."""
    return {"limit": {**limit, "accuracy": ACCURACY}}


def dilating(tangent: float) -> dict[str, Any]:
    """Keys of contacts between units that rise by their friction angle as they slide."""
    contact = {
        "tensile_strength": "0 Pa",
        "cohesion": "0 Pa",
        "tan_friction_angle": tangent,
        "tan_residual_friction_angle": tangent,
        "dilation_angle": f"{degrees(atan(tangent)) - 1e-9!r} deg",
        "dilation_cutoff": "0.1 m",
    }
    return {"law": "brittle", **{f"contact.unit_unit.{key}": value for key, value in contact.items()}}


def made_up(seed: int) -> dict[str, Any]:
    """Keys of a wall with openings that dilates by its friction."""
    wall, friction = wall_of(seed)
    return {**wall, **dilating(friction)}


DILATES = dilating(0.65)
EXACT: dict[str, tuple[str, dict[str, Any]]] = {
    "arch tilted": (ARCH, {}),
    "arch tilted, large displacement": (ARCH, {"displacements": "large"}),
    "arch of affine blocks": (
        ARCH,
        {"kinematics": "affine", "material.units.young_modulus": "20 GPa", "material.units.poisson_ratio": 0.2},
    ),
    "arch under a force at its crown": (ARCH, pattern(pattern="force", on="keystone", force={"z": "-1 kN"})),
    "wall tilted about its length": (WALL, pattern(pattern="tilt", about="x")),
    "wall tilted, dilating by its friction": (WALL, DILATES),
    "wall with a window tilted, dilating by its friction": (WALL, {**wall_3(), **DILATES}),
    "wall with two openings tilted, dilating by its friction": (WALL, made_up(14)),
    "stack of drums tilted": (
        "column-pushed",
        {**pattern(pattern="tilt", about="y"), "drive": None, "assumptions": {}},
    ),
    "strip between floors, tilted": (
        "wall-out-of-plane",
        {**WAITS, "limit.accuracy": ACCURACY, "specimen.contact_points": "vertex"},
    ),
    "dome tilted, dilating by its friction": (
        "dome-own-weight",
        {**dilating(0.7), "limit.accuracy": ACCURACY, "specimen.courses": 8, "specimen.voussoirs": 16},
    ),
}
"""Nothing slides there, or it dilates: the bound is the answer."""
BETWEEN: dict[str, tuple[str, dict[str, Any]]] = {
    "wall tilted": (WALL, {}),
    "wall with a window tilted": (WALL, wall_3()),
    "wall pushed at its top": (WALL, pattern(pattern="traction", on="top course.z+", stress={"x": "1 kPa"})),
    "arch with little friction": (ARCH, {"contact.unit_unit.tan_friction_angle": 0.25}),
    "facade of two returns tilted": ("facade-tilted", {**WAITS, "limit.accuracy": ACCURACY}),
    "arch pulled up at its crown": (ARCH, pattern(pattern="force", on="keystone", force={"z": "1 kN"})),
}
"""What slides there does not dilate."""


def run() -> Findings:
    """Both answers of seventeen scenes, with the seconds of each."""
    findings, both = Findings(), []
    for name, (base, changes) in (EXACT | BETWEEN).items():
        wanted = load(base, changes)
        begun = time.perf_counter()
        bound = masonry.limit(wanted).factor
        by_limit, begun = time.perf_counter() - begun, time.perf_counter()
        result = findings.note(name, run_scene(base, changes))
        collapse, seconds = result.summary["collapse_load"], time.perf_counter() - begun
        middle = 0.5 * (collapse["borne"] + collapse["falls"])
        both.append((bound, middle))
        findings.remarks.append(
            f"{name}: a run {collapse['borne']:.6g} to {collapse['falls']:.6g} in {result.summary['steps']} steps and "
            f"{seconds:.1f} s, compile included; limit analysis {bound:.6g} in {by_limit:.2f} s"
        )
        reason = "all come to rest or fall"
        findings.at_most(f"trials of {name} that did not end", "1", collapse["undecided"], 0.0, reason)
        mismatch = result.summary["dissipation_mismatch"]
        findings.at_most(f"what laws and contacts disagree on, {name}", "1", mismatch, 0.01, "the limit of trust")
        if name in EXACT:
            tolerance = Tolerance(0.01, 0.5 * ACCURACY, "half the interval", "limit analysis")
            findings.check(f"load factor, {name}", "1", middle, bound, tolerance)
            continue
        least = masonry.limit(wanted, dilation=False).factor
        findings.at_most(f"load factor borne, {name}", "1", collapse["borne"], bound, "the bound of limit analysis")
        findings.at_most(f"0.99 times that without dilation, {name}", "1", 0.99 * least, collapse["falls"], "less 1 %")
        findings.at_most(f"0.99 of the load factor borne, {name}", "1", 0.99 * collapse["borne"], least, "more by 1 %")
    by_bound, by_run = np.array(both).T
    dilates, ends = np.array([name in EXACT for name in EXACT | BETWEEN]), np.array([by_bound.min(), by_bound.max()])
    findings.plot(
        "Factors by a run and by limit analysis",
        "load factor by limit analysis (1)",
        "load factor by a run (1)",
        Line("both alike", ends, ends, "dashed"),
        Line("nothing slides, or it dilates", by_bound[dilates], by_run[dilates], "points"),
        Line("slides without dilation", by_bound[~dilates], by_run[~dilates], "points"),
        log=True,
    )
    return findings


CASE = Case(
    name="collapse-in-one-run",
    row="A36",
    title="Collapse loads by simulation, beside limit analysis",
    area="Friction and stability",
    run=run,
    quick=False,
    scene=ARCH,
    no_problems="the interval of each run is its error",
)
