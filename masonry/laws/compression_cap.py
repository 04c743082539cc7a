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

from numba import types

from masonry.jit.extending import overload, register_jitable
from masonry.laws.cone import strength
from masonry.laws.snap_back import Refusal
from masonry.laws.state import JointProperties
from masonry.simd import any_lane, eight_rows, filled, maximum, minimum, or_zero, take, where
from masonry.simd.arithmetic import Lanes

INITIAL, MIDDLE, RESIDUAL = 1.0 / 3.0, 1.0 / 2.0, 1.0 / 10.0
"""Shares of the compressive strength at which the cap begins to yield, softens fastest, and ends."""
SOFTENING = 1.0 - RESIDUAL - (1.0 - MIDDLE) / 3.0 + (MIDDLE - RESIDUAL) ** 2 / (2.0 * (1.0 - MIDDLE))
"""Area of the softening above the residual, over strength and the path from the peak to the middle."""
TAIL = 2.0 * (1.0 - MIDDLE) / (MIDDLE - RESIDUAL)
"""Rate of the exponential end, which goes on with the slope of the parabola before it."""
ROUNDS, NEAR, LEAST = 60, 1e-12, 1e-9
"""Looks for z; how near to the cap, over the strength; the least z."""


class Crush(NamedTuple):
    """What crushing makes of a step.

    opening, tau        m, Pa: what the law sees, the plastic closing included; elastic shear stress that is left
    closing, hardening  m, so far; None where crushing is not modelled, and so is the next
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
    rise = minimum(hardening / joint.closing_at_peak, 1.0)
    share = INITIAL + (1.0 - INITIAL) * sqrt(rise * (2.0 - rise))
    beyond = maximum(hardening - joint.closing_at_peak, 0.0) * (SOFTENING * joint.compressive_strength)
    beyond = beyond / joint.crushing_energy
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
def crushed_to(joint, history, hardening, e, tau, z):
    """What a share z of the elastic normal stress leaves: shear stress (Pa), plastic closing and slip of the cap (m) in
    this step, the strength left, and by how much (Pa) the point lies outside the cap."""
    kn, factor = joint.normal_stiffness, or_zero(joint.cap_shear_factor, e)
    trial = kn * minimum(e, 0.0)
    sigma, rest = z * trial, 1.0 - z
    left = minimum(tau * z / (z + rest * (factor * joint.shear_stiffness / kn)), strength(joint, history, e, sigma))
    closed, slid = -rest * trial / kn, rest * factor * left / (z * kn)
    bears = strength_left(joint, hardening + sqrt(closed * closed + slid * slid))
    return left, closed, slid, bears, sqrt(sigma * sigma + factor * left * left) - bears


@register_jitable
def return_to_cap(joint, history, closing, hardening, opening, tau, before):
    """A Crush, of the opening (m) with the closing so far, and the elastic shear stress (Pa).

    before  (normal, shear) stress (Pa) that acted until now
    """
    e = opening - or_zero(history.dilation, opening)
    z = filled(1.0, e)
    left, closed, slid, bears, outside = crushed_to(joint, history, hardening, e, tau, z)
    near = NEAR * joint.compressive_strength
    crushes = outside > near
    if not any_lane(crushes):
        return Crush(opening, tau, closing, hardening, filled(0.0, e))
    last, last_outside, low, high = z, outside, filled(LEAST, e), z
    z = where(crushes, maximum(bears / (bears + outside), LEAST), z)
    for _ in range(ROUNDS):
        left, closed, slid, bears, outside = crushed_to(joint, history, hardening, e, tau, z)
        open_still = crushes & (abs(outside) > near) & (high - low > NEAR)
        if not any_lane(open_still):
            break
        high, low = where(outside > 0.0, z, high), where(outside > 0.0, low, z)
        rise = outside - last_outside
        further = z - outside * (z - last) / where(rise == 0.0, 1.0, rise)
        last, last_outside = z, outside
        further = where((further > low) & (further < high), further, 0.5 * (low + high))
        z = where(open_still, further, z)
    closed, slid = where(crushes, closed, 0.0), where(crushes, slid, 0.0)
    sigma = z * joint.normal_stiffness * minimum(e, 0.0)
    was, sheared = before
    work = 0.5 * (closed * (maximum(-was, 0.0) - sigma) + slid * (sheared + left))
    path = sqrt(closed * closed + slid * slid)
    return Crush(opening + closed, tau - joint.shear_stiffness * slid, closing + closed, hardening + path, work)


def closed_by(closing, opening):
    """The opening (m) that the law sees: with the plastic closing, where there is any."""
    return opening if closing is None else opening + closing


@overload(closed_by)
def _closed_by(closing, opening):
    if isinstance(closing, types.NoneType):
        return lambda closing, opening: opening
    return lambda closing, opening: opening + closing


def within_cap(hardening, joint, sigma, tau_squared, unchanged):
    """`unchanged`, where a normal stress (Pa) and a shear stress^2 (Pa2) lie within the cap besides."""
    return unchanged if hardening is None else unchanged & _is_within(joint, hardening, sigma, tau_squared)


@overload(within_cap)
def _within_cap(hardening, joint, sigma, tau_squared, unchanged):
    if isinstance(hardening, types.NoneType):
        return lambda hardening, joint, sigma, tau_squared, unchanged: unchanged
    return lambda hardening, joint, sigma, tau_squared, unchanged: (
        unchanged & _is_within(joint, hardening, sigma, tau_squared)
    )


@register_jitable
def _is_within(joint, hardening, sigma, tau_squared):
    bears, pressed = strength_left(joint, hardening), minimum(sigma, 0.0)
    return pressed * pressed + or_zero(joint.cap_shear_factor, sigma) * tau_squared <= bears * bears


def crush(joint, history, closing, hardening, opening, tau, before):
    """`return_to_cap` where crushing is modelled; else the step as it is."""
    if closing is None:
        return Crush(opening, tau, None, None, None)
    return return_to_cap(joint, history, closing, hardening, opening, tau, before)


@overload(crush)
def _crush(joint, history, closing, hardening, opening, tau, before):
    if isinstance(closing, types.NoneType):
        return lambda joint, history, closing, hardening, opening, tau, before: Crush(opening, tau, None, None, None)
    return return_to_cap


def left_by_cap(squeezed, fraction, tau):
    """The fraction of the whole elastic shear stress tau (Pa), of that of what the cap leaves."""
    return fraction if squeezed.work is None else where(tau > 0.0, fraction * squeezed.tau / tau, fraction)


@overload(left_by_cap)
def _left_by_cap(squeezed, fraction, tau):
    if isinstance(squeezed.types[4], types.NoneType):
        return lambda squeezed, fraction, tau: fraction
    return lambda squeezed, fraction, tau: where(tau > 0.0, fraction * squeezed.tau / tau, fraction)


def bore(closing, c, like, force, n, area):
    """(normal, shear) stress (Pa) by the forces (C, 3) that act, at c and the contacts after it; None where nothing
    crushes."""
    raise NotImplementedError("only compiled code asks")


@overload(bore)
def _bore(closing, c, like, force, n, area):
    if isinstance(closing, types.NoneType):
        return lambda closing, c, like, force, n, area: None
    rows = eight_rows if isinstance(like, Lanes) else register_jitable(lambda c: c)

    def stresses(closing, c, like, force, n, area):
        here, size = rows(c), take(area, c, like)
        x, y, z = force[here, 0] / size, force[here, 1] / size, force[here, 2] / size
        sigma = x * n[0] + y * n[1] + z * n[2]
        return sigma, sqrt(maximum(x * x + y * y + z * z - sigma * sigma, 0.0))

    return stresses
