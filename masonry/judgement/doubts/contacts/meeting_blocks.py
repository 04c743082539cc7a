"""Did blocks meet that have no joint? In small displacement contacts are found once, before the run."""

from masonry.judgement.doubt import Criterion

MEETING = Criterion(
    name="meeting",
    measure=lambda evidence: bool(evidence.summary.get("met")),
    sentence=lambda evidence, _: f"{evidence.summary['met']}: nothing holds them apart",
    advice=lambda evidence: 'take displacements = "large"' if evidence.grows else "",
)
