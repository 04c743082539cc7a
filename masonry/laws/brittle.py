"""Brittle contact, eqs (7) and (8): tension cut-off and Coulomb line; past the peak only the residual is left."""

from typing import NamedTuple


class Brittle(NamedTuple):
    """Strength is lost at once. (The field keeps the tuple from being empty.)"""

    residual: float = 0.0


PARAMETERS: dict[str, str] = {}


def tension_intact(parameters, joint, opening):
    """Nothing is left beyond the elastic limit, eq. (7)."""
    return parameters.residual


def tension_area(parameters, joint, opening, intact):
    """Only the elastic triangle."""
    return 0.5 * joint.tensile_strength**2 / joint.normal_stiffness


def shear_intact(parameters, joint, intact, slip, peak, residual, compression):
    """Only the residual is left beyond the peak, eq. (8)."""
    return parameters.residual
