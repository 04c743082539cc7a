"""Was each trial of a load decided? One that neither rests nor falls in time counts as a fall, and so does one in which
a block turns by more than small displacement allows: the factor may then be larger.
"""

from masonry.judgement.doubt import Criterion
from masonry.judgement.doubts.collapse.no_collapse import has_factor

UNDECIDED = Criterion(
    name="undecided_trials",
    measure=lambda evidence: evidence.number("collapse_load.undecided"),
    sentence="in {value:g} of the trials the specimen neither came to rest nor gathered speed in time, and counts as "
    "one that falls: the factor may be larger",
    asked_of=lambda evidence: has_factor(evidence) and evidence.falls,
)
FALLS_BY_TURNING = Criterion(
    name="falls_by_turning",
    measure=lambda evidence: bool(evidence.table("collapse_load").get("falls_by_turning")),
    sentence="at the factor that is not borne a block turned by more than solver.rotation_limit before it was seen "
    "whether the specimen falls: the factor may be larger",
    advice='take displacements = "large"',
    asked_of=has_factor,
)
