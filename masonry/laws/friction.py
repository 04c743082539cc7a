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

    left: float = 0.0


STRENGTHS = ("tan_friction",)
PARAMETERS: dict[str, str] = {}


def tension_intact(shape, interface, opening):
    """There is no strength."""
    return shape.left


def tension_area(shape, interface, opening, intact):
    """It takes no work to open."""
    return shape.left


def shear_intact(shape, interface, intact, slip, peak, residual, compression):
    """Nothing beyond friction."""
    return shape.left


def elastic_trial(shape, interface, memory, opening, tau_squared):
    """Eq. (5) in compression; the answer stands where the contact neither slides nor opens further."""
    sigma = interface.normal_stiffness * minimum(opening, 0.0)
    most = interface.tan_friction * sigma
    return sigma, (tau_squared <= most * most) & (opening <= memory.opening_max)


def return_mapping(shape, interface, memory, opening, total, tau):
    """Return to the Coulomb line, eq. (8); what lies beyond it becomes slip, and its work friction."""
    sigma = interface.normal_stiffness * minimum(opening, 0.0)
    yielded = minimum(tau, -interface.tan_friction * sigma)
    slides, opens = tau > yielded, opening > memory.opening_max
    now = ContactHistory(
        maximum(opening, memory.opening_max),
        where(opens, 0.0, memory.intact_n),
        where(slides, 0.0, memory.intact_s),
        *(memory.secant, memory.uplift, memory.gap, memory.run),
    )
    nothing = filled(0.0, tau)
    if not any_lane(slides):
        return StressUpdate(sigma, filled(1.0, tau), now, nothing, nothing, nothing)
    friction = yielded * (tau - yielded) / interface.shear_stiffness
    return StressUpdate(sigma, where(slides, yielded / tau, 1.0), now, nothing, nothing, friction)


def stored_energy(shape, interface, memory, opening, tau_squared):
    """What the springs hold."""
    normal = interface.normal_stiffness * minimum(opening, 0.0)
    return 0.5 * (normal * opening + tau_squared / interface.shear_stiffness)
