"""One number of one random scene: all that its runs said of it, beside its truth; a line of a file each."""

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from masonry.sweeps.convergence.refinement.answers import Answer, Value
from masonry.sweeps.convergence.refinement.campaign import Refinement
from masonry.sweeps.convergence.refinement.numerical_errors import NumericalError, error_of_values
from verification.studies.error_bars.measured_doubts import Indicator

VISIBLE = 1e-5
"""Relative error from which on a bar is compared with it."""
ROUNDING = 1e-6
"""Of the value, by which a bar may be missed."""


@dataclass(frozen=True)
class Compared:
    """SI throughout; errors are told by the rules of today, so that a file says what other rules would tell.

    truth          by brute force
    cost           seconds of all other runs over those of the scene itself
    seconds        of processor: of the scene, of its truth
    runs           name, factor, members, number and half interval of each run, the scene as it is first
    settings       of the truth, by dotted key
    verdict        of the scene's own run
    indicators     what it measured of each doubt
    unresolved     by resolution, what its finest run may not have seen, over the number
    """

    kind: str
    seed: int
    answer: Answer
    truth: Value
    cost: float
    seconds: tuple[float, float]
    runs: tuple[tuple[Refinement, Value], ...]
    settings: Mapping[str, Any]
    verdict: str
    indicators: tuple[Indicator, ...]
    unresolved: Mapping[str, float] = field(default_factory=dict)

    @cached_property
    def error(self) -> NumericalError:
        """The error as it is told."""
        error = error_of_values(self.answer, self.runs, self.unresolved)
        assert error is not None
        return error

    @property
    def stated(self) -> float:
        """The error told, over the value."""
        return self.error.error / abs(self.error.value)

    @property
    def half_width(self) -> float:
        """The bar, over the value."""
        return self.error.half_width / abs(self.error.value)

    @property
    def real(self) -> float:
        """The value less its truth, over the value."""
        return (self.error.value - self.truth.number - self.truth.interval) / abs(self.error.value)

    @property
    def holds(self) -> bool:
        """Whether the bar holds the truth, rounding apart."""
        return abs(self.real - self.stated) <= self.half_width + ROUNDING

    def __str__(self) -> str:
        mark = "     " if self.holds else "MISS "
        numbers = "".join(f"{100 * x:10.3f}" for x in (self.stated, self.half_width, self.real))
        return f"{mark}{self.kind:<34}{self.seed:>4}  {self.answer.words:<22}{numbers}{self.cost:7.1f}"

    def as_line(self) -> str:
        """JSON, with the errors told beside what they are made of."""
        relative = {"told": self.stated, "half_width": self.half_width, "real": self.real, "holds": self.holds}
        return json.dumps(_plain(self) | {"relative": relative}) + "\n"


def _plain(compared: Compared) -> dict[str, Any]:
    runs = [
        {"name": trial.name, "factor": trial.factor, "members": trial.members, **asdict(value)}
        for trial, value in compared.runs
    ]
    names = ("kind", "seed", "cost", "seconds", "verdict")
    return {name: getattr(compared, name) for name in names} | {
        "answer": asdict(compared.answer),
        "truth": asdict(compared.truth),
        "runs": runs,
        "settings": dict(compared.settings),
        "unresolved": dict(compared.unresolved),
        "indicators": [indicator.as_keys() for indicator in compared.indicators],
    }


def lines_of(path: Path) -> Iterator[dict[str, Any]]:
    """Of a file, but for one that was cut off while it was written; none where there is no file."""
    for line in path.read_text(encoding="utf-8").splitlines(keepends=True) if path.is_file() else ():
        if line.endswith("\n"):
            yield json.loads(line)


def compared_of(line: Mapping[str, Any]) -> Compared:
    """The number of a line of a file."""
    runs = tuple(
        (
            Refinement(
                run["name"], run["factor"], {}, members=tuple((name, factor) for name, factor in run["members"])
            ),
            Value(run["number"], run["interval"], run.get("reading", 0.0)),
        )
        for run in line["runs"]
    )
    return Compared(
        line["kind"],
        line["seed"],
        Answer(**line["answer"]),
        Value(**line["truth"]),
        line["cost"],
        (line["seconds"][0], line["seconds"][1]),
        runs,
        line["settings"],
        line["verdict"],
        tuple(Indicator(**indicator) for indicator in line["indicators"]),
        line.get("unresolved", {}),
    )


def append(path: Path | None, lines: Iterable[str]) -> None:
    """At the end of a file, those of a scene at once; what was cut off there is removed first."""
    if path is None:
        return
    whole = "".join(json.dumps(line) + "\n" for line in lines_of(path)) if _is_cut(path) else None
    if whole is not None:
        path.write_text(whole, encoding="utf-8")
    with path.open("a", encoding="utf-8") as file:
        file.write("".join(lines))


def _is_cut(path: Path) -> bool:
    return path.is_file() and path.stat().st_size > 0 and not path.read_bytes().endswith(b"\n")
