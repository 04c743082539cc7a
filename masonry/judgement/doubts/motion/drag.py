"""Does damping hold up the peak? Its force over that of the drive, at the peak: the peak may be too high by as much.

Where contacts are dry, what was not borne steadily, as inertia of what lifts off holds it up as well.

The limit is the accuracy that the drive was asked for.
"""

from masonry.judgement.doubt import Criterion
from masonry.judgement.words import percent

DRAG = Criterion(
    name="drag_at_peak",
    measure=lambda evidence: evidence.number("control.drag_at_peak"),
    limit=lambda evidence: evidence.accuracy(1.0),
    sentence=lambda evidence, value: (
        f"damping took {percent(min(value, 1.0))} of the force at the peak, which may be too high by as much"
    ),
    advice="ask for a smaller accuracy",
    asked_of=lambda evidence: "drag_at_peak" in evidence.table("control"),
)
