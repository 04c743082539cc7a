"""Polynomial softening, eqs (14) and (15); lambda of eq. (15) as mended (see the errata): 1 at the peak, falling."""

from typing import NamedTuple

from masonry.laws.linear import mode_2_energy
from masonry.laws.snap_back import Refusal, lost_in_shear, refuse_in_shear


class Polynomial(NamedTuple):
    """Fracture energies in N/m and exponents; the post-peak area in tension is 2 G_I/(alpha - 1)."""

    G_I: float
    G_II: float
    alpha: float
    beta: float
    G_II_slope: float | None = None


PARAMETERS = {
    "G_I": "fracture_energy_mode_1",
    "G_II": "fracture_energy_mode_2",
    "alpha": "exponent_tension",
    "beta": "exponent_shear",
    "G_II_slope": "fracture_energy_mode_2_slope",
}

WHY_IN_SHEAR = (
    "over plastic slip the curve would snap back below exponent_shear * peak * (peak - residual shear strength) / "
    '(2 shear stiffness) (with softening_variable = "displacement" it cannot)'
)


def refuse(parameters, joint, compressions):
    """Exponents <= 1 leave an infinite energy; snap-back over plastic slip: a Refusal or None."""
    for key, value in (("exponent_tension", parameters.alpha), ("exponent_shear", parameters.beta)):
        if value <= 1.0:
            return Refusal(key, 1.0, "", "at 1 and below the area under the curve is infinite")
    return refuse_in_shear(parameters, joint, compressions)


def least_mode_2_energy(parameters, joint, compression, intact):
    """Over plastic slip the slope, (peak - residual) intact^(1 + 1/beta) beta/w with w = 2 G_II/peak, is below ks."""
    if joint.plastic_softening is None:
        return None
    peak = joint.cohesion + compression * joint.tan_friction
    steepest = parameters.beta * peak * lost_in_shear(joint, compression) / (2.0 * joint.shear_stiffness)
    return steepest * intact ** (1.0 + 1.0 / parameters.beta)


def tension_intact(parameters, joint, opening):
    """Eq. (14): (w/(w + un - un0))^alpha, w = 2 G_I/fT."""
    fT = joint.tensile_strength
    w = 2.0 * parameters.G_I / fT
    return (w / (w + opening - fT / joint.normal_stiffness)) ** parameters.alpha


def tension_area(parameters, joint, opening, intact):
    """Elastic triangle and the integral of eq. (14)."""
    fT = joint.tensile_strength
    un0 = fT / joint.normal_stiffness
    w = 2.0 * parameters.G_I / fT
    post_peak = fT * w / (parameters.alpha - 1.0) * (1.0 - intact * (w + opening - un0) / w)
    return 0.5 * fT * un0 + post_peak


def shear_intact(parameters, joint, intact, slip, peak, residual, compression):
    """Eq. (15), mended: lambda = (w/(w + us - us0))^beta, w = 2 G_II/tau_max; lambda^(-1/beta) = 1 + (us - us0)/w."""
    w = 2.0 * mode_2_energy(parameters.G_II, parameters.G_II_slope, compression) / peak
    return (intact ** (-1.0 / parameters.beta) + slip / w) ** -parameters.beta
