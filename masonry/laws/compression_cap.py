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
from masonry.simd import any_lane, eight_rows, filled, maximum, minimum, or_zero, unless, where
from masonry.simd.arithmetic import Lanes

INITIAL, MIDDLE, RESIDUAL = 1.0 / 3.0, 1.0 / 2.0, 1.0 / 10.0
"""Shares of the compressive strength at which the cap begins to yield, softens fastest, and ends."""
SOFTENING = 1.0 - RESIDUAL - (1.0 - MIDDLE) / 3.0 + (MIDDLE - RESIDUAL) ** 2 / (2.0 * (1.0 - MIDDLE))
"""Area of the softening above the residual, over strength and the path from the peak to the middle."""
TAIL = 2.0 * (1.0 - MIDDLE) / (MIDDLE - RESIDUAL)
"""Rate of the exponential end, which goes on with the slope of the parabola before it."""
ROUNDS, NEAR, SAME, LEAST, STEEPEST = 60, 1e-10, 1e-14, 1e-9, 1e-3
"""Looks for z; how near to the cap, over the strength; how near two z are the same; the least z; the share of the
strength by which a cap has risen where its slope is no longer taken as infinite."""


class Crush(NamedTuple):
    """Result of crushing in a step.

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
    fraction = share_left(joint.cap_shear_factor, joint.crushing_energy, joint, hardening)
    return joint.compressive_strength * fraction


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
    fraction, softens = filled(1.0, hardening), hardening > joint.closing_at_peak
    if any_lane(unless(hardening >= 0.0, softens)):
        rise = minimum(hardening * (1.0 / joint.closing_at_peak), 1.0)
        fraction = INITIAL + (1.0 - INITIAL) * sqrt(rise * (2.0 - rise))
    if not any_lane(softens):
        return fraction
    excess = (hardening - joint.closing_at_peak) * path_scale(joint)
    fall = minimum(excess, 1.0)
    fraction = where(softens, 1.0 - (1.0 - MIDDLE) * fall * fall, fraction)
    if not any_lane(excess > 1.0):
        return fraction
    return where(excess > 1.0, RESIDUAL + (MIDDLE - RESIDUAL) * exp(-TAIL * maximum(excess - 1.0, 0.0)), fraction)


@register_jitable
def path_scale(joint):
    """1/m: one over the plastic path from the peak of the cap to the middle of its softening."""
    return SOFTENING * joint.compressive_strength / joint.crushing_energy


@register_jitable
def slope(cap_shear_factor, crushing_energy, joint, hardening, bears):
    """Pa/m, of the strength over the plastic path, where `bears` (Pa) is left; a cap that yields first rises at most as
    it does where it has risen by STEEPEST."""
    if cap_shear_factor is not None:
        return cap_slope(joint, hardening, bears)
    if crushing_energy is None:
        return filled(0.0, hardening)
    return where(bears > 0.0, filled(-0.5 * joint.compressive_strength**2 / joint.crushing_energy, bears), 0.0)


@register_jitable
def cap_slope(joint, hardening, bears):
    """The same of a cap."""
    fraction, softens = bears * (1.0 / joint.compressive_strength), hardening > joint.closing_at_peak
    rise = filled(0.0, bears)
    if any_lane(unless(hardening >= 0.0, softens)):
        per_peak = 1.0 / joint.closing_at_peak
        rise = (1.0 - INITIAL) * (1.0 - INITIAL) * per_peak * (1.0 - hardening * per_peak)
        rise = rise / maximum(fraction - INITIAL, STEEPEST)
    excess = (hardening - joint.closing_at_peak) * path_scale(joint)
    fall = path_scale(joint) * where(excess < 1.0, 2.0 * (1.0 - MIDDLE) * excess, TAIL * (fraction - RESIDUAL))
    return joint.compressive_strength * where(softens, -fall, rise)


def refuse_crushing(joint: JointProperties) -> Refusal | None:
    """Snap-back: the softening is steeper than the springs. A Refusal, or None."""
    if joint.compressive_strength is None or joint.crushing_energy is None:
        return None
    if joint.cap_shear_factor is None:
        bound = joint.compressive_strength**2 / (2.0 * joint.normal_stiffness)
        why = "the curve would snap back below compressive strength^2 / (2 normal stiffness)"
    else:
        stiffness = min(
            joint.normal_stiffness, joint.shear_stiffness if joint.cap_shear_factor else joint.normal_stiffness
        )
        bound = SOFTENING * joint.compressive_strength**2 / stiffness
        why = f"the cap would snap back below {SOFTENING:.4g} compressive strength^2 / (normal or shear stiffness)"
    if joint.crushing_energy > bound:
        return None
    return Refusal("fracture_energy_compression", bound, "N/m", why)


@register_jitable
def length(cap_shear_factor, closed, slid):
    """m, of a plastic path that closes and slides; a cut-off does not slide."""
    if cap_shear_factor is None:
        return closed
    return sqrt(closed * closed + slid * slid)


@register_jitable
def outside(cap_shear_factor, pressed, tau_squared, bears):
    """By how much a compression (Pa) and a shear stress^2 (Pa2) lie outside: Pa2 of a cap, Pa of a cut-off."""
    if cap_shear_factor is None:
        return pressed - bears
    return pressed * pressed + cap_shear_factor * tau_squared - bears * bears


@register_jitable
def nearness(cap_shear_factor, joint, bears):
    """Tolerance of the surface, Pa2 or Pa as `outside`: a share of what a cap bears or a cut-off bore."""
    if cap_shear_factor is None:
        return filled(NEAR * joint.compressive_strength, bears)
    return 2.0 * NEAR * bears * bears


@register_jitable
def crushed_to(joint, history, e, trial, tau, z):
    """State at a share z of the elastic normal stress `trial` (Pa): shear stress (Pa), and plastic closing and slip of
    the cap (m) in this step."""
    flexibility, rest = 1.0 / joint.normal_stiffness, 1.0 - z
    shear, slid = flow(joint.cap_shear_factor, joint, flexibility, strength(joint, history, e, z * trial), tau, z, rest)
    return shear, -rest * trial * flexibility, slid


@register_jitable
def flow(cap_shear_factor, joint, flexibility, bears, tau, z, rest):
    """Shear stress (Pa) that is left, no more than the Coulomb line `bears`, and the slip (m) of the cap."""
    if cap_shear_factor is None:
        return minimum(tau, bears), filled(0.0, z)
    eased = z + rest * (cap_shear_factor * joint.shear_stiffness * flexibility)
    inverse = 1.0 / (z * eased)
    shear = minimum(tau * z * z * inverse, bears)
    return shear, rest * shear * eased * inverse * (cap_shear_factor * flexibility)


@register_jitable
def excess_of(joint, history, hardening, e, trial, tau, z):
    """By how much (as `outside`) the point that `crushed_to` finds lies outside the cap."""
    shear, closed, slid = crushed_to(joint, history, e, trial, tau, z)
    bears = strength_left(joint, hardening + length(joint.cap_shear_factor, closed, slid))
    return outside(joint.cap_shear_factor, -z * trial, shear * shear, bears)


@register_jitable
def share_per_excess(cap_shear_factor, joint, history, hardening, e, trial, tau, shear, bears):
    """By how much the share z falls for what lies outside (as `outside`), along the tangent at z = 1."""
    rise = slope(cap_shear_factor, joint.crushing_energy, joint, hardening, bears) * (1.0 / joint.normal_stiffness)
    if cap_shear_factor is None:
        return -1.0 / (trial * (1.0 + rise))
    per_share = tau * (cap_shear_factor * joint.shear_stiffness * (1.0 / joint.normal_stiffness))
    per_share = where(tau > shear, shear - strength(joint, history, e, 0.0 * trial), per_share)
    squared, sheared = trial * trial, cap_shear_factor * shear
    return 0.5 / (squared + sheared * per_share + bears * rise * sqrt(squared + sheared * sheared))


@register_jitable
def return_to_cap(joint, history, closing, hardening, bears, opening, sigma, tau, before):
    """A Crush, of the opening (m) with the closing so far, and the elastic normal and shear stress (Pa).

    bears   Pa, the strength left so far      before  (normal, shear) stress (Pa) that acted until now

    Newton's method begins with the tangent, and goes on with secants between bounds. A tangent that leaves `excess` of
    `last_excess` is off by their ratio: so a further step along it leaves excess^2 / last_excess, and is not looked at.
    """
    e, trial = opening - or_zero(history.dilation, opening), minimum(sigma, 0.0)
    shear, near = minimum(tau, strength(joint, history, e, trial)), nearness(joint.cap_shear_factor, joint, bears)
    excess = outside(joint.cap_shear_factor, -trial, shear * shear, bears)
    crushes = excess > near
    if not any_lane(crushes):
        return Crush(opening, tau, closing, hardening, filled(0.0, opening))
    last, high, low = filled(1.0, e), filled(1.0, e), filled(LEAST, e)
    per = share_per_excess(joint.cap_shear_factor, joint, history, hardening, e, trial, tau, shear, bears)
    z, searched = where(crushes, minimum(maximum(1.0 - excess * per, LEAST), 1.0), 1.0), crushes
    for _ in range(ROUNDS):
        last_excess = excess
        excess = excess_of(joint, history, hardening, e, trial, tau, z)
        searched = searched & (excess * excess > near * abs(last_excess)) & (high - low > SAME)
        if not any_lane(searched):
            break
        high, low = where(excess > 0.0, z, high), where(excess > 0.0, low, z)
        rise = excess - last_excess
        per = where(searched & (abs(rise) > 0.0), (z - last) / rise, per)
        last, further = z, z - excess * per
        z = where(searched, where((further > low) & (further < high), further, 0.5 * (low + high)), z)
    z = where(crushes, minimum(maximum(z - excess * per, LEAST), 1.0), 1.0)
    shear, closed, slid = crushed_to(joint, history, e, trial, tau, z)
    was, sheared = before
    work = 0.5 * (closed * (maximum(-was, 0.0) - z * trial) + slid * (sheared + shear))
    path = length(joint.cap_shear_factor, closed, slid)
    return Crush(opening + closed, tau - joint.shear_stiffness * slid, closing + closed, hardening + path, work)


@register_jitable
def is_within(joint, bears, sigma, tau_squared):
    """Whether a normal stress (Pa) and a shear stress^2 (Pa2) lie within the cap, of which `bears` (Pa) is left."""
    pressed = minimum(sigma, 0.0)
    return pressed * pressed + or_zero(joint.cap_shear_factor, sigma) * tau_squared <= bears * bears


def acts_on(c, like, force, n, area):
    """(normal, shear) stress (Pa) on planes of normal n, by the forces (C, 3) that act at c and those after it."""
    raise NotImplementedError("only compiled code asks")


@overload(acts_on)
def _acts_on(c, like, force, n, area):
    rows = eight_rows if isinstance(like, Lanes) else register_jitable(lambda c: c)

    def stresses(c, like, force, n, area):
        here = rows(c)
        per_area = 1.0 / area
        x, y, z = force[here, 0] * per_area, force[here, 1] * per_area, force[here, 2] * per_area
        sigma = x * n[0] + y * n[1] + z * n[2]
        return sigma, sqrt(maximum(x * x + y * y + z * z - sigma * sigma, 0.0))

    return stresses
