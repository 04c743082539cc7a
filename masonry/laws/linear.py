"""Linear softening, eqs (12) and (13): G_I and G_II are the whole triangle, the elastic part included."""

from typing import NamedTuple

from masonry.jit.extending import register_jitable
from masonry.laws.snap_back import Refusal, lost_in_shear, refuse_in_shear
from masonry.simd import filled, maximum, where


class Linear(NamedTuple):
    """Fracture energies in N/m; `G_II_slope` (m) times the compressive stress is added to G_II."""

    G_I: float
    G_II: float
    G_II_slope: float | None = None


PARAMETERS = {
    "G_I": "fracture_energy_mode_1",
    "G_II": "fracture_energy_mode_2",
    "G_II_slope": "fracture_energy_mode_2_slope",
}

WHY_IN_SHEAR = "the curve would snap back below (peak - residual shear strength)^2 / (2 shear stiffness)"


def refuse(parameters, joint, compressions):
    """Snap-back, G_I <= fT^2/(2 kn) or ul <= us0: a Refusal or None."""
    bound = joint.tensile_strength**2 / (2.0 * joint.normal_stiffness)
    if joint.tensile_strength > 0.0 and bound >= parameters.G_I:
        why = "the curve would snap back below tensile strength^2 / (2 normal stiffness)"
        return Refusal("fracture_energy_mode_1", bound, "N/m", why)
    return refuse_in_shear(parameters, joint, compressions)


def least_mode_2_energy(parameters, joint, compression, intact):
    """That ul > us0 takes more than the elastic triangle, (peak - residual)^2/(2 ks), by either softening variable.

    The line falls alike at any share that is left.
    """
    return lost_in_shear(joint, compression) ** 2 / (2.0 * joint.shear_stiffness)


def tension_intact(parameters, joint, opening):
    """Eq. (12): fT (uf - un)/(uf - un0) over fT, with uf = 2 G_I/fT."""
    fT = joint.tensile_strength
    un0 = fT / joint.normal_stiffness
    uf = 2.0 * parameters.G_I / fT
    return maximum((uf - opening) / (uf - un0), 0.0)


def tension_area(parameters, joint, opening, intact):
    """The triangle less what the envelope has still to give."""
    fT = joint.tensile_strength
    un0 = fT / joint.normal_stiffness
    uf = 2.0 * parameters.G_I / fT
    return parameters.G_I - 0.5 * fT * intact * intact * (uf - un0)


def shear_intact(parameters, joint, intact, slip, peak, residual, compression):
    """Eq. (13): straight from peak at us0 to residual at ul = 2 G_II/(peak - residual) + residual/ks.

    Over the plastic slip, which has no elastic part, the same triangle ends at 2 G_II/(peak - residual).
    """
    width = 2.0 * mode_2_energy(parameters.G_II, parameters.G_II_slope, compression) / (peak - residual)
    if joint.plastic_softening is None:
        width -= (peak - residual) / joint.shear_stiffness
    return where(width * intact <= slip, 0.0, intact - slip / width)


@register_jitable
def mode_2_energy(G_II, slope, compression):
    """G_II (Table 1) grows with the compressive stress where a slope is given."""
    if slope is None:
        return filled(G_II, compression)
    return G_II + slope * compression
