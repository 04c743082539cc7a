"""Dry contact: no tension, and Coulomb friction without cohesion, eqs (5), (6) and (8) with fT = c = 0.

Nothing softens, so nothing of the softening mechanism is compiled: sigma = kn un where faces touch, else 0, and
|tau| <= -sigma tan(phi). A contact has lost all "strength in tension" once it has opened, and all "in shear" once it
has slid: this is what pictures show of it.
"""

from typing import NamedTuple

from masonry.laws.state import ContactHistory, StressUpdate
from masonry.simd import any_lane, filled, maximum, minimum, where


class Friction(NamedTuple):
    """No strength, no energies. (The field keeps the tuple from being empty.)"""

    residual: float = 0.0


STRENGTHS = ("tan_friction",)
PARAMETERS: dict[str, str] = {}


def tension_intact(parameters, joint, opening):
    """There is no strength."""
    return parameters.residual


def tension_area(parameters, joint, opening, intact):
    """It takes no work to open."""
    return parameters.residual


def shear_intact(parameters, joint, intact, slip, peak, residual, compression):
    """Nothing beyond friction."""
    return parameters.residual


def elastic_trial(parameters, joint, history, opening, tau_squared):
    """Eq. (5) in compression; the answer stands where the contact neither slides nor opens further."""
    sigma = joint.normal_stiffness * minimum(opening, 0.0)
    shear_strength = joint.tan_friction * sigma
    return sigma, (tau_squared <= shear_strength * shear_strength) & (opening <= history.opening_max)


def return_mapping(parameters, joint, history, opening, total, tau):
    """Return to the Coulomb line, eq. (8); what lies beyond it becomes slip, and its work friction."""
    sigma = joint.normal_stiffness * minimum(opening, 0.0)
    yielded = minimum(tau, -joint.tan_friction * sigma)
    slides, opens = tau > yielded, opening > history.opening_max
    now = ContactHistory(
        maximum(opening, history.opening_max),
        where(opens, 0.0, history.intact_n),
        where(slides, 0.0, history.intact_s),
        *(history.secant, history.dilation, history.permanent_opening, history.plastic_slip),
    )
    nothing = filled(0.0, tau)
    if not any_lane(slides):
        return StressUpdate(sigma, filled(1.0, tau), now, nothing, nothing, nothing)
    friction = yielded * (tau - yielded) / joint.shear_stiffness
    return StressUpdate(sigma, where(slides, yielded / tau, 1.0), now, nothing, nothing, friction)


def stored_energy(parameters, joint, history, opening, tau_squared):
    """Energy stored in the springs."""
    normal = joint.normal_stiffness * minimum(opening, 0.0)
    return 0.5 * (normal * opening + tau_squared / joint.shear_stiffness)
