"""Whether a run ended at rest."""

from masonry.assembly.assemble import Assembly
from masonry.loading.scheduled import STILL
from masonry.monitors.unrest import left_of_motion
from masonry.rows.rest_criterion import LONE
from masonry.timeloop.recording import Outcome


def unrest(assembly: Assembly, outcome: Outcome) -> list[str]:
    """One line where a run that was to end at rest came to the end of its duration before."""
    kinetic = outcome.history.rows["kinetic"]
    if assembly.scene.solver.until is None:
        return []
    advice = "give a longer solver.duration, or a normal_dashpot to what hits and rocks"
    if kinetic[-1] > STILL * kinetic.max():
        return [
            "when the run ended not all was at rest, as solver.until asks: "
            f"{kinetic[-1] / kinetic.max():.2g} of the largest kinetic energy is left; {advice}"
        ]
    left = left_of_motion(assembly.model, float(kinetic.max()))
    block = int(left.argmax())
    if assembly.plan.ends_before(outcome.steps) or left[block] <= LONE**2 * STILL:
        return []
    where = ", ".join(f"{x:.4g}" for x in assembly.model.layout.centroid[block])
    return [
        f"when the run ended block {block}, which began at ({where}) m, was not at rest, as solver.until asks: its "
        f"kinetic energy is {left[block]:.2g} of its part of the largest, or of its weight times its size; {advice}"
    ]
