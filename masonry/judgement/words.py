"""How a share and a block are written in a sentence of trust."""

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
