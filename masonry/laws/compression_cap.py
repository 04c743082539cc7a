"""Crushing: the cap of Lourenco and Rots (J. Eng. Mech. 123(7), 1997), or a cut-off, and how a contact returns to it.

The cap is sigma^2 + Css tau^2 = (strength left)^2, in compression; a cut-off is the same with Css = 0. Its flow is
associated: plastic closing, and with Css slip. What is left of the strength depends on the length of that plastic path.
A contact that closed for good by `closing` presses by kn (opening + closing), so it unloads with its full stiffness,
and its law sees faces that have come nearer. Tension and cohesion do not know of it.

Cap and Coulomb line are returned to at once: for a share z of the elastic normal stress that is left, the shear stress
is the lesser of what the flow of the cap leaves and what the line bears at z sigma; z is such that the point lies on
the cap. That is the corner of both where both act. What the law softens in this step is seen by the cap in the next.
"""

from math import exp, sqrt
from typing import Any, NamedTuple

from masonry.jit.extending import overload, register_jitable
from masonry.laws.cone import strength
from masonry.laws.snap_back import Refusal
from masonry.laws.state import JointProperties
from masonry.simd import any_lane, eight_rows, filled, maximum, minimum, or_zero, where
from masonry.simd.arithmetic import Lanes

INITIAL, MIDDLE, RESIDUAL = 1.0 / 3.0, 1.0 / 2.0, 1.0 / 10.0
"""Shares of the compressive strength at which the cap begins to yield, softens fastest, and ends."""
SOFTENING = 1.0 - RESIDUAL - (1.0 - MIDDLE) / 3.0 + (MIDDLE - RESIDUAL) ** 2 / (2.0 * (1.0 - MIDDLE))
"""Area of the softening above the residual, over strength and the path from the peak to the middle."""
TAIL = 2.0 * (1.0 - MIDDLE) / (MIDDLE - RESIDUAL)
"""Rate of the exponential end, which goes on with the slope of the parabola before it."""
ROUNDS, NEAR, SAME, LEAST = 60, 1e-10, 1e-14, 1e-9
"""Looks for z; how near to the cap, over the strength; how near two z are the same; the least z."""


class Crush(NamedTuple):
    """What crushing makes of a step.

    opening, tau        m, Pa: what the law sees, the plastic closing included; elastic shear stress that is left
    closing, hardening  m, so far
    work                J/m2 of this step
    """

    opening: Any
    tau: Any
    closing: Any
    hardening: Any
    work: Any


@register_jitable
def strength_left(joint, hardening):
    """Compressive strength (Pa, above 0) after a plastic path of `hardening` (m)."""
    share = share_left(joint.cap_shear_factor, joint.crushing_energy, joint, hardening)
    return joint.compressive_strength * share


@register_jitable
def share_left(cap_shear_factor, crushing_energy, joint, hardening):
    """Over the compressive strength: of the cap, or of the cut-off, which falls along a line or not at all."""
    if cap_shear_factor is not None:
        return cap_left(joint, hardening)
    if crushing_energy is None:
        return filled(1.0, hardening)
    return maximum(1.0 - hardening * (joint.compressive_strength / (2.0 * joint.crushing_energy)), 0.0)


@register_jitable
def cap_left(joint, hardening):
    """A quarter of an ellipse up to the peak, a parabola down to the middle, and an exponential end."""
    rise = minimum(hardening * (1.0 / joint.closing_at_peak), 1.0)
    share = INITIAL + (1.0 - INITIAL) * sqrt(rise * (2.0 - rise))
    per_path = SOFTENING * joint.compressive_strength / joint.crushing_energy
    beyond = maximum(hardening - joint.closing_at_peak, 0.0) * per_path
    if not any_lane(beyond > 0.0):
        return share
    fall = minimum(beyond, 1.0)
    tail = RESIDUAL + (MIDDLE - RESIDUAL) * exp(-TAIL * maximum(beyond - 1.0, 0.0))
    return where(beyond > 0.0, where(beyond < 1.0, 1.0 - (1.0 - MIDDLE) * fall * fall, tail), share)


def refuse_crushing(joint: JointProperties) -> Refusal | None:
    """Snap-back: the softening is steeper than the springs. A Refusal, or None."""
    if joint.compressive_strength is None or joint.crushing_energy is None:
        return None
    if joint.cap_shear_factor is None:
        least = joint.compressive_strength**2 / (2.0 * joint.normal_stiffness)
        why = "the curve would snap back below compressive strength^2 / (2 normal stiffness)"
    else:
        stiffness = min(
            joint.normal_stiffness, joint.shear_stiffness if joint.cap_shear_factor else joint.normal_stiffness
        )
        least = SOFTENING * joint.compressive_strength**2 / stiffness
        why = f"the cap would snap back below {SOFTENING:.4g} compressive strength^2 / (normal or shear stiffness)"
    if joint.crushing_energy > least:
        return None
    return Refusal("fracture_energy_compression", least, "N/m", why)


@register_jitable
def crushed_to(joint, history, hardening, e, trial, tau, z):
    """What a share z of the elastic normal stress `trial` (Pa) leaves: shear stress (Pa), plastic closing and slip of
    the cap (m) in this step, and by how much (Pa) the point lies outside the cap."""
    flexibility, factor = 1.0 / joint.normal_stiffness, or_zero(joint.cap_shear_factor, e)
    sigma, rest = z * trial, 1.0 - z
    shear_over_normal = factor * (joint.shear_stiffness * flexibility)
    left = minimum(tau * z / (z + rest * shear_over_normal), strength(joint, history, e, sigma))
    closed, slid = -rest * trial * flexibility, rest * left / z * (factor * flexibility)
    bears = strength_left(joint, hardening + sqrt(closed * closed + slid * slid))
    return left, closed, slid, sqrt(sigma * sigma + factor * left * left) - bears


@register_jitable
def return_to_cap(joint, history, closing, hardening, opening, sigma, tau, before):
    """A Crush, of the opening (m) with the closing so far, and the elastic normal and shear stress (Pa).

    before  (normal, shear) stress (Pa) that acted until now
    """
    e, trial = opening - or_zero(history.dilation, opening), minimum(sigma, 0.0)
    factor, near = or_zero(joint.cap_shear_factor, e), NEAR * filled(joint.compressive_strength, e)
    left, bears = minimum(tau, strength(joint, history, e, trial)), strength_left(joint, hardening)
    outside = sqrt(trial * trial + factor * left * left) - bears
    crushes = outside > near
    if not any_lane(crushes):
        return Crush(opening, tau, closing, hardening, filled(0.0, opening))
    z = filled(1.0, e)
    last, last_outside, low, high = z, outside, filled(LEAST, e), z
    closed = slid = filled(0.0, e)
    z = where(crushes, maximum(bears / (bears + outside), LEAST), z)
    for _ in range(ROUNDS):
        left, closed, slid, outside = crushed_to(joint, history, hardening, e, trial, tau, z)
        searched = crushes & (abs(outside) > near) & (high - low > SAME)
        if not any_lane(searched):
            break
        high, low = where(outside > 0.0, z, high), where(outside > 0.0, low, z)
        rise = outside - last_outside
        further = z - outside * (z - last) / where(rise == 0.0, 1.0, rise)
        last, last_outside = z, outside
        further = where((further > low) & (further < high), further, 0.5 * (low + high))
        z = where(searched, further, z)
    closed, slid = where(crushes, closed, 0.0), where(crushes, slid, 0.0)
    was, sheared = before
    work = 0.5 * (closed * (maximum(-was, 0.0) - z * trial) + slid * (sheared + left))
    path = sqrt(closed * closed + slid * slid)
    return Crush(opening + closed, tau - joint.shear_stiffness * slid, closing + closed, hardening + path, work)


@register_jitable
def is_within(joint, hardening, sigma, tau_squared):
    """Whether a normal stress (Pa) and a shear stress^2 (Pa2) lie within the cap."""
    bears, pressed = strength_left(joint, hardening), minimum(sigma, 0.0)
    return pressed * pressed + or_zero(joint.cap_shear_factor, sigma) * tau_squared <= bears * bears


def acts_on(c, like, force, n, area):
    """(normal, shear) stress (Pa) on planes of normal n, by the forces (C, 3) that act at c and those after it."""
    raise NotImplementedError("only compiled code asks")


@overload(acts_on)
def _acts_on(c, like, force, n, area):
    rows = eight_rows if isinstance(like, Lanes) else register_jitable(lambda c: c)

    def stresses(c, like, force, n, area):
        here = rows(c)
        x, y, z = force[here, 0] / area, force[here, 1] / area, force[here, 2] / area
        sigma = x * n[0] + y * n[1] + z * n[2]
        return sigma, sqrt(maximum(x * x + y * y + z * z - sigma * sigma, 0.0))

    return stresses
