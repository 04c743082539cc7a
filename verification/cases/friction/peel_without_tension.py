"""A unit with cohesion and no tensile strength is pushed until it peels off its joint, row by row, and rocks.

    F = N e / (h/2) at the end, as for a unit that rocks; before that each row of contacts that opens loses its cohesion
    at once, which is a sudden crack. The peak is that of the converged run at a constant rate.

The drive must be bounded from the first opening on, not only from the first fracture energy: else it overruns the peak.
"""

from masonry.judgement.judgement import judgement_of
from verification.case import Case, Findings, Tolerance
from verification.scene_runs import result_of

SCENE = "peel-without-tension"
CONVERGED = {"drive.steps": 400_000}
REASON = "what an accuracy of 1 % promises of the peak, and of the force at the end"


def run() -> Findings:
    """Peak and end at 1 % against 400,000 steps, and what the sentence of trust says."""
    findings = Findings()
    slow = findings.note("400,000 steps", result_of(SCENE, CONVERGED)).summary
    paced = findings.note("accuracy 1 %", result_of(SCENE)).summary
    for quantity, key, expected in (("peak", "peak_stress_pa", 0.004), ("end", "final_stress_pa", 0.003)):
        tolerance = Tolerance(0.01, expected, REASON, "converged run")
        findings.check(f"stress at the {quantity}", "Pa", paced[key], slow[key], tolerance)
    silent = float(all(doubt.name != "sudden_cracks" for doubt in judgement_of(paced).doubts))
    findings.at_most("no word on sudden cracks", "1", silent, 0.0, "they released 12 % of the work")
    return findings


CASE = Case(
    name="peel-without-tension",
    row="A26",
    title="A unit without tensile strength peels off",
    area="Quasi-static loading",
    run=run,
    quick=True,
    scene=SCENE,
    no_problems="an accuracy and a rate stand beside each other in the case itself",
)
