"""Records of the ground from files: time and one column a component, separated by commas, under a line of names."""

import re
from dataclasses import dataclass
from decimal import Decimal
from math import isfinite
from pathlib import Path

import numpy as np

from masonry.errors import SceneError, nearest, visible
from masonry.quantity import GRAVITY
from masonry.runtime.text_files import text_of
from masonry.units import measure

LARGEST = 200_000_000
"""Bytes of a file."""
FEWEST = 3
"""Samples of a record."""
ODD_STEP = 1e-3
"""Of the step: how far a time may lie from equal steps."""
ROUNDED, MOST_ROUNDED = 0.51, 0.2
"""Of the last digit that is printed: how far it may lie besides, but no more than a share of the step."""
SHOWN = 8
"""Names of columns that a message shows."""
_IN_BRACKETS = re.compile(r"\s*[(\[]\s*([^)\]]*)[)\]]\s*$")
_PER_SECOND = {"acceleration": "m/s^2", "velocity": "m/s", "displacement": "m"}
GRAVITIES = {"g", "g's", "gs", "gn", "g_n", "G"}
"""What people write for the acceleration of gravity, 9.80665 m/s2."""


@dataclass(frozen=True)
class RecordFile:
    """What a file holds: names of its columns, and their values (rows, columns); times in s from 0 on, as `time` reads
    them."""

    name: str
    columns: tuple[str, ...]
    values: np.ndarray
    first_line: int

    def column(self, word: str) -> int:
        """The number of a column by its name, without the unit in brackets, in letters of any size; or by its number
        from 1 on. SceneError names those that there are."""
        plain = [_plain(name) for name in self.columns]
        for k, name in enumerate(self.columns):
            if word == name:
                return k
        alike = [k for k, name in enumerate(plain) if name == _plain(word)]
        if len(alike) > 1:
            raise SceneError(f"{self.name} has {len(alike)} columns '{visible(word[:60])}': give each its own name")
        if alike:
            return alike[0]
        if word.isdecimal() and 1 <= int(word) <= len(plain):
            return int(word) - 1
        known = nearest(_plain(word), [visible(name[:60]) for name in plain[:SHOWN]])
        raise SceneError(f"{self.name} has no column '{visible(word[:60])}'; {known}; a number names one too: '2'")

    def unit_of(self, column: int) -> str | None:
        """What stands in brackets behind the name of a column."""
        match = _IN_BRACKETS.search(self.columns[column])
        return match[1].strip() if match and match[1].strip() else None

    def time(self, word: str | None) -> np.ndarray:
        """(n,) s, from 0 on, in equal steps; of the first column unless another is named. SceneError otherwise."""
        column = 0 if word is None else self.column(word)
        unit = self.unit_of(column)
        if unit is not None and unit.rstrip(".").lower() not in ("s", "sec", "secs", "second", "seconds"):
            raise SceneError(f"{self.name}: the time is in '{visible(unit[:40])}', and must be in s")
        return self._equal_steps(self.values[:, column])

    def _equal_steps(self, time: np.ndarray) -> np.ndarray:
        steps = np.diff(time)
        if not (steps > 0.0).all():
            k = int(np.argmin(steps > 0.0))
            raise SceneError(
                f"{self._row(k + 1)}: the time {time[k + 1]:.10g} s is not later than the one before, {time[k]:.10g} s"
            )
        step = (time[-1] - time[0]) / (len(time) - 1)
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
                raise SceneError(f"unit: missing; {self.name} does not say in which unit '{word}' is: unit = 'g'")
            return self.values[:, column] * factor_of(unit, quantity, f"{self.name}, column '{word}'")
        factor = factor_of(unit, quantity, "unit")
        if in_file is not None:
            own = factor_of(in_file, quantity, f"{self.name}, column '{word}'")
            if abs(own - factor) > 1e-3 * own:
                raise SceneError(
                    f"unit = '{unit}', but {self.name} says that '{word}' is in '{visible(in_file[:40])}': one of them "
                    "is wrong; leave unit out to take the file's"
                )
        return self.values[:, column] * factor


def factor_of(unit: str, quantity: str, where: str) -> float:
    """One of a unit in SI; "g" is the acceleration of gravity. SceneError where it does not fit the quantity."""
    wanted = _PER_SECOND[quantity]
    example = "g, m/s^2 or cm/s^2" if quantity == "acceleration" else f"{wanted} or c{wanted}"
    if quantity == "acceleration" and unit.strip() in GRAVITIES:
        return float(GRAVITY)
    if quantity == "acceleration" and unit.strip().lower() in ("gal", "gals"):
        return 0.01
    text = re.sub(r"(?<=[a-z])(-?\d)", r"^\1", unit.strip().replace("²", "2").replace("^", ""))
    text = re.sub(r"s/s$|s\*s$", "s^2", text)
    try:
        one = measure(text) if text and re.fullmatch(r"[A-Za-z/*^ 0-9-]+", text) else None
    except ValueError:
        one = None
    if one is None or one.powers != measure(wanted).powers:
        raise SceneError(f"{where}: '{visible(unit[:40])}' is no unit of {_a(quantity)}; give {example}")
    return float(one.factor)


def _a(quantity: str) -> str:
    return f"an {quantity}" if quantity[0] == "a" else f"a {quantity}"


def read_record(path: Path) -> RecordFile:
    """The numbers of a file. Raises SceneError: one message with the file and the row."""
    text, name = text_of(path, LARGEST), f"'{path.name}'"
    lines = text.splitlines()
    first = next((k for k, line in enumerate(lines) if _is_numbers(line)), None)
    if first is None:
        raise SceneError(_why_no_numbers(name, lines))
    width = lines[first].count(",") + 1
    above = [line.strip().lstrip("#%").strip() for line in lines[:first] if line.strip()]
    header = _names_and_units([line for line in above[-2:] if line.count(",") + 1 == width])
    if header is None and above and not lines[first - 1].lstrip().startswith(("#", "%")):
        raise SceneError(
            f"{name}: the line above the numbers names {above[-1].count(',') + 1} columns, the numbers have {width}"
        )
    columns = [f"column {k + 1}" for k in range(width)]
    if header is not None:
        columns = [column.strip().strip("\"'") for column in header.split(",")]
    values = _numbers(name, lines[first:], width)
    if len(values) < FEWEST:
        raise SceneError(f"{name} has {len(values)} samples; a record has {FEWEST} or more")
    return RecordFile(name, tuple(columns), values, first + 1)


def _names_and_units(above: list[str]) -> str | None:
    """The line of names above the numbers; where units in brackets have a line of their own below it, both as one."""
    if not above or len(above) == 1:
        return above[0] if above else None
    names, units = (line.split(",") for line in above)
    if all(not unit.strip() or re.fullmatch(r"\s*[(\[].*[)\]]\s*", unit) for unit in units):
        return ",".join(f"{one.strip()} {unit.strip()}" for one, unit in zip(names, units, strict=True))
    return above[1]


def _numbers(name: str, lines: list[str], width: int) -> np.ndarray:
    """(n, width) finite numbers."""
    rows = [line for line in lines if line.strip()]
    try:
        values = np.array([line.split(",") for line in rows], dtype=float)
        if values.shape == (len(rows), width) and np.isfinite(values).all():
            return values
    except ValueError:
        pass
    for k, line in enumerate(rows):
        cells = line.split(",")
        if len(cells) != width:
            raise SceneError(f"{name}, row {k + 1} of the numbers: {len(cells)} columns, where the first has {width}")
        for cell in cells:
            if not _is_finite(cell):
                raise SceneError(
                    f"{name}, row {k + 1} of the numbers: {visible(repr(cell.strip()[:40]))} is not a finite number; "
                    "fill the gap, or leave out the rows before or after it"
                )
    raise SceneError(f"{name}: its numbers cannot be read")


def _is_numbers(line: str) -> bool:
    """Whether a line begins with a finite number and a comma."""
    cells = line.split(",")
    return len(cells) > 1 and ";" not in line and _is_finite(cells[0])


def _is_finite(cell: str) -> bool:
    try:
        return isfinite(float(cell))
    except ValueError:
        return False


def _why_no_numbers(name: str, lines: list[str]) -> str:
    """What to say of a file in which no line of numbers was found."""
    for line in lines:
        if re.match(r"\s*[-+]?[\d.,]+(?:[eE][-+]?\d+)?\s*;", line):
            decimal = " and write the decimal point as '.'" if re.search(r"\d,\d", line) else ""
            return f"{name}: columns are separated by ';'; separate them by ','{decimal}"
        if re.match(r"\s*[-+]?[\d.]+(?:[eE][-+]?\d+)?[ \t]+[-+]?[\d.]", line):
            return f"{name}: columns are separated by blanks; separate them by ','"
    return f"{name} has no line with two or more numbers, separated by ','"


def _plain(name: str) -> str:
    """A name without the unit behind it, in small letters."""
    return _IN_BRACKETS.sub("", name).strip().lower()


def _last_digit(time: np.ndarray) -> float:
    """s: one of the last digit with which times were printed."""
    few = time[np.linspace(0, len(time) - 1, min(len(time), 200)).astype(int)]
    exponents = [Decimal(repr(float(t))).normalize().as_tuple().exponent for t in few if t != 0.0]
    return float(10.0 ** min((e for e in exponents if isinstance(e, int)), default=0))
