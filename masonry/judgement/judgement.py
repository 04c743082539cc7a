"""How far the numbers of a run may be trusted, as data: a verdict of one word, and the doubts behind it."""

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from masonry.judgement.catalogue import criteria
from masonry.judgement.doubt import SOUND, VERDICTS, WITH_CARE, Doubt
from masonry.judgement.evidence import Evidence


class Judgement(NamedTuple):
    """What is to be thought of a run.

    verdict       "sound", "with care" (there are doubts), or "stopped" (the run ended before its end)
    doubts        those without numbers first, then by how far the value is beyond its limit
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
    evidence, doubts = Evidence(summary), list(others)
    verdict = WITH_CARE if doubts else SOUND
    questions = [criterion for criterion in criteria() if criterion.asked_of(evidence)]
    for criterion in questions:
        if (doubt := criterion.doubt(evidence)) is not None:
            doubts.append(doubt)
            verdict = max(verdict, criterion.verdict, key=VERDICTS.index)
    unknown = tuple(criterion.name for criterion in questions if criterion.measure(evidence) is None)
    return Judgement(verdict, tuple(sorted(doubts, key=lambda doubt: -doubt.excess)), unknown)


def judgement_of(summary: Mapping[str, Any]) -> Judgement:
    """The judgement that a summary holds; one of an older result is judged now, with its `warnings` as doubts."""
    if summary.get("doubts") is not None:
        doubts = tuple(Doubt(**doubt) for doubt in summary["doubts"])
        return Judgement(summary["verdict"], doubts, tuple(summary["not_measured"]))
    return judge(summary, [Doubt("warning", None, None, line) for line in summary.get("warnings") or []])
