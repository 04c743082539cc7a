"""Runs the refinements of a problem: its references, a record for each run and quantity, and the points to draw."""

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from verification import convergence, timed_run
from verification.catalogue import modules_of
from verification.convergence import shipped_scenes
from verification.problem import ACCURACY, OVER, Point, Problem, Reference, changes_model, is_setting, richardson
from verification.records import Record
from verification.scene_runs import SceneRun

Lines = dict[str, list[tuple[float, float, str]]]
"""Knob -> (seconds, error, label) of each run that came through."""


def problems() -> Iterator[Problem]:
    """All of `verification.convergence`, the shipped scenes first."""
    for module in sorted(modules_of(convergence), key=lambda module: module is not shipped_scenes):
        yield from module.PROBLEMS


def anchor(problem: Problem) -> str:
    """Where the section of a problem begins on the page."""
    return f"problem-{problem.name}"


class Study:
    """A problem whose knobs were refined.

    runs        knob -> label -> run
    references  quantity -> Reference
    records     one for each run and quantity
    timed       whether short runs are made several times, for a steadier time
    """

    def __init__(self, problem: Problem, tell: Callable[[str], None], timed: bool = True) -> None:
        self.problem, self.timed = problem, timed
        self.runs: dict[str, dict[str, SceneRun]] = {}
        for knob, settings in problem.knobs.items():
            tell(f"{problem.name}: {knob}, {len(settings)} settings")
            self.runs[knob] = {label: self._run(keys) for label, keys in settings.items()}
        self.references = self._references()
        self.records = [record for knob in self.runs for record in self._records(knob)]

    def _run(self, keys: dict[str, Any]) -> SceneRun:
        return timed_run.run(self.problem.scene, self.problem.base | keys, self.timed)

    def _references(self) -> dict[str, Reference]:
        """Reference values of the numbers. A converged run is doubted by as much as the finest drive to an accuracy
        differs from it: two ways to the same limit.
        """
        if self.problem.exact is not None:
            run = next(t for runs in self.runs.values() for t in runs.values() if t.ok)
            return {q: Reference(value, self.problem.kind) for q, value in self.problem.exact(run).items()}
        runs = [self.problem.measure(t) for t in self.runs[self.problem.converged].values() if t.ok]
        references = {q: richardson([run[q] for run in runs]) for q in self.problem.units}
        paced = [t for t in self.runs.get(ACCURACY, {}).values() if t.ok]
        if paced:
            second = self.problem.measure(paced[-1])
            references = {q: r.doubted(abs(second[q] - r.value)) for q, r in references.items()}
        return references

    def _records(self, knob: str) -> Iterator[Record]:
        exact_values = self.problem.exact or (self.problem.theory if changes_model(knob) else None)
        for label, run in self.runs[knob].items():
            values = self.problem.measure(run) if run.ok else {}
            exact = exact_values(run) if run.ok and exact_values is not None else {}
            for quantity, reference in self.references.items():
                value = values.get(quantity, math.nan)
                kind = self.problem.kind if quantity in exact else reference.kind
                expected = exact.get(quantity, reference.value)
                entry = timed_run.record(run, quantity, value, expected, kind, self._scale(quantity, exact))
                yield entry | {
                    "case": self.problem.name,
                    "unit": self.problem.units[quantity],
                    "knob": knob,
                    "rung": label,
                    "reference_uncertainty": reference.uncertainty,
                }

    @property
    def doubts(self) -> dict[str, float]:
        """Quantity -> what its reference may be off by, relative."""
        scales = {q: abs(self._scale(q, {})) for q in self.references}
        return {q: r.uncertainty / scales[q] if scales[q] else 0.0 for q, r in self.references.items()}

    def _scale(self, quantity: str, exact: Mapping[str, float]) -> float:
        """Value to which the error of a quantity is relative."""
        over = OVER.get(quantity, quantity)
        return exact.get(over, self.references[over].value)

    @property
    def doubt(self) -> float:
        """The largest of them."""
        return max(self.doubts.values())

    def lines(self, quantity: str) -> Lines:
        """To draw: without the run that is the reference itself, whose error is 0 by name only."""
        lines: Lines = {}
        for r in self.records:
            if r["quantity"] == quantity and r["error"] is not None and not self._is_reference(r):
                lines.setdefault(r["knob"], []).append((r["seconds"], r["error"], r["rung"]))
        return lines

    def _is_reference(self, record: Record) -> bool:
        if self.problem.exact is not None:
            return False
        last = next(reversed(self.problem.knobs[self.problem.converged]))
        return bool(record["knob"] == self.problem.converged and record["rung"] == last)

    def points(self) -> list[Point]:
        """The settings that solve the same model, each with its largest error over all quantities."""
        points: dict[tuple[str, str], Point] = {}
        for r in self.records:
            key = (r["knob"], r["rung"])
            if not is_setting(r["knob"]) or r["error"] is None or self._is_reference(r):
                continue
            worst = max(abs(r["error"]), points[key].error if key in points else 0.0)
            points[key] = Point(*key, r["seconds"], r["steps"], worst)
        return list(points.values())

    @property
    def shipped(self) -> Point | None:
        """Point of a user who asks for nothing."""
        return next((p for p in self.points() if (p.knob, p.label) == self.problem.shipped), None)
