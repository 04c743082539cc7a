"""Settings by which the numbers of a scene have no larger error than asked for, and which cost no more than needed."""

import textwrap
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from masonry.errors import SceneError
from masonry.runtime.progress import Tell
from masonry.runtime.tables import WIDTH
from masonry.scene import Scene, changed
from masonry.scene.tables.loads_and_supports import accuracy_share
from masonry.sweeps.convergence.campaign import Campaign, Refinement
from masonry.sweeps.convergence.next_settings import Makeup, Proposal, Steps, makeup_of, narrower, scatter_of
from masonry.sweeps.convergence.numerical_errors import NumericalError
from masonry.sweeps.run_store import Row
from masonry.sweeps.work import OK

FILE = "converged.toml"
ROUNDS = 6
"""Refinements one after the other, at most."""
DEAREST = 10.0
"""Times the scene as it is that a run may be expected to take."""
SHORT = 0.5
"""Seconds of a run of which no ratio is told, and which is not made coarser: it would be noise."""
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
VERDICTS = ("sound", "with care")
"""The better first."""

Runs = list[tuple[Refinement, Row]]
Measured = tuple[list[NumericalError], Runs]


@dataclass(frozen=True)
class Settings:
    """Settings by dotted key, and what was measured with them."""

    settings: dict[str, Any]
    errors: list[NumericalError]
    runs: Runs

    @property
    def seconds(self) -> float:
        """Of processor."""
        return float(self.runs[0][1]["seconds_processor_run"])

    def largest(self, but: Sequence[str] = ()) -> float:
        """The largest relative error that the bars allow, some numbers apart."""
        return max(
            (_relative(error) for error in self.errors if error.value and error.answer.key not in but), default=0.0
        )

    @property
    def verdict(self) -> str:
        """Of a run with them, and its doubts; "" where a verdict is not asked for."""
        row = self.runs[0][1]
        return f"{row['verdict']} ({row['doubts']})" if row["doubts"] else str(row["verdict"] or "")

    @property
    def rank(self) -> int:
        """Of the verdict, 0 the best."""
        verdict = self.runs[0][1]["verdict"]
        return VERDICTS.index(verdict) if verdict in VERDICTS else len(VERDICTS)


@dataclass(frozen=True)
class ChosenSettings:
    """The settings that were chosen.

    best     they, and what was measured with them
    tried    all, the scene as it is first
    reasons  by dotted key
    unreached  by key of a number that does not become as good as asked for, why
    to       the error asked for
    """

    best: Settings
    tried: list[Settings]
    reasons: dict[str, str]
    unreached: dict[str, str]
    to: float

    @property
    def settings(self) -> dict[str, Any]:
        """By dotted key."""
        return self.best.settings

    @property
    def error(self) -> float:
        """The largest relative error of a number within reach; of all, where none is."""
        return self.best.largest(self._apart)

    @property
    def _apart(self) -> list[str]:
        """Numbers that are not within reach, where others are."""
        keys = {error.answer.key for error in self.best.errors if error.value}
        return [key for key in self.unreached if key in keys] if keys - set(self.unreached) else []

    @property
    def words(self) -> str:
        """A sentence on what they buy, and one for each number that is not within reach."""
        seconds, first = self.best.seconds, self.tried[0].seconds
        what = FILE if self.settings else "The scene as it is"
        took = f", for {seconds / first:.2g} times the time" if self.settings and min(seconds, first) > SHORT else ""
        numbers = "its numbers" if not self._apart else "its other numbers"
        reached = f"{what} has {numbers} within {_percent(self.error)} ({100 * self.to:g} % were asked for){took}"
        judged = f"; its run is {self.best.verdict}" if self.best.verdict else ""
        missed = [
            f"The {error.answer.words} is within {_percent(_relative(error))}: {self.unreached[error.answer.key]}."
            for error in self.best.errors
            if error.answer.key in self.unreached
        ]
        return " ".join([*missed, f"{reached}{judged}."])

    def as_toml(self, scene: str) -> str:
        """A scene file that stands beside that of the scene as it is."""
        numbers = [
            f"{error.answer.words} within {_percent(_relative(error))}" for error in self.best.errors if error.value
        ]
        said = [*textwrap.wrap(self.words, WIDTH), *textwrap.wrap(", ".join(numbers), WIDTH)]
        lines = [*(f"# {line}" for line in said), f'base = "{scene}"']
        tables: dict[str, list[str]] = {}
        for key, value in self.settings.items():
            table, _, name = key.rpartition(".")
            tables.setdefault(table, []).append(f"{name} = {_toml(value)}  # {self.reasons[key]}")
        for table, entries in tables.items():
            lines += ["", f"[{table}]", *entries]
        return "\n".join(lines) + "\n"


def _toml(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {part}" for key, part in value.items()) + "}"
    return f'"{value}"' if isinstance(value, str) else repr(value)


def _percent(fraction: float) -> str:
    return f"{100 * fraction:.2g} %" if fraction < 1.0 else f"{100 * fraction:.0f} %"


def _relative(error: NumericalError) -> float:
    return error.at_most / abs(error.value)


def fraction(text: Any) -> float:
    """An error as a person gives it, "1 %" or 0.01. Raises SceneError."""
    try:
        return float(accuracy_share(text))
    except ValueError:
        raise SceneError(f"--to {text!s:.40}: an error from '0.01 %' to '20 %', such as '1 %'") from None


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
    reasons: dict[str, dict[str, str]] = field(default_factory=dict)
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
            self.dear += [error.answer.key for error in self._aims(self.tried[-1])]
            self._give_up(self._aims(self.tried[-1]), f"{ROUNDS} refinements one after the other were not enough")
        within = [
            tried for tried in self.tried if tried.largest(list(self.unreached)) <= self.to and self._is_better(tried)
        ]
        best = min(within or self.tried, key=lambda tried: tried.seconds if within else tried.largest())
        for _ in range(TRIES):
            coarser = self._coarser(best) if within and best.seconds > SHORT else None
            if coarser is None:
                break
            best = coarser
        reasons = {key: "; ".join(self.reasons[key].values()) for key in best.settings}
        missed = {e.answer.key for e in best.errors if e.value and _relative(e) > self.to}
        unreached = {key: why for key, why in self.unreached.items() if key in missed}
        return ChosenSettings(best, self.tried, reasons, unreached, self.to)

    def _is_better(self, tried: Settings) -> bool:
        """Whether numbers that are out of reach are about as good as they became, where that is worth it."""
        for key in self.dear:
            errors = [_relative(error) for each in self.tried for error in each.errors if error.answer.key == key]
            worth_it = errors[0] > WORTH_IT * min(errors)
            if worth_it and any(
                _relative(error) > ALLOWED * min(errors) for error in tried.errors if error.answer.key == key
            ):
                return False
        return True

    def _aims(self, now: Settings) -> list[NumericalError]:
        """Numbers whose error is too large, and within reach."""
        return [e for e in now.errors if e.value and _relative(e) > self.to and e.answer.key not in self.unreached]

    def _give_up(self, errors: Sequence[NumericalError], why: str) -> None:
        for error in errors:
            self.unreached[error.answer.key] = why

    def _refine(self, number: int) -> bool:
        """One round; False where there is nothing more to do."""
        now = self.tried[-1]
        self._leave_what_stays(now)
        aims = self._aims(now)
        if not aims:
            return False
        scene = changed(self.scene, now.settings)
        makeups, steps = [makeup_of(error, now.runs, self.to) for error in aims], Steps(self.plan(scene))
        so_far = now.seconds / max(self.tried[0].seconds, SHORTEST)
        narrow, proposal = narrower(scene, self.to), steps.finer(makeups, self.to, DEAREST / so_far)
        if proposal is None and not narrow:
            if steps.finer(makeups, self.to) is None:
                self._give_up(aims, "no resolution of the scene makes it smaller")
            else:
                self._give_up(aims, f"finer settings would take more than {DEAREST:g} times the time of the scene")
                self.dear += [error.answer.key for error in aims]
            return False
        spent = so_far * (proposal.cost if proposal is not None else 1.0)
        settings = (steps.settings(proposal) if proposal is not None else {}) | narrow
        self.reasons.setdefault("limit.accuracy", {}).update({"": "the interval of a load factor"} if narrow else {})
        self._say(f"round {number}", makeups, settings, proposal, spent)
        self._explain(steps, proposal, makeups)
        ended = Settings(now.settings | settings, *self.measure(changed(self.scene, now.settings | settings)))
        if ended.runs[0][1]["status"] != OK or not ended.errors:
            self._give_up(aims, f"the run with finer settings was {ended.runs[0][1]['status'].lower()}")
            return False
        self.tried.append(ended)
        return True

    def _leave_what_stays(self, now: Settings) -> None:
        """Numbers whose error is scatter, or did not become smaller."""
        for error in self._aims(now):
            key, size, scatter = error.answer.key, _relative(error), scatter_of(error)
            if size > IN_VAIN * self.smallest.get(key, 2.0 * size):
                self.in_vain[key] = self.in_vain.get(key, 0) + 1
            self.smallest[key] = min(size, self.smallest.get(key, size))
            tries = self.in_vain.get(key, 0)
            if scatter > SCATTER_AT_MOST * self.to or (scatter > self.to and tries):
                self._give_up([error], f"runs that differ in nothing of meaning differ by {_percent(scatter)}")
            elif tries >= TRIES:
                self._give_up([error], "finer settings do not make it smaller")

    def _say(
        self, what: str, makeups: Sequence[Makeup], settings: dict[str, Any], proposal: Proposal | None, spent: float
    ) -> None:
        """A line of a round: the worst number and what it comes from, what is set, and how long a run takes."""
        worst = max(makeups, key=lambda makeup: makeup.error)
        names = proposal.factors if proposal is not None else {}
        parts = ", ".join(f"{name} {_percent(worst.part(name))}" for name in names if worst.part(name) > 0.0)
        sets = ", ".join(f"{key} = {_toml(value)}" for key, value in settings.items())
        made = f" ({parts})" if parts else ""
        self.tell(f"{what}: {worst.words} within {_percent(worst.error)}{made}; {sets}: {spent:.2g} times the scene")

    def _explain(self, steps: Steps, proposal: Proposal | None, makeups: Sequence[Makeup]) -> None:
        """A comment for each resolution that was made finer: the number that it matters most to."""
        for name, factor in proposal.factors.items() if proposal is not None else ():
            worst = max(makeups, key=lambda makeup: makeup.part(name))
            why = f"{name} finer: made up {_percent(worst.part(name))} of the {worst.words}"
            for key in steps.resolutions[name].settings(factor) or {}:
                self.reasons.setdefault(key, {})[name] = why

    def _coarser(self, now: Settings) -> Settings | None:
        """Settings that take less time, and whose errors and verdict are as good; None where none are."""
        steps = Steps(self.plan(changed(self.scene, now.settings)))
        limits = {
            error.answer.key: max(self.to, ALLOWED * _relative(error) if error.answer.key in self.unreached else 0.0)
            for error in now.errors
            if error.value
        }
        errors = [error for error in now.errors if error.value]
        proposal = steps.coarser([(makeup_of(error, now.runs, self.to), limits[error.answer.key]) for error in errors])
        if proposal is None:
            return None
        settings = now.settings | steps.settings(proposal)
        names = ", ".join(proposal.factors)
        self.tell(f"coarser: {names}, which buy less than they cost: {proposal.cost:.2g} times the run so far")
        ended = Settings(settings, *self.measure(changed(self.scene, settings)))
        fits = ended.errors and all(
            _relative(error) <= limits.get(error.answer.key, self.to) for error in ended.errors if error.value
        )
        if not fits or ended.rank > now.rank or ended.seconds >= now.seconds:
            return None
        for name, factor in proposal.factors.items():
            for key in steps.resolutions[name].settings(factor) or {}:
                self.reasons.setdefault(key, {})[name] = f"{name} coarser: costs more than it buys"
        self.tried.append(ended)
        return ended
