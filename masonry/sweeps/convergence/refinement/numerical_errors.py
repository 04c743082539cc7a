"""The error of each number of a scene, from the runs of a campaign."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import hypot

from masonry.sweeps.convergence.refinement.answers import Answer, Value, value_of
from masonry.sweeps.convergence.refinement.campaign import (
    BASE,
    DRAWN,
    NOT_REFINED,
    RIGID,
    SCATTER,
    TOGETHER,
    Refinement,
)
from masonry.sweeps.convergence.refinement.edge_points import STRENGTHS, unresolved
from masonry.sweeps.convergence.refinement.extrapolation import FLAT, Estimate, extrapolated, scatter_bar, together
from masonry.sweeps.run_store import Row

IDLE = 0.01
"""Of the largest difference that is scatter: what differs by less does not act, and is no sample of it."""
Ended = Sequence[tuple[Refinement, Row]]
"""The runs so far, the scene as it is first."""


@dataclass(frozen=True)
class NumericalError:
    """Of one number of a scene: how far it is from what the same model gives when it is refined without end.

    answer   which number           value  of the scene as it is, SI
    limit    without end       half_width   of the 95 % interval around it
    order    observed, None where none is
    parts    by name of a resolution, value of the scene less the value without end of this resolution alone
    scatter  half-width of what runs differ by that differ in nothing; part of the bar
    interval half-width of the interval of a load factor, or of a peak between steps; part of the scatter
    unseen   by name of a resolution, what points from edge to edge may not have seen (`edge_points.py`)
    """

    answer: Answer
    value: float
    limit: float
    half_width: float
    order: float | None
    parts: dict[str, float]
    scatter: float
    interval: float
    unseen: dict[str, float] = field(default_factory=dict)

    @property
    def error(self) -> float:
        """Value of the scene less the value without end."""
        return self.value - self.limit

    @property
    def at_most(self) -> float:
        """The largest error of the scene, whatever its sign, that the bar allows."""
        return abs(self.error) + self.half_width


def error_of(answer: Answer, ended: Ended) -> NumericalError | None:
    """Of a number of the scene as it is; None where too few runs have it."""
    values = [(trial, value) for trial, row in ended if (value := value_of(row, answer)) is not None]
    return error_of_values(answer, values, unresolved(ended) if answer.key in STRENGTHS else {})


def error_of_values(
    answer: Answer, values: Sequence[tuple[Refinement, Value]], unresolved: Mapping[str, float]
) -> NumericalError | None:
    """Of what each run gave, the scene as it is first; None where too few have it.

    unresolved  by resolution, a part of the number that its finest run may not have seen
    """
    if not values or values[0][0].name != BASE:
        return None
    base, middle = values[0][1], [(trial, _middle(value)) for trial, value in values]
    again = [number - _middle(base) for trial, number in middle if trial.name == SCATTER]
    scatter = hypot(max(map(abs, again), default=0.0), base.interval)
    unseen = {name: part * abs(base.number) for name, part in unresolved.items()}
    parts = {name: _with_unseen(part, unseen.get(name, 0.0)) for name, part in _parts(middle, scatter).items()}
    if not parts:
        return None
    flat = [n - _middle(base) for trial, n in middle if trial.name in parts and parts[trial.name].change == 0.0]
    largest = max(map(abs, [*again, *flat]), default=0.0)
    flat = [difference for difference in flat if abs(difference) > IDLE * largest]
    reading = max(value.reading for _, value in values)  # a peak at the end of a drive has none: it may be before
    scattered = hypot(scatter_bar([*again, *flat]), base.interval, reading)
    estimate = together(list(parts.values()), _interaction(middle, scatter), 2.0, scattered)
    limit = _middle(base) + estimate.change
    by_part = {name: -part.change for name, part in parts.items()}
    bar, order = estimate.half_width, estimate.order
    return NumericalError(answer, base.number, limit, bar, order, by_part, scattered, base.interval, unseen)


def _with_unseen(part: Estimate, unseen: float) -> Estimate:
    return part._replace(half_width=max(part.half_width, unseen))


def _middle(value: Value) -> float:
    return value.number + value.interval


def _parts(values: Sequence[tuple[Refinement, float]], scatter: float) -> dict[str, Estimate]:
    """By resolution, from its runs and the scene as it is."""
    names = dict.fromkeys(trial.name for trial, _ in values if trial.name not in NOT_REFINED)
    base = values[0][1]
    return {
        name: extrapolated([(1.0, base), *((t.factor, value) for t, value in values if t.name == name)], scatter)
        for name in names
    }


def _interaction(values: Sequence[tuple[Refinement, float]], scatter: float) -> float | None:
    """Change of all together, less the sum of the changes of each alone; None without such a run, 0 of scatter."""
    base = values[0][1]
    whole = next((trial_value for trial_value in values if trial_value[0].name == TOGETHER), None)
    if whole is None:
        return None
    trial, value = whole
    alone = [v - base for t, v in values if (t.name, t.factor) in trial.members]
    interaction = value - base - sum(alone)
    return interaction if abs(interaction) > FLAT * scatter else 0.0


def relative_changes(ended: Ended, answers: Sequence[Answer]) -> tuple[dict[str, float], float]:
    """The largest relative change of any of the numbers by resolution, and by scatter."""
    changes: dict[str, float] = {}
    for answer in answers:
        base = value_of(ended[0][1], answer)
        for trial, row in ended[1:]:
            value = value_of(row, answer)
            if base is None or value is None or not base.number:
                continue
            change = abs(_middle(value) / _middle(base) - 1.0)
            changes[trial.name] = max(changes.get(trial.name, 0.0), change)
    scatter = changes.pop(SCATTER, 0.0)
    for name in (TOGETHER, DRAWN, RIGID):
        changes.pop(name, None)
    return changes, scatter
