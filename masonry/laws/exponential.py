"""Exponential softening, eqs (16) and (17); c of the exponent of eq. (17) read as c0 (see the errata)."""

from math import exp
from typing import NamedTuple

from masonry.laws.linear import mode_2_energy
from masonry.laws.snap_back import lost_in_shear, refuse_in_shear


class Exponential(NamedTuple):
    """Fracture energies in N/m, post-peak only."""

    G_I: float
    G_II: float
    G_II_slope: float | None = None


PARAMETERS = {
    "G_I": "fracture_energy_mode_1",
    "G_II": "fracture_energy_mode_2",
    "G_II_slope": "fracture_energy_mode_2_slope",
}

WHY_IN_SHEAR = (
    "over plastic slip the curve would snap back below cohesion * (peak - residual shear strength) / shear stiffness "
    '(with softening_variable = "displacement" it cannot)'
)


def refuse(parameters, joint, compressions):
    """Snap-back over plastic slip: a Refusal or None."""
    return refuse_in_shear(parameters, joint, compressions)


def least_mode_2_energy(parameters, joint, compression, intact):
    """Over plastic slip the slope, (peak - residual) intact c0/G_II, must stay below ks."""
    if joint.plastic_softening is None:
        return None
    return intact * joint.cohesion * lost_in_shear(joint, compression) / joint.shear_stiffness


def tension_intact(parameters, joint, opening):
    """Eq. (16): exp(-(fT/G_I)(un - un0))."""
    fT = joint.tensile_strength
    return exp(-fT / parameters.G_I * (opening - fT / joint.normal_stiffness))


def tension_area(parameters, joint, opening, intact):
    """Elastic triangle and the integral of eq. (16)."""
    return 0.5 * joint.tensile_strength**2 / joint.normal_stiffness + parameters.G_I * (1.0 - intact)


def shear_intact(parameters, joint, intact, slip, peak, residual, compression):
    """Eq. (17), mended: exp(-(c0/G_II)(us - us0)); tan(phi) follows the cohesion in proportion."""
    return intact * exp(-joint.cohesion / mode_2_energy(parameters.G_II, parameters.G_II_slope, compression) * slip)
