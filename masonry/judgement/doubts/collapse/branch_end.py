"""Was the gauge led to limit.until behind the collapse? If not, why not."""

from masonry.judgement.doubt import Criterion
from masonry.judgement.evidence import Evidence

SHORT = {
    "stays": ("the collapse hardly moves {gauge}, so it was not controlled", "control one that the mechanism moves"),
    "other way": (
        "the collapse moves {gauge} away from limit.until, so it was not controlled",
        "turn the sign of limit.until",
    ),
    "passed": ("{gauge} read {start:.4g} mm before the fall, beyond limit.until, so it was not controlled", ""),
    "up_to": ("the factor came to limit.up_to where {gauge} was at {end:.4g} mm, short of limit.until", ""),
    "runs away": ("{gauge} could not be controlled: at {end:.4g} mm it ran away although nothing pushed any more", ""),
    "turned": (
        "a block turned by more than solver.rotation_limit where {gauge} was at {end:.4g} mm, short of limit.until",
        'take displacements = "large"',
    ),
    "too far": (
        "blocks had crushed, slid or met too far to go on where {gauge} was at {end:.4g} mm, short of limit.until",
        "",
    ),
    "late": ("{gauge} came no further than {end:.4g} mm in {steps} steps", ""),
}
"""By how the branch ended: the sentence, and the advice."""


def sentence(evidence: Evidence, _: float) -> str:
    """With the gauge and what it read, in mm."""
    branch = evidence.branch
    numbers = {"start": 1e3 * branch["from_m"], "end": 1e3 * branch["reached_m"], "steps": branch["steps"]}
    return SHORT[branch["ends"]][0].format(gauge=f"gauge '{branch['gauge']}'", **numbers)


BRANCH_END = Criterion(
    name="branch_end",
    measure=lambda evidence: evidence.branch.get("ends") in SHORT,
    sentence=sentence,
    advice=lambda evidence: SHORT[evidence.branch["ends"]][1],
    asked_of=lambda evidence: bool(evidence.branch),
)
