"""Brittle contact, eqs (7) and (8): tension cut-off and Coulomb line; past the peak only the residual is left."""

from typing import NamedTuple


class Brittle(NamedTuple):
    """Strength is lost at once. (The field keeps the tuple from being empty.)"""

    left: float = 0.0


PARAMETERS: dict[str, str] = {}


def tension_intact(shape, interface, opening):
    """Nothing is left beyond the elastic limit, eq. (7)."""
    return shape.left


def tension_area(shape, interface, opening, intact):
    """Only the elastic triangle."""
    return 0.5 * interface.tensile_strength**2 / interface.normal_stiffness


def shear_intact(shape, interface, intact, slip, peak, residual, compression):
    """Only the residual is left beyond the peak, eq. (8)."""
    return shape.left
