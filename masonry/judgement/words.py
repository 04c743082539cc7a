"""How shares, stresses and blocks are written in sentences."""

from collections.abc import Mapping
from typing import Any

ROUNDING, BELOW_0 = 1e-11, 1e-5
"""Shares of energy that are shown as 0: smaller ones, and negative ones down to this (only rounding makes them)."""


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
