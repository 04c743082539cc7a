"""How far the numbers of a run may be trusted, as data: a verdict of one word, and the doubts behind it."""

import math
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from masonry.judgement.catalogue import criteria
from masonry.judgement.doubt import SOUND, STOPPED, VERDICTS, WITH_CARE, Doubt
from masonry.judgement.evidence import Evidence


class Judgement(NamedTuple):
    """Assessment of a run.

    verdict       "sound", "with care" (there are doubts), or "stopped" (the run ended before its end)
    doubts        that it ended early first, then those without numbers, then by how far the value is beyond its limit
    not_measured  names of criteria that the run should have met, and whose numbers its summary lacks
    """

    verdict: str
    doubts: tuple[Doubt, ...]
    not_measured: tuple[str, ...]

    def as_keys(self) -> dict[str, Any]:
        """The same as keys of summary.json."""
        doubts = [doubt._asdict() for doubt in self.doubts]
        return {"verdict": self.verdict, "doubts": doubts, "not_measured": list(self.not_measured)}


def judge(summary: Mapping[str, Any], others: Iterable[Doubt] = ()) -> Judgement:
    """The judgement of a run by the numbers of its summary, and by doubts that were measured elsewhere."""
    evidence = Evidence(summary)
    questions = [criterion for criterion in criteria() if criterion.asked_of(evidence)]
    answers = [
        (criterion.verdict, doubt) for criterion in questions if (doubt := criterion.doubt(evidence)) is not None
    ]
    every = [*((WITH_CARE, doubt) for doubt in others), *answers]
    every.sort(key=lambda one: (one[0] != STOPPED, -one[1].excess))
    verdict = max((verdict for verdict, _ in every), key=VERDICTS.index, default=SOUND)
    unknown = tuple(criterion.name for criterion in questions if criterion.measure(evidence) is None)
    return Judgement(verdict, tuple(doubt for _, doubt in every), unknown)


def judgement_of(summary: Mapping[str, Any]) -> Judgement:
    """The judgement that a summary holds; one of an older result, or that cannot be read, is judged now, with its
    `warnings` as doubts."""
    lines = summary.get("warnings")
    warnings = [line for line in lines if isinstance(line, str)] if isinstance(lines, list) else []
    return _read(summary) or judge(summary, [Doubt("warning", None, None, line) for line in warnings])


def _read(summary: Mapping[str, Any]) -> Judgement | None:
    try:
        doubts = tuple(Doubt(**doubt) for doubt in summary["doubts"])
        judgement = Judgement(summary["verdict"], doubts, tuple(summary["not_measured"]))
        numbers = [number for doubt in doubts for number in (doubt.value, doubt.limit) if number is not None]
        any(map(math.isnan, numbers))  # a TypeError, where one is no number
    except (KeyError, TypeError):
        return None
    words = all(isinstance(word, str) for doubt in doubts for word in (doubt.name, *doubt[3:]))
    fits = judgement.verdict in VERDICTS and (judgement.verdict == SOUND) == (not doubts)
    return judgement if words and fits else None
