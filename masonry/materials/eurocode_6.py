"""Numbers of EN 1996-1-1:2005 (Eurocode 6): the recommended ones, in whose place a national annex may put others.

All strengths are in Pa and characteristic. None stands where the tables have no value.
"""

from bisect import bisect_right
from typing import NamedTuple

CODE = "EN 1996-1-1:2005"
UNITS = ("clay", "calcium-silicate", "concrete", "aac", "manufactured-stone", "natural-stone")
"""What units are made of; concrete with aggregates, aac is autoclaved aerated concrete."""
MPA = 1e6
FRICTION = 0.4
"""Of eq. (3.5), f_vk = f_vk0 + 0.4 sigma_d."""
LIMIT_OF_SHEAR = 0.065
"""f_vk is at most this share of f_b where head joints are filled, 3.6.2 (3)."""
K_E = 1000.0
"""E = K_E f_k, recommended in 3.7.2 (2)."""
SHEAR_SHARE = 0.4
"""G = 0.4 E, 3.7.3."""
_K = {
    "clay": ((0.55, 0.45, 0.35, 0.35), (0.75, 0.70, 0.50, 0.35)),
    "calcium-silicate": ((0.55, 0.45), (0.80, 0.65)),
    "concrete": ((0.55, 0.45, 0.40, 0.35), (0.80, 0.65, 0.50)),
    "aac": ((0.55,), (0.80,)),
    "manufactured-stone": ((0.45,), ()),
    "natural-stone": ((0.45,), ()),
}
"""Table 3.3 by group 1 to 4: in general purpose mortar, in thin layer mortar."""
_SHEAR = {
    "clay": (0.10, 0.20, 0.30, 0.30),
    "calcium-silicate": (0.10, 0.15, 0.20, 0.40),
    **dict.fromkeys(UNITS[2:], (0.10, 0.15, 0.20, 0.30)),
}
"""f_vk0 of table 3.4 in MPa: M1 to M2, M2.5 to M9, M10 to M20, thin layer mortar."""
_BENDING = {
    "clay": (0.10, 0.10, 0.15),
    "calcium-silicate": (0.05, 0.10, 0.20),
    "concrete": (0.05, 0.10, 0.20),
    "aac": (0.05, 0.10, 0.15),
    "manufactured-stone": (0.05, 0.10, None),
    "natural-stone": (0.05, 0.10, 0.15),
}
"""f_xk1 of 3.6.3 in MPa: f_m below 5, f_m of 5 or more, thin layer mortar."""


class CodeStrength(NamedTuple):
    """A characteristic strength in Pa, and where it is from."""

    value: float
    source: str


def compressive_strength(unit: str, group: int, f_b: float, f_m: float | None) -> CodeStrength | None:
    """f_k of masonry by 3.6.1.2; f_b and f_m in Pa, f_m is None for thin layer mortar."""
    by_group = _K[unit][f_m is None]
    if group > len(by_group):
        return None
    factor, strength = by_group[group - 1], f_b / MPA
    if f_m is None:
        strength, power = min(strength, 50.0), 0.7 if unit == "clay" and group in (2, 3) else 0.85
        formula = f"f_k = {factor} f_b^{power}, f_b = {strength:.4g} MPa"
        return CodeStrength(factor * strength**power * MPA, f"{CODE}, 3.6.1.2: {formula}")
    strength = min(strength, 75.0)
    mortar = min(f_m / MPA, 20.0, 2.0 * strength)
    formula = f"f_k = {factor} f_b^0.7 f_m^0.3, f_b = {strength:.4g} MPa, f_m = {mortar:.4g} MPa"
    return CodeStrength(factor * strength**0.7 * mortar**0.3 * MPA, f"{CODE}, 3.6.1.2 and table 3.3: {formula}")


def shear_strength(unit: str, f_m: float | None) -> CodeStrength | None:
    """f_vk0, the initial shear strength, by table 3.4; f_m in Pa, None for thin layer mortar."""
    row = 3 if f_m is None else bisect_right((1.0, 2.5, 10.0), f_m / MPA * (1.0 + 1e-12)) - 1
    if row < 0:
        return None
    mortar = "thin layer mortar" if f_m is None else ("M1 to M2", "M2.5 to M9", "M10 to M20")[row]
    value = _SHEAR[unit][row]
    return CodeStrength(value * MPA, f"{CODE}, table 3.4, {unit}, {mortar}: f_vk0 = {value:.2f} MPa")


def bending_strength(unit: str, f_m: float | None) -> CodeStrength | None:
    """f_xk1, the flexural strength across bed joints, by the tables of 3.6.3; f_m in Pa, None for thin layer mortar."""
    value = _BENDING[unit][2 if f_m is None else int(f_m >= 5.0 * MPA * (1.0 - 1e-12))]
    if value is None:
        return None
    mortar = "thin layer mortar" if f_m is None else f"f_m {'below' if f_m < 5.0 * MPA else 'of at least'} 5 MPa"
    return CodeStrength(value * MPA, f"{CODE}, 3.6.3, {unit}, {mortar}: f_xk1 = {value:.2f} MPa")
