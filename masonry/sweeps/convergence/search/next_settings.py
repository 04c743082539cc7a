"""Settings that are worth a try: finer ones that buy most error for a second of processor, coarser ones that save most
time.

What a resolution moved a number by goes down with the number's order of convergence as it is made finer (1 where none
is observed), and up with the highest usual order as it is made coarser.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf, log, prod, sqrt
from typing import Any

from masonry.scene import Scene
from masonry.sweeps.convergence.refinement.answers import value_of
from masonry.sweeps.convergence.refinement.campaign import NOT_REFINED, Campaign, Refinement
from masonry.sweeps.convergence.refinement.extrapolation import HIGHEST_ORDER, LOWEST_ORDER
from masonry.sweeps.convergence.refinement.numerical_errors import Ended, NumericalError
from masonry.sweeps.convergence.refinement.resolutions import FINEST_ACCURACY

TIME = ("pace", "time step")
"""Resolutions by which scatter may become smaller."""
PEAK = "peak_stress_pa"
DEEPEST = 2
"""Steps by which a resolution is made finer or coarser before it is measured again."""
DEAREST_STEP = 4.0
"""Times the cost of a scene that one proposal may have, where one step alone has not."""
MARGIN = 0.8
"""Fraction of the error asked for that is aimed at."""
NOTICED = 0.02
"""Fraction of a number's error, below which a resolution does not count."""
NO_LONGER, SHORTER = 0.01, 0.9
"""Of the time of a run: what a finer setting costs at least, and what one step coarser may take at most."""
INTERVAL = 0.25
"""Fraction of the error asked for, above which the interval of a load factor is made narrower."""


@dataclass(frozen=True)
class Makeup:
    """Parts of the error of one number, relative to the number.

    words   for people
    error   largest that its bar allows
    rest    part of it that no resolution moves
    moved   by name of a resolution, in proportion to what it makes up
    order   of convergence
    """

    words: str
    error: float
    rest: float
    moved: dict[str, float]
    order: float

    def expected(self, factors: Mapping[str, float]) -> float:
        """The error with resolutions finer by these factors, or coarser (below 1)."""
        whole = sum(self.moved.values())
        if whole == 0.0:
            return self.error
        now = sum(part * self._remaining(factors.get(name, 1.0)) for name, part in self.moved.items())
        return self.rest + (self.error - self.rest) * now / whole

    def _remaining(self, factor: float) -> float:
        return float(factor ** -(self.order if factor > 1.0 else HIGHEST_ORDER))

    def part(self, name: str) -> float:
        """The part of the error that a resolution makes up."""
        return (self.error - self.rest) * self.moved.get(name, 0.0) / (sum(self.moved.values()) or 1.0)


@dataclass(frozen=True)
class Proposal:
    """Resolutions that are finer by factors, or coarser, and the cost that is expected, over that of the scene."""

    factors: dict[str, float]
    cost: float


def scatter_of(error: NumericalError) -> float:
    """Relative half-width of what runs differ by that differ in nothing, apart from the interval of a load factor."""
    return sqrt(max(error.scatter**2 - error.interval**2, 0.0)) / abs(error.value)


def makeup_of(error: NumericalError, runs: Ended, to: float) -> Makeup:
    """A resolution counts by the largest change that a run of it made, or by what it may not have seen. The pace counts
    by scatter too, where that is larger than the error asked for, and by what a peak may be between two steps."""
    size, base = abs(error.value), value_of(runs[0][1], error.answer)
    moved = {name: unseen / size for name, unseen in error.unseen.items() if unseen}
    for trial, row in runs:
        part, value = error.parts.get(trial.name, 0.0), value_of(row, error.answer)
        if trial.name not in NOT_REFINED and part and value is not None and base is not None:
            change = abs(value.number + value.interval - base.number - base.interval)
            moved[trial.name] = max(change / size, abs(part) / size, moved.get(trial.name, 0.0))
    whole, interval, rest = error.at_most / size, error.interval / size, scatter_of(error)
    slower = interval if error.answer.key == PEAK else 0.0
    if rest > to or not moved:  # changes that are flat are scatter
        slower, rest = slower + max(rest, whole - interval), 0.0
    for name in {trial.name for trial, _ in runs} & set(TIME):
        moved[name] = moved.get(name, 0.0) + slower
    order = 1.0 if error.order is None else min(max(error.order, LOWEST_ORDER), HIGHEST_ORDER)
    noticed = {name: part for name, part in moved.items() if part > NOTICED * whole}
    return Makeup(error.answer.words, whole, min(rest, whole), noticed, order)


class Steps:
    """Steps of the resolutions of a scene, finer or coarser, and what they cost."""

    def __init__(self, campaign: Campaign) -> None:
        self.campaign = campaign
        self.trials: dict[tuple[str, float], Refinement | None] = {}
        self.resolutions = {resolution.name: resolution for resolution in campaign.resolutions}

    def finer(self, makeups: Sequence[Makeup], to: float, dearest: float = inf) -> Proposal | None:
        """One step after the other, each time that which takes most off the errors for a second of processor, until
        those that are expected are as asked for; None where no step that is not too dear takes anything off."""

        def excess(factors: Mapping[str, float]) -> float:
            return sum(max(makeup.expected(factors) - MARGIN * to, 0.0) for makeup in makeups)

        chosen: Proposal | None = None
        while (before := excess(chosen.factors if chosen else {})) > 0.0:
            cost = chosen.cost if chosen else 1.0
            gains = {
                (before - excess(proposal.factors)) / max(proposal.cost - cost, NO_LONGER * cost): proposal
                for proposal in self._further(chosen, 1.0)
                if proposal.cost <= (dearest if chosen is None else min(dearest, DEAREST_STEP))
            }
            if max(gains, default=0.0) <= 0.0:
                break
            chosen = gains[max(gains)]
        return chosen

    def coarser(self, makeups: Sequence[tuple[Makeup, float]]) -> Proposal | None:
        """One step after the other, each time that which saves most time, while no number is expected to have a larger
        error than the one beside it; None where there is no such step."""
        chosen: Proposal | None = None
        while True:
            cost = chosen.cost if chosen else 1.0
            proposals = [
                proposal
                for proposal in self._further(chosen, -1.0)
                if proposal.cost <= SHORTER * cost
                and all(makeup.expected(proposal.factors) <= limit for makeup, limit in makeups)
            ]
            if not proposals:
                return chosen
            chosen = min(proposals, key=lambda proposal: proposal.cost)

    def _further(self, proposal: Proposal | None, sign: float) -> list[Proposal]:
        """One more step of each resolution that takes it."""
        factors, proposals = proposal.factors if proposal else {}, []
        for name, resolution in self.resolutions.items():
            ratio = next((factor for factor in resolution.factors if factor > 1.0), None)
            factor = factors.get(name, 1.0) * (ratio or 1.0) ** sign
            if ratio is None or abs(log(factor)) > (DEEPEST + 0.5) * log(ratio):
                continue
            further = factors | {name: factor}
            costs = [trial.cost for name, factor in further.items() if (trial := self._trial(name, factor)) is not None]
            if len(costs) == len(further):
                proposals.append(Proposal(further, prod(costs)))
        return proposals

    def _trial(self, name: str, factor: float) -> Refinement | None:
        key = name, factor
        if key not in self.trials:
            self.trials[key] = self.campaign.trial(self.resolutions[name], factor)
        return self.trials[key]

    def settings(self, proposal: Proposal) -> dict[str, Any]:
        """Settings of a proposal, by dotted key; of points by axis, those that one of its resolutions changes."""
        number = self.campaign.scene.points_per_edge
        points = number._asdict() if number is not None else {}
        settings: dict[str, Any] = {}
        for name, factor in proposal.factors.items():
            for key, value in (self.resolutions[name].settings(factor) or {}).items():
                if isinstance(value, dict) and key in settings:
                    value = settings[key] | {axis: n for axis, n in value.items() if n != points.get(axis)}
                settings[key] = value
        return settings


def narrower(scene: Scene, to: float) -> dict[str, Any]:
    """The interval of a load factor, where it alone is near the error asked for."""
    accuracy = scene.limit.accuracy if scene.limit is not None else None
    is_wide = isinstance(accuracy, float) and accuracy > INTERVAL * to
    return {"limit.accuracy": max(INTERVAL * to, FINEST_ACCURACY)} if is_wide else {}
