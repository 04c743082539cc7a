"""Records of the ground from files: times and a column a component, under a line of names, or numbers alone.

Columns are separated by commas, or by semicolons, tabs or blanks; a comma in a number is its decimal point then. Cells
may stand in quotes, and separators behind the last of them. Files of PEER (.AT2) hold one component, line by line, and
say the time from sample to sample above it.
"""

import csv
import re
from dataclasses import dataclass
from decimal import Decimal
from itertools import pairwise
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
LOOKED_AT = 1000
"""Lines that are looked at to find out what separates columns."""
SHOWN = 8
"""Names of columns that a message shows."""
SEPARATORS = (";", "\t", None, ",")
"""Of columns, in the order in which they are looked for; None stands for blanks."""
_IN_BRACKETS = re.compile(r"\s*[(\[]\s*([^)\]]*)[)\]]\s*$")
_NAMED = re.compile(r"\"[^\"]*\"|\S+(?:\s+[(\[][^)\]]*[)\]])?")
_PEER = re.compile(
    r"NPTS\s*=\s*(\d+)(?:\s*,?\s*DT\s*=\s*([\d.]+(?:E[-+]?\d+)?))?|(\d+)(?:\s+(\d*\.\d*))?\s+NPTS", re.IGNORECASE
)
_PEER_UNIT = re.compile(r"UNITS OF ([A-Z/0-9]+)", re.IGNORECASE)
_WHOLE = re.compile(r"[-+]?\d+")
_PER_SECOND = {"acceleration": "m/s^2", "velocity": "m/s", "displacement": "m"}
NO_TIMES = "say the time from sample to sample, step = '0.01 s'"
NO_THOUSANDS = "write nothing between thousands, and the decimal point alike in all numbers"
GRAVITIES = {"g", "g's", "gs", "gn", "g_n", "G"}
"""What people write for the acceleration of gravity, 9.80665 m/s2."""


@dataclass(frozen=True)
class RecordFile:
    """What a file holds: names of its columns, and their values (rows, columns); times in s from 0 on, as `time` reads
    them; `step` (s) from sample to sample, where the file says so."""

    name: str
    columns: tuple[str, ...]
    values: np.ndarray
    step: float | None = None

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
        raise SceneError(
            f"{self.name} has no column '{visible(word[:60])}'; {known}; so does its number: '{len(plain)}'"
        )

    def unit_of(self, column: int) -> str | None:
        """What stands in brackets behind the name of a column."""
        match = _IN_BRACKETS.search(self.columns[column])
        return match[1].strip() if match and match[1].strip() else None

    def time(self, word: str | None, step: float | None = None) -> np.ndarray:
        """(n,) s, from 0 on, in equal steps; of the first column unless another is named or the step (s) is known.
        SceneError otherwise."""
        if self.step is not None and step is not None and abs(step - self.step) > ODD_STEP * step:
            raise SceneError(f"{self.name} says that its step is {self.step:g} s: leave ground.step out")
        if (step := step or self.step) is not None:
            return np.asarray(step * np.arange(len(self.values)))
        if len(self.columns) == 1:
            raise SceneError(f"{self.name} has no column of times: {NO_TIMES}")
        column = 0 if word is None else self.column(word)
        unit = self.unit_of(column)
        if unit is not None and unit.rstrip(".").lower() not in ("s", "sec", "secs", "second", "seconds"):
            raise SceneError(
                f"{self.name}: the time is in '{visible(unit[:40])}', and must be in s; if none has times, {NO_TIMES}"
            )
        return self._equal_steps(self.values[:, column])

    def _equal_steps(self, time: np.ndarray) -> np.ndarray:
        steps = np.diff(time)
        if not (steps > 0.0).all():
            k = int(np.argmin(steps > 0.0))
            raise SceneError(
                f"{self._row(k + 1)}: the time {time[k + 1]:.10g} s is not later than the one before, "
                f"{time[k]:.10g} s; if none has times, {NO_TIMES}"
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
                raise SceneError(
                    f"unit: missing; {self.name} does not say in which unit '{word}' is: unit = 'g', or 'cm/s2', ..."
                )
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
    separator, first = _first_numbers(name, lines)
    heads = lines[:first]
    if (match := _PEER.search("\n".join(heads))) is not None:
        step = match[2] or match[4]
        return _of_peer(name, heads, lines[first:], int(match[1] or match[3]), None if step is None else float(step))
    rows = _rows(lines[first:], separator)
    above = _rows([line.strip().lstrip("#%") for line in heads], separator)
    if above and _is_damaged(above[-1], len(rows[0])):
        rows.insert(0, above.pop())
    columns = _columns(name, above, rows, separator, bool(heads) and heads[-1].lstrip().startswith(("#", "%")))
    return _with_enough(RecordFile(name, tuple(columns), _numbers(name, rows, separator, len(columns))))


def _is_damaged(cells: list[str], width: int) -> bool:
    """Whether these are numbers, of which one is none, and no names."""
    return len(cells) == width and (_is_number(cells[0]) or any(map(_is_star, cells)))


def _columns(
    name: str, above: list[list[str]], rows: list[list[str]], separator: str | None, remark: bool
) -> list[str]:
    """Names of the columns, from the lines above the numbers; `remark`: whether the last of these need not be names."""
    width = len(rows[0])
    header = _names_and_units([cells for cells in above[-2:] if len(cells) == width])
    if header is not None:
        return header
    if separator == "," and _are_halves(rows):
        raise SceneError(
            f"{name}: '{visible(','.join(rows[0])[:40])}' may be {'one number' if width == 2 else 'numbers'} with a "
            "decimal comma: write the decimal point as '.', or separate columns by ';'; name columns of whole numbers"
        )
    if above and width > 1 and separator and not remark:
        raise SceneError(f"{name}: the line above the numbers names {len(above[-1])} columns, the numbers have {width}")
    return [f"column {k + 1}" for k in range(width)]


def _are_halves(rows: list[list[str]]) -> bool:
    """Whether these may be what stands before and behind decimal commas: whole numbers, an even number of them in each
    row, of which the first are no times."""
    whole = all(len(cells) % 2 == 0 and all(map(_WHOLE.fullmatch, cells)) for cells in rows)
    return whole and not all(float(a[0]) < float(b[0]) for a, b in pairwise(rows))


def _with_enough(record: RecordFile) -> RecordFile:
    if len(record.values) < FEWEST:
        raise SceneError(f"{record.name} has {len(record.values)} samples; a record has {FEWEST} or more")
    return record


def _of_peer(name: str, heads: list[str], lines: list[str], count: int, step: float | None) -> RecordFile:
    """The one component of a file of PEER, whose numbers go on from line to line, and are as many as it says; a step of
    None where it says none."""
    cells = " ".join(lines).split()
    wrong = next((cell for cell in cells if not _is_finite(cell)), None)
    if wrong is not None or (step is not None and step <= 0.0):
        raise SceneError(f"{name}: '{visible(str(wrong or step)[:40])}' is no number of a file of PEER")
    if len(cells) != count:
        raise SceneError(
            f"{name} says that it has NPTS = {count} samples, and {len(cells)} numbers follow: it is cut off, or a row "
            "of them is damaged"
        )
    unit = _PEER_UNIT.search("\n".join(heads))
    column = "column 1" if unit is None else f"column 1 ({unit[1].lower()})"
    return _with_enough(RecordFile(name, (column,), np.array(cells, dtype=float)[:, None], step))


def _first_numbers(name: str, lines: list[str]) -> tuple[str | None, int]:
    """What separates the columns, as it does in most of the first lines, and the number of the first line of numbers:
    of two or more, if there is one."""
    for fewest in (2, 1):
        separator = max(SEPARATORS, key=lambda one: _lines_of_numbers(lines[:LOOKED_AT], one, fewest))
        for k, line in enumerate(lines):
            cells = _cells(line, separator)
            if len(cells) >= fewest and all(map(_is_number, cells if separator is None else cells[:1])):
                return separator, k
    raise SceneError(f"{name} has no line of numbers")


def _lines_of_numbers(lines: list[str], separator: str | None, fewest: int) -> tuple[int, int]:
    """How many lines have nothing but numbers in so many columns or more, and how many begin with one."""
    rows = [cells for line in lines if len(cells := _cells(line, separator)) >= fewest]
    return sum(all(map(_is_number, cells)) for cells in rows), sum(_is_number(cells[0]) for cells in rows)


def _rows(lines: list[str], separator: str | None) -> list[list[str]]:
    """Cells of lines in which there is something, without empty ones behind the last, where all lines have them."""
    rows = [cells for line in lines if any(cells := _cells(line, separator))]
    while rows and all(len(cells) > 1 and not cells[-1] for cells in rows):
        rows = [cells[:-1] for cells in rows]
    return rows


def _cells(line: str, separator: str | None) -> list[str]:
    """Of a line, without quotes; among blanks a unit in brackets belongs to the name before it."""
    if separator is None:
        cells = _NAMED.findall(line)
    elif '"' in line:
        cells = next(csv.reader([line], delimiter=separator, skipinitialspace=True))
    else:
        cells = line.split(separator)
    return [cell.strip().strip("\"'").strip() for cell in cells]


def _point(cell: str) -> str:
    """A number with a decimal point; a comma at its end stands between two of them."""
    return cell if cell.endswith(",") else cell.replace(",", ".")


def _is_number(cell: str) -> bool:
    return _is_finite(_point(cell))


def _is_star(cell: str) -> bool:
    """Whether a number was too long for its place."""
    return bool(cell) and not cell.strip("*")


def _names_and_units(above: list[list[str]]) -> list[str] | None:
    """The names above the numbers; where units have a line of their own below them, both as one."""
    if len(above) < 2:
        return above[0] if above else None
    names, units = above
    plain = [unit.strip("()[]").strip() for unit in units]
    if not all(not unit or unit != inner or _is_unit(inner) for unit, inner in zip(units, plain, strict=True)):
        return units
    return [f"{one} ({unit})" if unit else one for one, unit in zip(names, plain, strict=True)]


def _is_unit(text: str) -> bool:
    """Whether this is the unit of a time or of a motion, without brackets."""
    if text in ("s", "sec"):
        return True
    for quantity in _PER_SECOND:
        try:
            factor_of(text, quantity, "")
        except SceneError:
            continue
        return True
    return False


def _numbers(name: str, rows: list[list[str]], separator: str | None, width: int) -> np.ndarray:
    """(n, width) finite numbers."""
    try:
        values = np.array([[_point(cell) for cell in cells] for cells in rows], dtype=float)
    except ValueError:
        values = np.full(1, np.nan)
    if values.shape == (len(rows), width) and np.isfinite(values).all():
        _require_one_point(name, rows)
        return values
    for k, cells in enumerate(rows):
        where = f"{name}, row {k + 1} of the numbers"
        if len(cells) != width:
            raise SceneError(f"{where}: {len(cells)} columns, where the first has {width}")
        for cell in cells:
            shown = visible(repr(cell[:40]))
            if "." in cell and "," in cell and _is_finite(re.sub("[.,]", "", cell)):
                raise SceneError(f"{where}: {shown} has a point and a comma: {NO_THOUSANDS}")
            if not _is_number(cell):
                raise SceneError(
                    f"{where}: {shown} is not a finite number; fill the gap, or leave out the rows before or after it"
                )
    raise SceneError(f"{name}: its numbers cannot be read")


def _require_one_point(name: str, rows: list[list[str]]) -> None:
    """SceneError where some numbers have a point and others a comma: one of them may stand between thousands."""
    comma = next((cell for cells in rows for cell in cells if "," in cell), None)
    point = None if comma is None else next((cell for cells in rows for cell in cells if "." in cell), None)
    if point is not None:
        raise SceneError(
            f"{name} has '{visible(point[:40])}' with a point and '{visible(str(comma)[:40])}' with a comma: "
            f"{NO_THOUSANDS}"
        )


def _is_finite(cell: str) -> bool:
    try:
        return isfinite(float(cell))
    except ValueError:
        return False


def _plain(name: str) -> str:
    """A name without the unit behind it, in small letters."""
    return _IN_BRACKETS.sub("", name).strip().lower()


def _last_digit(time: np.ndarray) -> float:
    """s: one of the last digit with which times were printed."""
    few = time[np.linspace(0, len(time) - 1, min(len(time), 200)).astype(int)]
    exponents = [Decimal(repr(float(t))).normalize().as_tuple().exponent for t in few if t != 0.0]
    return float(10.0 ** min((e for e in exponents if isinstance(e, int)), default=0))
