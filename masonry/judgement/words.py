"""How shares, stresses and blocks are written in sentences."""

from collections.abc import Mapping
from math import radians
from typing import Any

ROUNDING, BELOW_0 = 1e-11, 1e-5
"""Shares of energy that are shown as 0: smaller ones, and negative ones down to this (only rounding makes them)."""
POWERS = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"))
PREFIXED = ("Pa", "N", "Pa/m", "N/m", "J", "m")
"""Units that take a letter for a power of a thousand."""


def percent(fraction: float, digits: int = 2) -> str:
    """A fraction as a percentage, 0 where it is rounding."""
    return f"{0.0 if -BELOW_0 < fraction < ROUNDING else 100 * fraction:.{digits}g} %"


def block_at(place: Mapping[str, Any]) -> str:
    """A block, by its number and where it was made (m)."""
    return f"block {place['block']} at ({', '.join(f'{x:.4g}' for x in place['at_m'])}) m"


def stress_text(stress: float | None, section: float | None) -> str:
    """A stress (Pa), and the force that it stands for, with the section (m2) between them."""
    words = number_text(stress, 1e-6, "MPa")
    if stress is None or section is None:
        return words
    return f"{words} (force {1e-3 * stress * section:.4g} kN over a section of {section:.4g} m2)"


def number_text(value: float | None, factor: float, unit: str) -> str:
    """A number in SI, times a factor, in a unit."""
    return "not known" if value is None else f"{value * factor:.4g} {unit}"


def scale_of(size: float, unit: str) -> tuple[float, str]:
    """Factor to SI, and name, of the unit in which people read numbers of such a size: 600000 Pa is 0.6 MPa."""
    if unit == "rad":
        return radians(1.0), "deg"
    if unit == "m^2" and abs(size) < 0.01:
        return 1e-6, "mm^2"
    if unit not in PREFIXED:
        return 1.0, unit
    factor, letter = next((power for power in POWERS if abs(size) >= 0.1 * power[0]), POWERS[-1 if size else 3])
    return factor, f"{letter}{unit}"


def readable(value: Any, digits: int = 6) -> str:
    """A value of a scene with a prefix to its unit, an angle in degrees: `600000.0 Pa` is 0.6 MPa."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, dict):
        return " and ".join(f"{readable(number)} at {readable(place)}" for place, number in value.items())
    number, _, unit = str(value).partition(" ")
    try:
        size = float(number)
    except ValueError:
        return str(value)
    factor, name = scale_of(size, unit)
    return f"{size / factor:.{digits}g} {name}".strip()
