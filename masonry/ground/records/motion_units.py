"""Units of the motion of the ground, as people and networks write them."""

import re

from masonry.errors import SceneError, visible
from masonry.quantity import GRAVITY
from masonry.units import measure

UNITS = {"acceleration": "m/s^2", "velocity": "m/s", "displacement": "m"}
"""In SI."""
GRAVITIES = {"g", "g's", "gs", "gn", "g_n", "G"}
"""What people write for the acceleration of gravity, 9.80665 m/s2."""


def factor_of(unit: str, quantity: str, where: str) -> float:
    """One of a unit in SI; "g" is the acceleration of gravity. SceneError where it does not fit the quantity."""
    factor = _factor(unit, quantity)
    if factor is not None:
        return factor
    si_unit = UNITS[quantity]
    other = next((candidate for candidate in UNITS if _factor(unit, candidate) is not None), None)
    if other is not None:
        says = f"of {_a(other)}, and not of {_a(quantity)}; is quantity = '{other}' meant?"
        raise SceneError(f"{where}: '{visible(unit[:40])}' is the unit {says}")
    example = "g, m/s^2 or cm/s^2" if quantity == "acceleration" else f"{si_unit} or c{si_unit}"
    raise SceneError(f"{where}: '{visible(unit[:40])}' is no unit of {_a(quantity)}; give {example}")


def is_unit(text: str) -> bool:
    """Whether this is the unit of a motion, without brackets."""
    return any(_factor(text, quantity) is not None for quantity in UNITS)


def _factor(unit: str, quantity: str) -> float | None:
    if quantity == "acceleration" and unit.strip() in GRAVITIES:
        return float(GRAVITY)
    if quantity == "acceleration" and unit.strip().lower() in ("gal", "gals"):
        return 0.01
    text = re.sub(r"(?<=[a-z])(-?\d)", r"^\1", unit.strip().replace("²", "2").replace("^", "").replace("**", ""))
    text = re.sub(r"\bsec\b", "s", text)
    text = re.sub(r"s/s$|s\*s$", "s^2", text)
    try:
        measured = measure(text) if text and re.fullmatch(r"[A-Za-z/*^ 0-9-]+", text) else None
    except ValueError:
        return None
    return None if measured is None or measured.powers != measure(UNITS[quantity]).powers else float(measured.factor)


def _a(quantity: str) -> str:
    return f"an {quantity}" if quantity[0] == "a" else f"a {quantity}"
