"""Did a run that was to end at rest come to the end of its duration before? Of all blocks, and of the one that moves
most, by the kinetic energy over its largest.

The limits are those by which such a run ends (`masonry/rows/rest_criterion.py`).
"""

from masonry.estimates.inspection import Inspection
from masonry.judgement.doubt import Doubt
from masonry.monitors.unrest import left_of_motion
from masonry.rows.rest_criterion import ENDED

ADVICE = "give a longer solver.duration, or a normal_dashpot to what hits and rocks"


def doubts(inspection: Inspection) -> list[Doubt]:
    """One at most."""
    assembly, outcome = inspection.assembly, inspection.outcome
    kinetic = outcome.history.rows["kinetic"]
    if assembly.scene.solver.until is None:
        return []
    if kinetic[-1] > ENDED.energy * kinetic.max():
        share = float(kinetic[-1] / kinetic.max())
        sentence = (
            "when the run ended not all was at rest, as solver.until asks: "
            f"{share:.2g} of the largest kinetic energy is left"
        )
        return [Doubt("unrest", share, ENDED.energy, sentence, ADVICE)]
    left = left_of_motion(assembly.model, float(kinetic.max()))
    block = int(left.argmax())
    if assembly.plan.ends_before(outcome.steps) or left[block] <= ENDED.of_block.energy:
        return []
    where = ", ".join(f"{x:.4g}" for x in assembly.model.layout.centroid[block])
    sentence = (
        f"when the run ended block {block}, which began at ({where}) m, was not at rest, as solver.until asks: its "
        f"kinetic energy is {left[block]:.2g} of its part of the largest, or of its weight times its size"
    )
    return [Doubt("unrest_of_block", float(left[block]), ENDED.of_block.energy, sentence, ADVICE)]
