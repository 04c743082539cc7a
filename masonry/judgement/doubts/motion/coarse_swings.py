"""Are swings followed by steps that are short beside them? The share by which they come out too wide, (w dt)^2/8; they
are too fast by a third of that. Asked of motions in real time in small displacement, where one block on a soft joint is
all there is to bound the step; not of what rests under dead loads.
"""

from masonry.judgement.doubt import TIME_STEP, Criterion
from masonry.judgement.words import percent

LIMIT = 0.01

COARSE_SWINGS = Criterion(
    name="coarse_swings",
    measure=lambda evidence: evidence.number("swing_too_wide"),
    limit=LIMIT,
    sentence=lambda evidence, value: (
        f"steps are long beside the swings, which are too wide by {percent(value)} and too fast by "
        f"{percent(value / 3.0)}"
    ),
    advice="lower solver.step_fraction",
    asked_of=lambda evidence: evidence.number("swing_too_wide") is not None,
    resolution=TIME_STEP,
)
