"""Did the specimen leap ahead of its gauge behind the collapse? It does where it fails faster than the load falls."""

from masonry.judgement.doubt import Criterion

BRANCH_LEAPS = Criterion(
    name="branch_leaps",
    measure=lambda evidence: evidence.number("collapse_load.branch.leaps"),
    sentence=lambda evidence, value: (
        f"the specimen leapt ahead of gauge '{evidence.branch['gauge']}' {value:g} times behind the collapse, as it "
        "failed faster than the load can be reduced: what broke meanwhile depends on the damping of its motion"
    ),
    asked_of=lambda evidence: bool(evidence.branch),
)
