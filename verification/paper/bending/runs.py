"""Which walls are bent: the strengths that Table 5 has lost, in steps of half the assumed ones, and what is varied."""

from itertools import product

GAUGE = "mid-span deflection"
SCENES = {"0 MPa": "bending-0", "0.25 MPa": "bending-025"}
"""Pre-compression -> packaged scene."""
ASSUMED = (0.5, 1.5)
"""Tensile strength of interfaces and of units, MPa."""
PATTERNED = (0.25, 2.25)
"""The pair within 50 % of it with which both patterns of the paper come out."""
SHARES = (0.5, 1.0, 1.5)
STRENGTHS = tuple((a * ASSUMED[0], b * ASSUMED[1]) for a, b in product(SHARES, SHARES))
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


def name_of(pair: Pair) -> str:
    """A pair of strengths in words."""
    return f"fT {pair[0]:g} / {pair[1]:g} MPa"


def label(pair: Pair, sigma: str, more: str = "") -> str:
    """The name of a run."""
    return f"{name_of(pair)}, {sigma}" + (f", {more}" if more else "")
