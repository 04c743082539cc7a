"""Loads at which a wall and an arch on ties fall: by hand, by limit analysis, and by a run that encloses the load.

    wall     W t/2 + sum of N h_t = a W h/2:  it turns about its foot while both ties yield
    arch     its right springer slides freely; a tie to the left one bears its thrust, until it yields and the arch
             spreads: by limit analysis and a run. The supports bear no thrust, and the tie all of it

A tie is a force of any size up to its yield force to a limit analysis; a run has its stiffness as well.

References: by hand; Livesley (1978), as in case limit-analysis.
"""

import masonry
from verification.case import Case, Findings, Tolerance
from verification.scene_runs import load
from verification.scene_runs import run as run_scene

WEIGHT = 2200.0 * 9.81 * 3.0 * 2.4 * 0.3
YIELD, THICKNESS, HEIGHT, TIE = 13.3e6 * 1.13e-4, 0.3, 2.4, 1.65
BY_HAND = (0.5 * WEIGHT * THICKNESS + 2.0 * YIELD * TIE) / (0.5 * WEIGHT * HEIGHT)
ACCURACY = 0.005


def run() -> Findings:
    """Both, by all ways that there are."""
    findings = Findings()
    for scene in ("wall-tied", "arch-on-a-tie"):
        limit = masonry.limit(load(scene))
        if scene == "wall-tied":
            tolerance = Tolerance(1e-9, 2e-10, "the tolerance of the solver")
            findings.check("factor of the wall by limit analysis", "1", limit.factor, BY_HAND, tolerance)
        result = run_scene(scene).result
        assert result is not None
        findings.note(scene, result)
        collapse = result.summary["collapse_load"]
        middle = 0.5 * (collapse["borne"] + collapse["falls"])
        tolerance = Tolerance(0.01, 0.003, "the run encloses it to 0.5 %", "limit analysis")
        findings.check(f"load factor of {scene} by a run, beside limit analysis", "1", middle, limit.factor, tolerance)
        value = result.summary["bars"]["count"] - result.summary["bars"]["yielded"]
        findings.at_most(f"bars of {scene} that do not yield", "1", value, 0.0, "all yield as it falls")
        reactions = result.summary["reactions"]["end"]
        across, weight = (abs(reactions[name]["force_n"][k]) for name, k in (("support.0", 0), ("gravity", 2)))
        quantity = f"what the left support of {scene} bears along x, over its weight"
        findings.at_most(quantity, "1", across / weight, 0.005, "ties bear all of the thrust, half the weight and more")
    return findings


CASE = Case(
    name="ties-at-their-limit",
    row="A68",
    title="Walls and arches on ties fall as limit analysis says",
    area="Friction and stability",
    run=run,
    quick=True,
    scene="wall-tied",
    no_problems="a run that seeks a collapse to an accuracy",
)
