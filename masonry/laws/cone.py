"""Strength of a contact by its history, eq. (8), and rise of faces that slide, eqs (9) and (10), pressed or open.

A face is rough: it stands on slopes of tan(psi), so whatever slides rises, and what slid while it stood open is met
that much earlier on its way back. With tan(psi) = tan(phi) the flow is associated, and a surface without friction on
these slopes would answer alike. What nothing holds any more does not slide: it floats, and what counts is how far it is
from where it lost touch, not its path in between.
"""

from numba import types

from masonry.jit.extending import overload, register_jitable
from masonry.laws.state import ContactHistory, RisingUpdate, StressUpdate
from masonry.simd import any_lane, eight_rows, filled, maximum, minimum, take, unless, where
from masonry.simd.arithmetic import Lanes

SAME = 1e-9
"""Share by which a shear stress may stay below the strength and still be at it: where the slip stopped and the pressure
goes on changing both are the same number but for rounding, which must not decide."""


@register_jitable
def normal_stress(joint, history, e):
    """sigma(e): full kn in compression; in tension by secant (damage) or elastic (plastic opening) unloading."""
    return unload(history.permanent_opening, joint, history, e)


@register_jitable
def unload(permanent_opening, joint, history, e):
    """Elastic, or along the secant."""
    if permanent_opening is not None:
        return joint.normal_stiffness * (e - permanent_opening)
    return e * where(e > 0.0, history.secant, joint.normal_stiffness)


@register_jitable
def coulomb(joint, history, e, sigma):
    """Peak and residual shear strength at the present stress, eq. (8); never negative, never crossed.

    The residual cohesion acts between faces that touch: torn faces lose it as they open, and find it again on closing.
    """
    peak = maximum(joint.cohesion - sigma * joint.tan_friction, 0.0)
    c_res = residual_cohesion(joint, history, e)
    residual = maximum(c_res - sigma * joint.tan_residual_friction, 0.0)
    return maximum(peak, residual), residual


@register_jitable
def residual_cohesion(joint, history, e):
    """Residual cohesion (Pa) of faces that stand open by e."""
    c_res = filled(joint.residual_cohesion, e)
    if joint.residual_cohesion == 0.0:
        return c_res
    stands_open = (e > 0.0) & (history.intact_n < 1.0)
    if not any_lane(stands_open):
        return c_res
    lost = (1.0 - shared(joint.combined, history.intact_n)) * minimum(e / history.opening_max, 1.0)
    return where(stands_open, c_res * (1.0 - lost), c_res)


@register_jitable
def strength(joint, history, e, sigma):
    """Shear strength (Pa) that this history leaves at the present stress."""
    peak, residual = coulomb(joint, history, e, sigma)
    return left_of(joint, history, history.intact_s, peak, residual)


@register_jitable
def left_of(joint, history, whole, peak, residual):
    """Shear strength (Pa) where a share `whole` of it is left in shear."""
    return residual + whole * shared(joint.combined, history.intact_n) * (peak - residual)


@register_jitable
def shared(combined, intact):
    """The other mode's intact share where tension and cohesion are lost together, D = dt + ds - dt ds; else 1."""
    if combined is None:
        return filled(1.0, intact)
    return intact


@register_jitable
def pressed(joint, history, e, tau, whole, peak, residual):
    """Rise (m) by dilation of a contact that slides and keeps a share `whole`; peak and residual (Pa) under it."""
    rise = dilation_increment(joint.tan_dilation, joint, history, e, tau, whole, peak, residual)
    top, last = cone_after(joint.tan_dilation, joint, history, e - rise, peak, residual)
    return rise, top, last


@register_jitable
def dilation_increment(tan_dilation, joint, history, e, tau, whole, peak, residual):
    """Rise (m) by eqs (9) and (10) up to the cut-off.

    The elastic shear stress tau exceeds the strength, and the rise itself lifts that: both return at once. Faces that
    stand open, and that something ties, gain strength along a line until they touch, and then along the cone.
    """
    if tan_dilation is None:
        return filled(0.0, e)
    ks, tan_res, touch = joint.shear_stiffness, joint.tan_residual_friction, minimum(e, 0.0)
    to_touch = (e - touch) / tan_dilation
    closed = left_of(joint, history, whole, *coulomb(joint, history, touch, normal_stress(joint, history, touch)))
    slope = tan_res + whole * shared(joint.combined, history.intact_n) * (joint.tan_friction - tan_res)
    excess = tau - ks * to_touch - closed
    slipped = to_touch + maximum(excess, 0.0) / (ks + slope * joint.normal_stiffness * tan_dilation)
    now = left_of(joint, history, whole, peak, residual)
    before_touch = to_touch * maximum(tau - now, 0.0) / (ks * to_touch + closed - now)
    slipped = where((to_touch > 0.0) & (excess <= 0.0), before_touch, slipped)
    return tan_dilation * minimum(slipped, still_to_slip(history.permanent_opening, joint, history, e))


@register_jitable
def still_to_slip(permanent_opening, joint, history, e):
    """How far (m) a contact slides before its dilation ends; torn faces whose opening stays do not rise on it."""
    room = maximum(joint.dilation_cutoff - history.plastic_slip, 0.0)
    if permanent_opening is None:
        return room
    return where((e > 0.0) & (history.intact_n < 1.0), 0.0, room)


@register_jitable
def gap_of(permanent_opening, e):
    """How far (m) faces stand apart by an opening; where that stays, it is filled."""
    if permanent_opening is None:
        return maximum(e, 0.0)
    return filled(0.0, e)


@register_jitable
def cone_after(tan_dilation, joint, history, e, peak, residual):
    """Peak and residual shear strength (Pa) once dilation has pressed the faces; unchanged without it."""
    if tan_dilation is None:
        return peak, residual
    return coulomb(joint, history, e, normal_stress(joint, history, e))


def caught(tan_dilation, joint, history, e, tau, shear_strength):
    """Faces that stand open and that nothing holds: (history, opening, elastic shear stress, which of them float).

    Where they have come so far from where they lost touch that they meet, they rose for nothing until then, and what is
    left of tau is that of the slip beyond. Where not, they float: they bear nothing, and do not slip.
    """
    if tan_dilation is None:
        return history, e, tau, None
    return _caught(joint, history, e, tau, shear_strength)


@overload(caught)
def _caught_if_it_dilates(tan_dilation, joint, history, e, tau, shear_strength):
    if isinstance(tan_dilation, types.NoneType):
        return lambda tan_dilation, joint, history, e, tau, shear_strength: (history, e, tau, None)
    return lambda tan_dilation, joint, history, e, tau, shear_strength: _caught(joint, history, e, tau, shear_strength)


@register_jitable
def _caught(joint, history, e, tau, shear_strength):
    gap = gap_of(history.permanent_opening, e)
    loose = (gap > 0.0) & (shear_strength <= 0.0) & (filled(joint.residual_cohesion, e) <= 0.0)
    free = gap / joint.tan_dilation
    room = still_to_slip(history.permanent_opening, joint, history, e)
    meets = loose & (free < minimum(tau / joint.shear_stiffness, room))
    free = where(meets, free, 0.0)
    tau = where(loose, where(meets, maximum(tau - joint.shear_stiffness * free, 0.0), 0.0), tau)
    old = history
    met = ContactHistory(
        *(old.opening_max, old.intact_n, old.intact_s, old.secant, old.dilation + joint.tan_dilation * free),
        *(old.permanent_opening, old.plastic_slip + free),
    )
    return met, where(meets, e - gap, e), tau, unless(loose, meets)


def answer(floats, sigma, fraction, history, mode_1, mode_2, friction):
    """A StressUpdate, or a RisingUpdate of contacts that dilate."""
    if floats is None:
        return StressUpdate(sigma, fraction, history, mode_1, mode_2, friction)
    return RisingUpdate(sigma, fraction, history, mode_1, mode_2, friction, floats)


@overload(answer)
def _answer(floats, sigma, fraction, history, mode_1, mode_2, friction):
    if isinstance(floats, types.NoneType):
        return lambda floats, sigma, fraction, history, mode_1, mode_2, friction: StressUpdate(
            sigma, fraction, history, mode_1, mode_2, friction
        )
    return lambda floats, sigma, fraction, history, mode_1, mode_2, friction: RisingUpdate(
        sigma, fraction, history, mode_1, mode_2, friction, floats
    )


def slip_of(update, slipped):
    """Plastic slip (m) that goes with a fraction of the elastic shear stress that is lost: none of what floats."""
    return where(update.floats, 0.0, slipped) if isinstance(update, RisingUpdate) else slipped


@overload(slip_of)
def _slip_of(update, slipped):
    if update.instance_class is RisingUpdate:
        return lambda update, slipped: where(update.floats, 0.0, slipped)
    return lambda update, slipped: slipped


def acted(dilation, c, like, force, n, area):
    """Normal stress (Pa) by the forces (C, 3) that act, at c and the contacts after it; None where none dilates."""
    raise NotImplementedError("only compiled code asks")


@overload(acted)
def _acted(dilation, c, like, force, n, area):
    if isinstance(dilation, types.NoneType):
        return lambda dilation, c, like, force, n, area: None
    rows = eight_rows if isinstance(like, Lanes) else register_jitable(lambda c: c)

    def along(dilation, c, like, force, n, area):
        here = rows(c)
        return (force[here, 0] * n[0] + force[here, 1] * n[1] + force[here, 2] * n[2]) / take(area, c, like)

    return along


def spent(before, joint, history, whole_tau, met, slipped, rise, first, last):
    """Energies (J/m2) of mode II and of friction that a slip takes, by the mean of its first and its last stresses.

    whole_tau  Pa, elastic shear stress of the step; `met` of it is slip in the air, before faces met
    first      Pa, strength, residual strength and normal stress at which it begins, last: those that it leaves

    Where faces that dilate slid already, they began under the normal stress `before`: as they go on at one pressure,
    each step lifts them by as much as they rise, and they may even part in between.
    """
    (started, residual, sigma), (yielded, remains, lifted) = first, last
    mode_2 = slipped * 0.5 * (started - residual + yielded - remains)
    return mode_2, slipped * 0.5 * (residual + remains) + 0.5 * (sigma + lifted) * rise


@overload(spent)
def _spent(before, joint, history, whole_tau, met, slipped, rise, first, last):
    return spent if isinstance(before, types.NoneType) else _spent_rising


@register_jitable
def _spent_rising(before, joint, history, whole_tau, met, slipped, rise, first, last):
    (started, residual, sigma), (yielded, remains, lifted) = first, last
    peak, residual_now = coulomb(joint, history, before / joint.normal_stiffness, before)
    bore = left_of(joint, history, history.intact_s, peak, residual_now)
    slid = (before < 0.0) & (bore <= whole_tau * (1.0 + SAME))
    started, residual, sigma = (
        where(slid, bore, started),
        where(slid, residual_now, residual),
        where(slid, before, sigma),
    )
    free = where(slid & (slipped > 0.0), met / joint.shear_stiffness, 0.0)
    mode_2 = slipped * 0.5 * (started - residual + yielded - remains)
    friction = (slipped + free) * 0.5 * (residual + remains)
    return mode_2, friction + 0.5 * (sigma + lifted) * (rise + joint.tan_dilation * free)


@register_jitable
def in_springs(tan_dilation, joint, history, e, tau_squared):
    """Square of the shear stress (Pa2) that springs hold: what floats is off its springs."""
    if tan_dilation is None:
        return tau_squared
    shear_strength = strength(joint, history, e, normal_stress(joint, history, e))
    return minimum(tau_squared, shear_strength * shear_strength)
