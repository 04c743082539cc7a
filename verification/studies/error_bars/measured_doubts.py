"""Measures of each doubt that a run was asked, whether it was raised or not."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from masonry.judgement.catalogue import criteria
from masonry.judgement.evidence import Evidence
from masonry.judgement.judgement import judgement_of
from masonry.results.summary import read_summary


@dataclass(frozen=True)
class Indicator:
    """Name of a doubt, what was measured, the limit that it is compared with, and whether it was raised; None where the
    doubt is no matter of a number."""

    name: str
    value: float | None
    limit: float | None
    is_raised: bool

    def as_keys(self) -> dict[str, Any]:
        """The same for JSON."""
        return asdict(self)


def indicators_of(folder: Path) -> tuple[Indicator, ...]:
    """Of the folder of a run: those that were raised, the largest first, then those that were asked and not."""
    summary = read_summary(folder / "summary.json")
    doubts = judgement_of(summary).doubts
    raised = [Indicator(doubt.name, doubt.value, doubt.limit, True) for doubt in doubts]
    return (*raised, *_quiet(summary, {doubt.name for doubt in doubts}))


def _quiet(summary: Mapping[str, Any], raised: set[str]) -> list[Indicator]:
    evidence = Evidence(summary)
    others = [criterion for criterion in criteria() if criterion.name not in raised and criterion.asked_of(evidence)]
    quiet = []
    for criterion in others:
        value = criterion.measure(evidence)
        if value is not None and not isinstance(value, bool):
            limit = criterion.limit(evidence) if callable(criterion.limit) else criterion.limit
            quiet.append(Indicator(criterion.name, float(value), limit, False))
    return quiet
