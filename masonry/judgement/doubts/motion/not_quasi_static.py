"""Is the test slow enough to be static? What motion makes of its forces, each over a limit of its own; the one that is
furthest beyond counts. Random scenes that were driven too fast went beyond several at once, so that they are one doubt.

- The stress is read at the drive: it is uncertain by what the other end reads otherwise. A test is read to 1 or 2 %.
- 5 to 10 % of kinetic energy is the usual limit of quasi-static analyses by explicit integration; the lower one counts.
- What damping takes, without what sudden cracks released, the force of the drive has to bring up: 2 % of the work is
  2 % of the force. It adds energy where it pulls along what lags behind the drive; kinetic energy counts with it, which
  a slow run has little of, so that 1 % is more than a slow run has.
- By what damping takes of the force at the peak, and of dry contacts by what was not borne steadily, the peak is too
  high: the accuracy that the drive was asked for.
"""

from collections.abc import Callable
from typing import NamedTuple

from masonry.judgement.doubt import PACE, Criterion
from masonry.judgement.doubts.motion.quasi_static import acts_slowly, slower
from masonry.judgement.evidence import Evidence
from masonry.judgement.words import percent

KINETIC = 0.05
"""Of the energy that the specimen took up."""


class Sign(NamedTuple):
    """Sign of a test that is dynamic.

    number   of a run         limit  of it            words  with {value}, {percent} and {limit}
    asked_of  whether a run is asked      unknown  the sentence where it was not measured; "" where that is no doubt
    """

    number: Callable[[Evidence], float | None]
    limit: Callable[[Evidence], float]
    words: str
    asked_of: Callable[[Evidence], bool]
    unknown: str = ""
    advice: Callable[[Evidence], str] = slower


def gain(evidence: Evidence) -> float | None:
    """Energy that damping added, over the work."""
    loss = evidence.number("damping_over_external")
    return None if loss is None else -loss


def smaller_accuracy(evidence: Evidence) -> str:
    """Advice for a drive that is paced by its error."""
    return "ask for a smaller accuracy"


SIGNS = (
    Sign(
        lambda evidence: evidence.number("reaction_mismatch_max"),
        lambda evidence: 0.02,
        "the forces at drive and support differ by {value:.2g} of the peak (should be under {limit:g})",
        acts_slowly("reaction_mismatch_max"),
        "no force at drive or support was measured: the drive met nothing, or the run ended before it did",
    ),
    Sign(
        lambda evidence: evidence.number("kinetic_over_internal_max"),
        lambda evidence: KINETIC,
        "the kinetic energy reaches {value:.2g} of the internal energy (should be under {limit:g})",
        acts_slowly("kinetic_over_internal_max"),
        "the kinetic energy is not known",
    ),
    Sign(
        lambda evidence: evidence.number("damping_over_external"),
        lambda evidence: 0.02,
        "damping takes {value:.2g} of the work (should be under {limit:g})",
        acts_slowly("damping_over_external"),
    ),
    Sign(
        gain,
        lambda evidence: 0.01,
        "damping added {percent} of the work and removed none",
        lambda evidence: not evidence.in_real_time and (evidence.has_drive or gain(evidence) is not None),
        advice=smaller_accuracy,
    ),
    Sign(
        lambda evidence: evidence.number("control.drag_at_peak"),
        lambda evidence: evidence.accuracy(1.0),
        "damping took {percent} of the force at the peak, which may be too high by as much",
        lambda evidence: "drag_at_peak" in evidence.table("control"),
        advice=smaller_accuracy,
    ),
)


def signs(evidence: Evidence) -> list[tuple[Sign, float, float]]:
    """Those that a run is asked, with their numbers and limits, the furthest beyond first."""
    numbers = [(sign, sign.number(evidence), sign.limit(evidence)) for sign in SIGNS if sign.asked_of(evidence)]
    measured = [(sign, value, limit) for sign, value, limit in numbers if value is not None]
    return sorted(measured, key=lambda number: -number[1] / number[2])


def unknown(evidence: Evidence) -> list[str]:
    """Sentences on each that a run is asked and whose number it lacks."""
    return [sign.unknown for sign in SIGNS if sign.asked_of(evidence) and sign.number(evidence) is None]


def worst(evidence: Evidence) -> float | None:
    """The number that is furthest beyond its limit; None where none is and one was not measured."""
    measured = signs(evidence)
    is_beyond = bool(measured) and measured[0][1] > measured[0][2]
    return measured[0][1] if is_beyond or (measured and not unknown(evidence)) else None


def sentence(evidence: Evidence, value: float) -> str:
    """All that are beyond their limits."""
    exceeded = [(sign, number, limit) for sign, number, limit in signs(evidence) if number > limit]
    words = [sign.words.format(value=n, limit=limit, percent=percent(min(n, 1.0))) for sign, n, limit in exceeded]
    return f"not quasi-static: {', and '.join(words)}"


NOT_QUASI_STATIC = Criterion(
    name="not_quasi_static",
    measure=worst,
    limit=lambda evidence: signs(evidence)[0][2],
    sentence=sentence,
    advice=lambda evidence: signs(evidence)[0][0].advice(evidence),
    asked_of=lambda evidence: any(sign.asked_of(evidence) for sign in SIGNS),
    unknown=lambda evidence: "; ".join(filter(None, unknown(evidence))),
    resolution=PACE,
)
