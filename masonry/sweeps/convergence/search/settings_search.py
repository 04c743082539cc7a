"""A search for settings by which the numbers of a scene have no larger error than asked for: rounds of finer settings,
each measured, then coarser ones."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from masonry.runtime.progress import Tell
from masonry.scene import Scene, changed
from masonry.sweeps.convergence.refinement.answers import BORNE
from masonry.sweeps.convergence.refinement.campaign import Campaign
from masonry.sweeps.convergence.refinement.numerical_errors import NumericalError
from masonry.sweeps.convergence.search.chosen_settings import (
    SHORT,
    ChosenSettings,
    Measured,
    Settings,
    percent,
    relative,
    toml_of,
)
from masonry.sweeps.convergence.search.next_settings import Makeup, Proposal, Steps, makeup_of, narrower, scatter_of
from masonry.sweeps.work import OK

NOTHING_FINER = "no resolution of the scene makes it smaller"
ROUNDS = 6
"""Refinements one after the other, at most."""
DEAREST = 10.0
"""Times the scene as it is that a run may be expected to take."""
LONGEST = 100.0
"""Times the scene as it is that all runs may have taken before another round."""
SHORTEST = 1e-3
"""Seconds of a run that are counted at least."""
TRIES = 2
"""Refinements in vain, after which a number is left as it is; of scatter it is one."""
IN_VAIN = 0.9
"""Times the smallest error so far that is no smaller."""
SCATTER_AT_MOST = 4.0
"""Times the error asked for, beyond which no pace is tried against scatter."""
ALLOWED, WORTH_IT = 1.25, 2.0
"""Of a number that is not within reach: times its error that a coarser setting may lead to; times its smallest error
that the scene as it is has, where finer settings are chosen for it."""


def choose(
    scene: Scene,
    measured: Measured,
    to: float,
    measure: Callable[[Scene], Measured],
    plan: Callable[[Scene], Campaign] = Campaign,
    tell: Tell | None = None,
) -> ChosenSettings:
    """Refine what makes up the errors of a scene until none is larger than asked for, then make coarser what costs and
    buys nothing.

    measured  errors and runs of the scene as it is
    measure   the same of another scene, plan its runs
    tell      is called with a line for each round
    """
    return _Search(scene, to, measure, plan, tell or (lambda line: None), [Settings({}, *measured)]).chosen()


@dataclass
class _Search:
    """One after the other, settings are chosen and measured."""

    scene: Scene
    to: float
    measure: Callable[[Scene], Measured]
    plan: Callable[[Scene], Campaign]
    tell: Tell
    tried: list[Settings]
    unreached: dict[str, str] = field(default_factory=dict)
    dear: list[str] = field(default_factory=list)
    smallest: dict[str, float] = field(default_factory=dict)
    in_vain: dict[str, int] = field(default_factory=dict)

    def chosen(self) -> ChosenSettings:
        """The cheapest settings with all numbers within reach as good as asked for; else the best."""
        for number in range(1, ROUNDS + 1):
            if not self._refine(number):
                break
        else:
            self._leave_for_cost(
                self._aims(self.tried[-1]), f"{ROUNDS} refinements one after the other were not enough"
            )
        within = [
            tried for tried in self.tried if tried.largest(list(self.unreached)) <= self.to and self._is_better(tried)
        ]
        scattered = [key for key in self.unreached if key not in self.dear]
        best = min(within or self.tried, key=lambda tried: tried.seconds if within else tried.largest(scattered))
        for _ in range(TRIES):
            coarser = self._coarser(best) if within and best.seconds > SHORT else None
            if coarser is None:
                break
            best = coarser
        missed = {e.answer.key for e in best.errors if e.value and relative(e) > self.to}
        unreached = {key: why for key, why in self.unreached.items() if key in missed}
        return ChosenSettings(best, self.tried, self.to, unreached)

    def _spent(self) -> float:
        """Seconds of processor of all runs so far."""
        runs = {row["key"]: row.get("seconds_processor_run") or 0.0 for tried in self.tried for _, row in tried.runs}
        return float(sum(runs.values()))

    def _is_better(self, tried: Settings) -> bool:
        """Whether numbers that are out of reach are about as good as they became, where that is worth it."""
        for key in self.dear:
            errors = [relative(error) for each in self.tried for error in each.errors if error.answer.key == key]
            worth_it = errors[0] > WORTH_IT * min(errors)
            if worth_it and any(
                relative(error) > ALLOWED * min(errors) for error in tried.errors if error.answer.key == key
            ):
                return False
        return True

    def _aims(self, now: Settings) -> list[NumericalError]:
        """Numbers whose error is too large, and within reach."""
        return [e for e in now.errors if e.value and relative(e) > self.to and e.answer.key not in self.unreached]

    def _give_up(self, errors: Sequence[NumericalError], why: str) -> None:
        for error in errors:
            self.unreached[error.answer.key] = why

    def _leave_for_cost(self, errors: Sequence[NumericalError], why: str) -> bool:
        """Leave numbers for their cost; there is no other round then."""
        self._give_up(errors, why)
        self.dear += [error.answer.key for error in errors]
        return False

    def _refine(self, number: int) -> bool:
        """One round; False where there is nothing more to do."""
        now = self.tried[-1]
        self._leave_what_stays(now)
        aims = self._aims(now)
        if not aims:
            return False
        if self._spent() > LONGEST * self.tried[0].seconds:
            return self._leave_for_cost(aims, f"the search took {LONGEST:g} times the time of the scene")
        scene = changed(self.scene, now.settings)
        makeups, steps = [makeup_of(error, now.runs, self.to) for error in aims], Steps(self.plan(scene))
        so_far = now.seconds / max(self.tried[0].seconds, SHORTEST)
        narrow = narrower(scene, self.to) if any(error.answer.key == BORNE for error in aims) else {}
        proposal = steps.finer(makeups, self.to, DEAREST / so_far)
        if proposal is None and not narrow:
            if steps.finer(makeups, self.to) is not None:
                return self._leave_for_cost(aims, f"finer settings would take more than {DEAREST:g} times its time")
            self._give_up(aims, NOTHING_FINER)
            return False
        proposal = proposal or Proposal({}, 1.0)
        settings = steps.settings(proposal) | narrow
        self._say(f"round {number}", makeups, settings, proposal, so_far * proposal.cost)
        why = dict.fromkeys(narrow, {"": "narrower: the interval of a load factor"})
        why |= _reasons(steps, proposal, lambda name: _made_up(name, makeups))
        ended = self._measured(now, settings, why)
        status = ended.runs[0][1]["status"]
        if status != OK or not ended.errors:
            why_not = f"the run with finer settings was {status.lower()}" if status != OK else NOTHING_FINER
            self._give_up(aims, why_not)
            return False
        self.tried.append(ended)
        return True

    def _leave_what_stays(self, now: Settings) -> None:
        """Numbers whose error is scatter, or did not become smaller."""
        for error in self._aims(now):
            key, size, scatter = error.answer.key, relative(error), scatter_of(error)
            if size > IN_VAIN * self.smallest.get(key, 2.0 * size):
                self.in_vain[key] = self.in_vain.get(key, 0) + 1
            self.smallest[key] = min(size, self.smallest.get(key, size))
            tries = self.in_vain.get(key, 0)
            if scatter > SCATTER_AT_MOST * self.to or (scatter > self.to and tries):
                self._give_up([error], f"runs that differ in nothing of meaning differ by {percent(scatter)}")
            elif tries >= TRIES:
                self._give_up([error], "finer settings do not make it smaller")

    def _say(
        self, what: str, makeups: Sequence[Makeup], settings: dict[str, Any], proposal: Proposal, spent: float
    ) -> None:
        """A line of a round: the worst number and what it comes from, what is set, and how long a run takes."""
        worst = max(makeups, key=lambda makeup: makeup.error)
        parts = ", ".join(f"{name} {percent(worst.part(name))}" for name in proposal.factors if worst.part(name) > 0.0)
        sets = ", ".join(f"{key} = {toml_of(value)}" for key, value in settings.items())
        made = f" ({parts})" if parts else ""
        self.tell(f"{what}: {worst.words} within {percent(worst.error)}{made}; {sets}: {spent:.2g} times the scene")

    def _measured(self, now: Settings, settings: dict[str, Any], why: dict[str, dict[str, str]]) -> Settings:
        """Settings beside those so far, with what is measured."""
        reasons = now.reasons | {key: now.reasons.get(key, {}) | each for key, each in why.items()}
        settings = now.settings | settings
        return Settings(settings, *self.measure(changed(self.scene, settings)), reasons)

    def _coarser(self, now: Settings) -> Settings | None:
        """Settings that take less time, and whose errors, from the finer value without end too, and verdict are as
        good; None where none are."""
        steps = Steps(self.plan(changed(self.scene, now.settings)))
        limits = {
            error.answer.key: max(self.to, ALLOWED * relative(error) if error.answer.key in self.unreached else 0.0)
            for error in now.errors
            if error.value
        }
        errors = [error for error in now.errors if error.value]
        proposal = steps.coarser([(makeup_of(error, now.runs, self.to), limits[error.answer.key]) for error in errors])
        if proposal is None:
            return None
        names = ", ".join(proposal.factors)
        self.tell(f"coarser: {names}, which buy less than they cost: {proposal.cost:.2g} times the run so far")
        why = _reasons(steps, proposal, lambda name: f"{name} coarser: costs more than it buys")
        ended = self._measured(now, steps.settings(proposal), why)
        fine = {error.answer.key: error.limit for error in now.errors}
        fits = ended.errors and all(
            max(relative(error), abs(1.0 - fine.get(error.answer.key, error.value) / error.value))
            <= limits.get(error.answer.key, self.to)
            for error in ended.errors
            if error.value
        )
        if not fits or ended.rank > now.rank or ended.seconds >= now.seconds:
            return None
        self.tried.append(ended)
        return ended


def _reasons(steps: Steps, proposal: Proposal, why: Callable[[str], str]) -> dict[str, dict[str, str]]:
    """By dotted key and resolution."""
    reasons: dict[str, dict[str, str]] = {}
    for name, factor in proposal.factors.items():
        for key in steps.resolutions[name].settings(factor) or {}:
            reasons.setdefault(key, {})[name] = why(name)
    return reasons


def _made_up(name: str, makeups: Sequence[Makeup]) -> str:
    """The number that a resolution matters most to."""
    worst = max(makeups, key=lambda makeup: makeup.part(name))
    return f"{name} finer: made up {percent(worst.part(name))} of the {worst.words}"
