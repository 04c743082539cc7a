"""Quantities as people write them: "0.87 MPa" becomes an SI float, exactly rounded, or one sentence that says why not.

A text must match a short strict grammar: a number, then at most six units with small powers. So no text can be an
expression, hang or grow without bound. Factors are exact fractions (masonry/units.py), so "1 N/mm^2" and "1 MPa" give
the same bits, and so does an SI value written out and read again.
"""

import math
import re
from fractions import Fraction
from functools import lru_cache
from typing import Any, NamedTuple

from masonry.errors import SceneError
from masonry.units import SYMBOL, measure


class Kind(NamedTuple):
    """A physical kind: what to call it, its SI unit, and how a user may write it."""

    words: str
    unit: str
    example: str


KINDS = {
    "length": Kind("a length", "m", "200 mm"),
    "area": Kind("an area", "m^2", "0.01 m^2"),
    "time": Kind("a time", "s", "1e-6 s"),
    "frequency": Kind("a frequency", "Hz", "2 Hz"),
    "rate": Kind("a rate", "s^-1", "0.5 s^-1"),
    "angle": Kind("an angle", "rad", "45 deg"),
    "velocity": Kind("a velocity", "m/s", "0.1 mm/s"),
    "angular velocity": Kind("an angular velocity", "rad/s", "2 rad/s"),
    "acceleration": Kind("an acceleration", "m/s^2", "-9.81 m/s^2"),
    "mass": Kind("a mass", "kg", "200 kg"),
    "density": Kind("a density", "kg/m^3", "1900 kg/m^3"),
    "force": Kind("a force", "N", "10 kN"),
    "stress": Kind("a stress", "Pa", "0.5 MPa"),
    "stiffness": Kind("a stress per length", "Pa/m", "150 GPa/m"),
    "energy": Kind("an energy per area", "N/m", "58 N/m"),
    "energy per stress": Kind("an energy per area and stress", "N/m/Pa", "130 N/m/MPa"),
    "number": Kind("a plain number", "", "0.2"),
    "integer": Kind("a whole number", "", "20"),
}

_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?"
_SYMBOL = rf"{SYMBOL}(?:(?:\^|\*\*)?-?[1-9])?"
_TEXT = re.compile(rf"\s*({_NUMBER})\s*({_SYMBOL}(?:\s*[*/ ]\s*{_SYMBOL}){{0,5}})?\s*", re.ASCII)
_POWERS = str.maketrans({"²": "2", "³": "3", "⁴": "4", "·": "*"})
_LONGEST = 80
GRAVITY = Fraction("9.80665")
"""m/s^2, the standard one, by which a unit weight is divided where a density is asked for."""
_ALLOWED = re.compile(r"([\[(])(-?[\d.e+-]+|-inf), (-?[\d.e+-]+|inf)([\])])(?: (.+))?")


def parse(text: Any, kind: str, where: str, allowed: str = "(-inf, inf)") -> float:
    """SI value of a text such as "0.87 MPa", or of a number where `kind` is "number" or "integer".

    kind     a key of KINDS
    where    what the message starts with: file, line and dotted key
    allowed  an interval such as "[0, 0.5)" or "[0, 90) deg", in SI unless it names a unit
    Raises SceneError with what is wrong, what is allowed and the nearest valid choice.
    """
    try:
        return convert(text, kind, where.split()[-1].rsplit(".", 1)[-1] if where.split() else kind, allowed)
    except ValueError as error:
        raise SceneError(f"{where}: {error}") from None


def convert(value: Any, kind: str, name: str, allowed: str = "(-inf, inf)") -> float:
    """As `parse`; `name` is the last part of the key. Raises ValueError without the place."""
    need = f"{name} is {KINDS[kind].words}, for example {written(kind)}"
    if isinstance(value, bool) or not isinstance(value, (str, int, float)):
        raise ValueError(f"{_short(value)} is not a quantity; {need}")
    if kind in ("number", "integer"):
        si = _plain(value, kind, need)
    elif isinstance(value, str):
        si = _with_unit(value, kind, name, need)
    else:
        raise ValueError(f"{_short(value)} has no unit; {need}")
    if not math.isfinite(si):
        raise ValueError(f"{_short(value)} is not a finite number; {need}")
    _check(si, value, name, allowed, KINDS[kind].unit)
    return si


def _plain(value: str | float, kind: str, need: str) -> float:
    try:
        if isinstance(value, str) and not is_plain(value):
            raise ValueError
        if kind == "integer" and float(value).is_integer():
            return int(value) if isinstance(value, int) else int(float(value))
        if kind == "number":
            return float(value)
    except (ValueError, OverflowError):
        pass
    raise ValueError(f"{_short(value)} is not {KINDS[kind].words}; {need}")


def _with_unit(text: str, kind: str, name: str, need: str) -> float:
    match = _TEXT.fullmatch(text.translate(_POWERS)) if len(text) <= _LONGEST else None
    if match is None:
        hint = "; write the decimal point as '.'" if re.match(r"\s*[+-]?\d+,\d", text[:_LONGEST]) else ""
        raise ValueError(f"{_short(text)} is not a number and a unit{hint}; {need}")
    number, unit = match.groups()
    if unit is None:
        raise ValueError(f"{_short(text)} has no unit; {need}")
    factor, powers = measure(unit)
    if kind == "density" and powers == measure("N/m^3").powers:
        return float(Fraction(number) * factor / GRAVITY)
    if powers != measure(KINDS[kind].unit).powers:
        if measure(f"{KINDS['acceleration'].unit}*{unit}").powers == measure(KINDS[kind].unit).powers:
            weight = float(Fraction(number) * factor * GRAVITY)
            raise ValueError(
                f"{_short(text)} tells by mass what {name} tells by force: its weight is '{weight:.6g} "
                f"{KINDS[kind].unit}'"
            )
        alike = (k for k in KINDS.values() if k.unit and measure(k.unit).powers == powers)
        is_a = next((f"{unit} is {k.words}" for k in alike), None)
        raise ValueError(f"{is_a or f'{unit} does not fit'}; {need}")
    try:
        return float(Fraction(number) * factor)
    except OverflowError:
        return math.inf


def is_plain(text: str) -> bool:
    """Whether nothing stands between digits, and no digits of other scripts, which Python takes for numbers."""
    return text.isascii() and "_" not in text


def is_unit_weight(value: Any) -> bool:
    """Whether a text is a force per volume, such as "18 kN/m^3"."""
    match = _TEXT.fullmatch(value.translate(_POWERS)) if isinstance(value, str) and len(value) <= _LONGEST else None
    try:
        return match is not None and match[2] is not None and measure(match[2]).powers == measure("N/m^3").powers
    except ValueError:
        return False


@lru_cache(maxsize=256)
def _interval(allowed: str) -> tuple[bool, float, float, bool, str]:
    """(low is excluded, low, high, high is excluded, in words) of "[0, 0.5)" or "[0, 90) deg"; bounds in SI."""
    match = _ALLOWED.fullmatch(allowed)
    if match is None:
        raise TypeError(f"not an interval: {allowed}")
    left, low, high, right, unit = match.groups()
    factor = float(measure(unit).factor) if unit else 1.0
    words = f"in {allowed}"
    if high == "inf":
        words = f"more than {low}" if left == "(" else f"{low} or more"
    return left == "(", float(low) * factor, float(high) * factor, right == ")", words


def _check(si: float, value: Any, name: str, allowed: str, unit: str) -> None:
    """`unit` is that of an interval which names none, and has bounds other than 0 and inf."""
    above, low, high, below, words = _interval(allowed)
    if si < low or si > high or (above and si == low) or (below and si == high):
        names = f" {unit}" if unit and allowed[-1] in ")]" and {low, high} - {0.0, math.inf} else ""
        raise ValueError(f"{_short(value)} is out of range; {name} must be {words}{names}")


def is_interval(text: str) -> bool:
    """Whether a text is an interval as `parse` takes it."""
    return _ALLOWED.fullmatch(text) is not None


def written(kind: str) -> str:
    """The kind's example as it stands in a file: quoted where it has a unit."""
    return f"'{KINDS[kind].example}'" if KINDS[kind].unit else KINDS[kind].example


def _short(value: Any) -> str:
    """Value as the user wrote it, quoted if a text, and cut where it is long."""
    try:
        text = repr(value[:_LONGEST] + "...") if isinstance(value, str) and len(value) > _LONGEST else repr(value)
    except ValueError:
        return "this number"
    return text if len(text) <= _LONGEST + 8 else text[:_LONGEST] + "..."
