"""Experiment of the paper: runs of scenes, and what they show: pictures and checked claims."""

import math
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from masonry import __version__
from masonry.jit.sources import source_hash
from masonry.laboratory.result import Result, load_result
from verification.html.page import Chapter, Verdict

ACCURACY = "drive.accuracy"
PERCENT, QUICK_PERCENT = 1.0, 4.0
"""What drives aim at: as the scenes are shipped, and for a quick look."""
PACES = (ACCURACY, "drive.steps", "drive.rate")
"""The keys of a scene that say how fast it is driven: one of them takes the place of the others."""
COARSER = "{}, at twice the loading error"
"""The label of a run made again with twice the error of loading: only its peak counts."""


@dataclass(frozen=True)
class Run:
    """A packaged scene with some of its keys set.

    pace_check  run it once more with twice the loading error, to see how far its peak moves
    sudden      why the specimen gives way at once past its peak, so that its two ends are compared before it only
    own_pace    its pace is what is looked at: it is never loaded more carefully
    """

    scene: str
    settings: Mapping[str, Any] = field(default_factory=dict)
    pace_check: bool = False
    sudden: str = ""
    own_pace: bool = False

    @property
    def paced(self) -> bool:
        """Whether it says itself how fast it is driven."""
        return any(key in self.settings for key in PACES)

    @property
    def percent(self) -> float:
        """The loading error (%) that it aims at, its own or the shipped one."""
        return float(str(self.settings.get(ACCURACY, PERCENT)).removesuffix("%"))

    @property
    def refinable(self) -> bool:
        """Whether it can be loaded more carefully, and may be."""
        return not self.own_pace and not any(key in self.settings for key in PACES if key != ACCURACY)

    def at(self, percent: float) -> "Run":
        """The same, aiming at an accuracy."""
        return replace(self, settings={**self.settings, ACCURACY: f"{percent:g} %"})

    def coarser(self) -> "Run":
        """The same with twice the loading error, against which its peak is held."""
        return replace(self.at(2.0 * self.percent), pace_check=False)

    def finer(self) -> "Run":
        """The same with half the loading error."""
        return self.at(0.5 * self.percent)


@dataclass(frozen=True)
class Claim:
    """A sentence of the paper, held against what we measure.

    says      what the paper says, in its words or nearly so
    source    where: "5.1, Fig. 10"
    check     what is measured, and within which bounds it has to be
    measured  what came out, with units
    holds     None where it cannot be decided
    why       the reason, wherever it does not hold or cannot be decided
    """

    says: str
    source: str
    check: str
    measured: str
    holds: bool | None
    why: str = ""

    def __post_init__(self) -> None:
        if self.holds is not True and not self.why:
            raise ValueError(f"the claim '{self.says}' does not hold or cannot be decided: say why")


def claim(says: str, source: str, check: str, measured: str, holds: bool | None, why: str = "") -> Claim:
    """A claim whose reason is kept only where it does not hold or cannot be decided; 5% in its words is 5 %."""
    check, measured, why = (re.sub(r"(?<=\d)%", " %", text) for text in (check, measured, why))
    return Claim(says, source, check, measured, None if holds is None else bool(holds), "" if holds else why)


@dataclass(frozen=True)
class Misprint:
    """A line of the paper that cannot be meant as it stands; it claims nothing.

    where     "3, eq. (15)"
    printed   what stands there
    comes_to  what it would do, with numbers
    built     what this program has in its place
    """

    where: str
    printed: str
    comes_to: str
    built: str


@dataclass
class Section:
    """Content of an experiment: HTML, claims, numbers to keep, verdicts beside that on the claims, and misprints."""

    parts: list[str] = field(default_factory=list)
    claims: list[Claim] = field(default_factory=list)
    records: list[dict[str, Any]] = field(default_factory=list)
    verdicts: list[Verdict] = field(default_factory=list)
    misprints: list[Misprint] = field(default_factory=list)


class Missing(Exception):
    """A run that an experiment needs did not come through."""


@dataclass(frozen=True)
class Done:
    """The results of an experiment's runs by their labels.

    rows     label -> row of the sweep engine: key, status, reason, seconds and the flat numbers of the summary
    folder   where the engine keeps its runs
    refined  the labels of runs that were made again with less loading error than the experiment asks for
    """

    runs: Mapping[str, Run]
    rows: Mapping[str, Mapping[str, Any]]
    folder: Path
    quick: bool = False
    loaded: dict[str, Result] = field(default_factory=dict)
    refined: frozenset[str] = frozenset()

    def __getitem__(self, label: str) -> Result:
        """The result of a run. Raises Missing, with the reason, where it has none."""
        if not self.has(label):
            row = self.rows[label]
            raise Missing(f"'{label}' ended as {row['status']}: {row['reason']}")
        if label not in self.loaded:
            self.loaded[label] = load_result(self.folder / "runs" / self.rows[label]["key"])
        return self.loaded[label]

    def has(self, label: str) -> bool:
        """Whether a run was asked for and came to its end."""
        return label in self.rows and self.rows[label]["status"] == "OK"

    def __iter__(self) -> Iterator[str]:
        return iter(self.runs)

    @property
    def asked(self) -> list[str]:
        """The labels of the runs that the experiment asks for: all but those that only check the pace of another."""
        checks = {COARSER.format(label) for label in self.runs}
        return [label for label in self.runs if label not in checks]

    def record(
        self, label: str, quantity: str, value: float, unit: str, reference: float, kind: str, scale: float = 0.0
    ) -> dict[str, Any]:
        """A line for records.json; the signed error is relative to `scale`, or to the reference where none is given."""
        row, size = self.rows[label], abs(scale or reference)
        error = (value - reference) / size if size else math.nan
        numbers = {"value": value, "reference": reference, "error": error}
        return {
            "case": self.runs[label].scene,
            "quantity": quantity,
            "unit": unit,
            **{key: float(number) if math.isfinite(number) else None for key, number in numbers.items()},
            "kind_of_reference": kind,
            "seconds": row["seconds"],
            "steps": row.get("steps"),
            "knobs": dict(self.runs[label].settings),
            "status": row["status"],
            "reason": row["reason"],
            "energy_imbalance": row.get("energy_imbalance"),
            "source_hash": source_hash(),
            "version": __version__,
        }

    def peak(self, label: str) -> float:
        """Peak stress in Pa."""
        return float(self[label].summary["peak_stress_pa"])


@dataclass(frozen=True)
class Experiment:
    """An experiment of the paper.

    name, title   lower case with hyphens; as a heading
    order         its place on the page
    runs          whether it is to be quick -> label -> Run
    show          the results -> what they show. May raise Missing
    """

    name: str
    title: str
    order: int
    runs: Callable[[bool], dict[str, Run]]
    show: Callable[[Done], Section]


@dataclass(frozen=True)
class Shown:
    """An experiment that was run: its section, with the soundness of its runs, and the seconds they took."""

    experiment: Experiment
    section: Section
    soundness: list[Claim]
    seconds: float
    count: int

    def as_chapter(self) -> Chapter:
        """Its page in a report."""
        return Chapter(
            self.experiment.title,
            list(self.section.verdicts),
            list(self.section.records),
            list(self.section.parts),
            "The paper",
            self.experiment.name,
        )
