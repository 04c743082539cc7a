"""Which walls are bent: the strengths that Table 5 has lost, units 3 to 10 times as strong as joints, and more."""

from collections.abc import Iterable
from itertools import product

GAUGE = "mid-span deflection"
SCENES = {"0 MPa": "bending-0", "0.25 MPa": "bending-025"}
"""Pre-compression -> packaged scene."""
ASSUMED = (0.25, 2.25)
"""Tensile strength of interfaces and of units as shipped, MPa: with these both patterns of the paper come out."""
WEAKER = (0.5, 1.5)
"""A pair whose units are only three times as strong as its joints."""
INTERFACES, RATIOS = (0.25, 0.5), (3, 6, 8, 9, 10)
STRENGTHS = tuple((joint, joint * ratio) for joint, ratio in product(INTERFACES, RATIOS))
"""All that are mapped."""
SEEDS = (2, 3)
POINTS = (6, 14)
"""Contact points through the thickness, beside the ten of the paper."""

Pair = tuple[float, float]


def strengths(interface: float, units: float) -> dict[str, str]:
    """The keys that a pair of tensile strengths (MPa) sets: cohesions go with it, as in Table 5."""
    return {
        f"contact.{group}.{key}": f"{factor * strength:g} MPa"
        for group, strength in (("unit_unit", interface), ("within_units", units))
        for key, factor in (("tensile_strength", 1.0), ("cohesion", 1.5), ("residual_cohesion", 0.015))
    }


def walls(pairs: Iterable[Pair] = (ASSUMED, WEAKER)) -> list[tuple[Pair, str]]:
    """(pair of strengths, pre-compression) of each wall."""
    return list(product(pairs, SCENES))


def name_of(pair: Pair) -> str:
    """A pair of strengths in words."""
    return f"fT {pair[0]:g} / {pair[1]:g} MPa"


def label(pair: Pair, sigma: str, more: str = "") -> str:
    """The name of a run."""
    return f"{name_of(pair)}, {sigma}" + (f", {more}" if more else "")
