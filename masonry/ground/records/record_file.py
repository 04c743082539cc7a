"""Content of a file of a record: names of its columns and their values; its statements on times and units."""

import re
from dataclasses import dataclass
from decimal import Decimal

import numpy as np

from masonry.errors import SceneError, nearest, visible
from masonry.ground.records.motion_units import factor_of

FEWEST = 3
"""Samples of a record."""
SHORTEST_STEP, LONGEST_STEP = 1e-9, 1e5
"""s, from sample to sample: far outside of what instruments take."""
ODD_STEP = 1e-3
"""Of the step: how far a time may lie from equal steps, and a step from one that the file or its times say."""
ROUNDED, MOST_ROUNDED = 0.51, 0.2
"""Of the last digit that is printed: how far it may lie besides, but no more than a share of the step."""
SHOWN = 8
"""Names of columns that a message shows."""
SECONDS = ("s", "sec", "secs", "second", "seconds")
_IN_BRACKETS = re.compile(r" ?[(\[] ?([^()\[\]]*)[)\]]$")
NO_TIMES = "say the time from sample to sample, step = '0.01 s'"


@dataclass(frozen=True)
class RecordFile:
    """Names of the columns, and their values (rows, columns); times in s from 0 on, as `time` reads them.

    step  s from sample to sample, where a head says so
    unit  of columns that do not name one, where a head says so
    """

    name: str
    columns: tuple[str, ...]
    values: np.ndarray
    step: float | None = None
    unit: str | None = None

    def __post_init__(self) -> None:
        if len(self.values) < FEWEST:
            raise SceneError(f"{self.name} has {len(self.values)} samples; a record has {FEWEST} or more")

    def column(self, word: str) -> int:
        """The number of a column by its name, without the unit in brackets, in letters of any size; or by its number
        from 1 on. SceneError names those that there are."""
        plain = [_plain(name) for name in self.columns]
        for k, name in enumerate(self.columns):
            if word == name:
                return k
        alike = [k for k, name in enumerate(plain) if name in (_plain(word), word.strip().lower())]
        if len(alike) > 1:
            raise SceneError(f"{self.name} has {len(alike)} columns '{visible(word[:60])}': give each its own name")
        if alike:
            return alike[0]
        if word.isdecimal() and len(word) < 9 and 1 <= int(word) <= len(plain):
            return int(word) - 1
        known = nearest(_plain(word), [visible(name[:60]) for name in plain[:SHOWN]])
        raise SceneError(
            f"{self.name} has no column '{visible(word[:60])}'; {known}; so does its number: '{len(plain)}'"
        )

    def unit_of(self, column: int) -> str | None:
        """Unit in brackets behind the name of a column, or the one that the head gives."""
        match = _IN_BRACKETS.search(" ".join(self.columns[column].split()))
        unit = match[1].strip() if match else ""
        return unit or (None if _plain(self.columns[column]) in ("t", "time") else self.unit)

    def time(self, word: str | None, step: float | None = None) -> np.ndarray:
        """(n,) s, from 0 on, in equal steps; of the first column unless another is named or the step (s) is known.
        SceneError otherwise, and where file, times and step contradict each other."""
        if self.step is not None:
            _require_step(self.name, self.step)
            self._require_alike(self.step, step)
        known = self.step if step is None else step
        column = self.times_in(word, step)
        if known is None or (column is not None and step is None):
            if column is None:
                raise SceneError(f"{self.name} has no column of times: {NO_TIMES}")
            time = self._equal_steps(self.values[:, column])
            self._require_alike(float(time[1]), known)
            return time
        _require_step("step", known)
        if column is not None:
            self._require_alike(float(self._equal_steps(self.values[:, column])[1]), known)
        return np.asarray(known * np.arange(len(self.values)))

    def times_in(self, word: str | None, step: float | None = None) -> int | None:
        """The number of the column of times: of that name, or the first, where nothing else says the step or it rises
        in equal steps. SceneError where it is not in s."""
        if len(self.columns) == 1:
            return None
        column = 0 if word is None else self.column(word)
        if word is None and (step is not None or self.step is not None) and not self._rises(column):
            return None
        unit = self.unit_of(column) if _IN_BRACKETS.search(self.columns[column]) else None
        if unit is not None and unit.rstrip(".").lower() not in SECONDS:
            if word is None and step is not None:
                return None
            raise SceneError(
                f"{self.name}: the time is in '{visible(unit[:40])}', and must be in s; if none has times, {NO_TIMES}"
            )
        return column

    def _require_alike(self, file_step: float, step: float | None) -> None:
        if step is not None and abs(step - file_step) > ODD_STEP * file_step:
            raise SceneError(
                f"{self.name} says that its step is {file_step:g} s, and not {step:g} s: leave ground.step out"
            )

    def _rises(self, column: int) -> bool:
        try:
            self._equal_steps(self.values[:, column])
        except SceneError:
            return False
        return True

    def _equal_steps(self, time: np.ndarray) -> np.ndarray:
        steps = np.diff(time)
        if not (steps > 0.0).all():
            k = int(np.argmin(steps > 0.0))
            raise SceneError(
                f"{self._row(k + 1)}: the time {time[k + 1]:.10g} s is not later than the one before, "
                f"{time[k]:.10g} s; if none has times, {NO_TIMES}"
            )
        step = (time[-1] - time[0]) / (len(time) - 1)
        _require_step(self.name, float(step))
        equal = step * np.arange(len(time))
        odd = np.abs(time - time[0] - equal) > max(
            ODD_STEP * step, min(ROUNDED * _last_digit(time), MOST_ROUNDED * step)
        )
        if odd.any():
            usual = float(np.median(steps))
            k = int(np.argmax(np.abs(steps - usual)))
            raise SceneError(
                f"{self._row(k + 1)}: a step of {steps[k]:.6g} s, where the others are {usual:.6g} s: a record has "
                "equal steps; is a row missing or doubled? Else interpolate it to equal steps"
            )
        return np.asarray(equal)

    def _row(self, k: int) -> str:
        return f"{self.name}, row {k + 1} of the numbers"

    def samples(self, word: str, quantity: str, unit: str | None) -> np.ndarray:
        """(n,) of one component in SI: m/s2, m/s or m. SceneError where the unit is none of the quantity."""
        column = self.column(word)
        in_file = self.unit_of(column)
        if unit is None:
            unit = in_file
            if unit is None:
                raise SceneError(
                    f"unit: missing; {self.name} does not say in which unit '{word}' is: unit = 'g', or 'cm/s2', ..."
                )
            return self.values[:, column] * factor_of(unit, quantity, f"{self.name}, column '{word}'")
        factor = factor_of(unit, quantity, "unit")
        if in_file is not None:
            file_factor = factor_of(in_file, quantity, f"{self.name}, column '{word}'")
            if abs(file_factor - factor) > 1e-3 * file_factor:
                raise SceneError(
                    f"unit = '{unit}', but {self.name} says that '{word}' is in '{visible(in_file[:40])}': one of them "
                    "is wrong; leave unit out to take the file's"
                )
        return self.values[:, column] * factor


def _require_step(where: str, step: float) -> None:
    if not SHORTEST_STEP <= step <= LONGEST_STEP:
        raise SceneError(
            f"{where}: a step of {step:.3g} s from sample to sample; allowed: {SHORTEST_STEP:g} to {LONGEST_STEP:g} s"
        )


def _plain(name: str) -> str:
    """A name without the unit behind it, in small letters."""
    return _IN_BRACKETS.sub("", " ".join(name.split())).strip().lower()


def _last_digit(time: np.ndarray) -> float:
    """s: one of the last digit with which times were printed."""
    few = time[np.linspace(0, len(time) - 1, min(len(time), 200)).astype(int)]
    exponents = [Decimal(repr(float(t))).normalize().as_tuple().exponent for t in few if t != 0.0]
    return float(10.0 ** min((e for e in exponents if isinstance(e, int)), default=0))
