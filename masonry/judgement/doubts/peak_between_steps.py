"""Did the peak lie between two steps, or two rows where the drive turns back? By how much more the force may have been
there, over the peak.

The limit is the accuracy that the drive was asked for; 1 % where none was, as is usually asked of a run.
"""

from masonry.judgement.doubt import PACE, Criterion
from masonry.judgement.doubts.peak_passed import LIMIT, has_strength

MORE = "take more of drive.steps in place of drive.accuracy"
"""The steps that lead to the first crack do not go with the accuracy."""

PEAK_BETWEEN_STEPS = Criterion(
    name="peak_between_steps",
    measure=lambda evidence: evidence.number("missed_between_steps"),
    limit=lambda evidence: evidence.accuracy(LIMIT),
    sentence="the force rises and falls so fast in the steps or rows at the peak that it may be up to {percent} higher "
    "between two of them",
    advice=lambda evidence: MORE if evidence.table("control") else "take more steps, or give drive.accuracy",
    asked_of=lambda evidence: evidence.number("missed_between_steps") is not None and has_strength(evidence),
    resolution=PACE,
)
