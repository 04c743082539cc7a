"""Did blocks come loose in small displacement, where nothing leads them? What no joint holds any more flies off: how
fast says nothing of the load."""

from masonry.judgement.doubt import Criterion

CAME_LOOSE = Criterion(
    name="came_loose",
    measure=lambda evidence: bool(evidence.summary.get("came_loose")),
    sentence=lambda evidence, _: f"{evidence.summary['came_loose']}: no joint that bears anything holds it any more",
    advice='lower the loads, or take displacements = "large" to follow it further',
)
