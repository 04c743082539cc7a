"""Doubts about the numbers of a run: a doubt, and the criterion by which it is raised."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from masonry.judgement.evidence import Evidence
from masonry.judgement.words import percent

SOUND, WITH_CARE, STOPPED = "sound", "with care", "stopped"
"""The verdicts, from the best to the worst: nothing speaks against a run, something does, it ended before its end."""
VERDICTS = (SOUND, WITH_CARE, STOPPED)


POINTS, TETS, PACE, TIME_STEP = "points", "size of tets", "pace", "time step"
"""Resolutions of `masonry converge` whose error a doubt may tell."""


class Doubt(NamedTuple):
    """Doubt about the numbers of a run, as `summary.json` has it.

    name        of the criterion
    value       what was measured; None where the doubt is no matter of a number
    limit       what it should have stayed within, in the same unit
    sentence    what is wrong
    advice      what to do about it; "" where nothing helps
    resolution  whose error it tells; "" where it tells another one
    """

    name: str
    value: float | None
    limit: float | None
    sentence: str
    advice: str = ""
    resolution: str = ""

    @property
    def excess(self) -> float:
        """How many times the value is beyond its limit, a largest or a least one; infinite without numbers."""
        if self.value is None or not self.limit or not self.value:
            return math.inf
        ratio = abs(self.value / self.limit)
        return max(ratio, 1.0 / ratio) if math.isfinite(ratio) else math.inf

    @property
    def line(self) -> str:
        """The sentence and the advice."""
        return f"{self.sentence}; {self.advice}" if self.advice else self.sentence


class Criterion(NamedTuple):
    """A question that is asked of a run, and its limit, in a file of `masonry/judgement/doubts/` that has its reason.

    name        of the doubt
    measure     a number, whose limit is a largest one; or whether something happened. None where it was not measured
    limit       a number, or what it is in a run; without one any number but 0 is a doubt
    sentence    with {value}, {limit} and {percent} (the value in per cent), or a function of evidence and value
    advice      what to do about it
    asked_of    whether a run is asked at all
    unknown     the sentence where it was not measured, or a function of evidence; "" where that is no doubt
    verdict     to which the doubt leads
    resolution  whose error it tells; "" where it tells another one
    """

    name: str
    measure: Callable[[Evidence], float | bool | None]
    sentence: str | Callable[[Evidence, float], str]
    limit: float | Callable[[Evidence], float | None] | None = None
    advice: str | Callable[[Evidence], str] = ""
    asked_of: Callable[[Evidence], bool] = lambda evidence: True
    unknown: str | Callable[[Evidence], str] = ""
    verdict: str = WITH_CARE
    resolution: str = ""

    def doubt(self, evidence: Evidence) -> Doubt | None:
        """The doubt that a run raises; None where all is well, where it is not asked, and where it was not measured."""
        if not self.asked_of(evidence):
            return None
        value = self.measure(evidence)
        if value is None:
            words = self.unknown(evidence) if callable(self.unknown) else self.unknown
            return Doubt(self.name, None, None, words, resolution=self.resolution) if words else None
        limit = self.limit(evidence) if callable(self.limit) else self.limit
        if not value > (limit or 0.0):
            return None
        advice = self.advice(evidence) if callable(self.advice) else self.advice
        number = None if isinstance(value, bool) else float(value)
        words = self._words(evidence, value, limit)
        return Doubt(self.name, number, limit, words, advice, self.resolution)

    def _words(self, evidence: Evidence, value: float, limit: float | None) -> str:
        if callable(self.sentence):
            return self.sentence(evidence, value)
        words: dict[str, Any] = {"value": value, "limit": limit, "percent": percent(value)}
        return self.sentence.format(**words)
