"""The mechanism that all softening laws share: envelope, unloading, return to the Coulomb line, dilation, energies.

A law file gives the curves (`tension_intact`, `tension_area`, `shear_intact`); this file says when a contact follows
them. Sign: sigma > 0 is tension. History never heals: `intact_n`, `intact_s` only fall, `opening_max` only grows.
"""

from math import inf

from numba.extending import register_jitable

from masonry.laws.dispatch import shear_intact, tension_area, tension_intact
from masonry.laws.state import ContactHistory, StressUpdate, grown
from masonry.simd import any_lane, filled, maximum, minimum, or_zero, where

SECANTS, LEAST_SLOPE, ROUNDS = 4, 1e-3, 2
"""Looks at a curve over the plastic slip in a step, and how near to a snap-back the secants still go by it; looks at
what dilation and softening by the total slip make of each other."""


def elastic_trial(shape, interface, memory, opening, tau_squared):
    """(sigma, whether the elastic answer stands): the contact neither opens further, nor tears, nor slips."""
    e = opening - or_zero(memory.uplift, opening)
    sigma = normal_stress(interface, memory, e)
    most = strength(interface, memory, e, sigma)
    within = (tau_squared <= most * most) & (sigma <= tensile_limit(interface, memory))
    return sigma, within & (e <= memory.opening_max)


def return_mapping(shape, interface, memory, opening, total, tau):
    """Follow the envelope in tension, then return to the Coulomb line: the stress update after eq. (6) of the paper."""
    e = opening - or_zero(memory.uplift, opening)
    torn, mode_1 = tear(shape, interface, memory, e)
    sigma = normal_stress(interface, torn, e)
    peak, residual = coulomb(interface, torn, e, sigma)
    slides = tau > left_of(interface, torn, torn.intact_s, peak, residual)
    if not any_lane(slides):
        return StressUpdate(sigma, filled(1.0, e), torn, mode_1, filled(0.0, e), filled(0.0, e))

    slip = softening_slip(interface.plastic_softening, shape, interface, torn, e, sigma, tau, peak, residual)
    whole = where(slides, softened(shape, interface, torn, slip, peak, residual, sigma), torn.intact_s)
    mode_1 += 0.5 * secant_energy(interface, torn, e) * (torn.intact_s - whole)
    started = minimum(tau, strength(interface, memory, e, sigma))
    rise, peak, last = pressed(interface, torn, e, tau, whole, peak, residual)
    yielded = where(slides, left_of(interface, torn, whole, peak, last), tau)
    slipped, rise = (tau - yielded) / interface.shear_stiffness, where(slides, rise, 0.0)
    lift_now, run_now = grown(torn.uplift, rise), grown(torn.run, slipped)
    slid = remember(interface, torn.opening_max, torn.intact_n, whole, lift_now, torn.gap, run_now)
    lifted = normal_stress(interface, slid, e - rise)
    parted, energy = stay_open(slid.gap, interface, slid, e - rise, lifted)
    mode_2 = slipped * 0.5 * (started - residual + yielded - last)
    friction = slipped * 0.5 * (residual + last) + 0.5 * (normal_stress(interface, slid, e) + lifted) * rise
    share = where(slides, yielded / tau, 1.0)
    return StressUpdate(normal_stress(interface, parted, e - rise), share, parted, mode_1 + energy, mode_2, friction)


def stored_energy(shape, interface, memory, opening, tau_squared):
    """Recoverable energy per area (J/m2): normal (secant or elastic) and shear."""
    e = opening - or_zero(memory.uplift, opening)
    return 0.5 * (
        normal_stress(interface, memory, e) * (e - or_zero(memory.gap, e)) + tau_squared / interface.shear_stiffness
    )


@register_jitable
def tear(shape, interface, memory, e):
    """The history after an opening e, and the energy of mode I (J/m2) that it cost."""
    held = shared(interface.combined, memory.intact_s) * memory.intact_n * interface.tensile_strength
    opens = e > memory.opening_max
    if not any_lane(opens):
        return stay_open(memory.gap, interface, memory, e, held)
    widest, left = where(opens, e, memory.opening_max), where(opens, 0.0, memory.intact_n)
    if any_lane(interface.tensile_strength > 0.0):
        left = minimum(memory.intact_n, where(opens, tension_intact(shape, interface, widest), memory.intact_n))
    torn = remember(interface, widest, left, memory.intact_s, memory.uplift, memory.gap, memory.run)
    torn, energy = stay_open(memory.gap, interface, torn, e, held)
    if any_lane(interface.tensile_strength > 0.0):
        energy += where(opens, envelope_energy(memory.gap, shape, interface, memory, widest, left), 0.0)
    return torn, energy


@register_jitable
def envelope_energy(gap, shape, interface, memory, e, left):
    """Secant unloading: area under the envelope between two openings less what the secants give back."""
    if gap is not None:
        return filled(0.0, e)
    gained = tension_area(shape, interface, e, left)
    gained -= tension_area(shape, interface, memory.opening_max, memory.intact_n)
    gained -= 0.5 * interface.tensile_strength * (left * e - memory.intact_n * memory.opening_max)
    return shared(interface.combined, memory.intact_s) * gained


@register_jitable
def remember(interface, opening_max, intact_n, intact_s, uplift, gap, run):
    """A history with the secant that follows from it."""
    secant = secant_of(gap, interface, opening_max, shared(interface.combined, intact_s) * intact_n)
    return ContactHistory(opening_max, intact_n, intact_s, secant, uplift, gap, run)


@register_jitable
def secant_of(gap, interface, opening_max, intact):
    """Stiffness in tension below the largest opening; a share lost in shear no longer carries tension either."""
    if gap is not None:
        return filled(0.0, opening_max)
    return where(opening_max > 0.0, intact * interface.tensile_strength / opening_max, 0.0)


@register_jitable
def stay_open(gap, interface, memory, e, held):
    """Elastic unloading: what exceeds the strength becomes opening that stays; with its energy (J/m2).

    held  Pa, the most that the contact bore before, so that an elastic rise up to there costs nothing
    """
    if gap is None:
        return memory, filled(0.0, e)
    kn = interface.normal_stiffness
    sigma = kn * (e - gap)
    limit = shared(interface.combined, memory.intact_s) * memory.intact_n * interface.tensile_strength
    parted = where(sigma > limit, (sigma - limit) / kn, 0.0)
    energy = 0.5 * (minimum(sigma, held) + limit) * parted
    gap, old = gap + parted, memory
    return ContactHistory(old.opening_max, old.intact_n, old.intact_s, old.secant, old.uplift, gap, old.run), energy


@register_jitable
def tensile_limit(interface, memory):
    """Strength that elastic unloading must not pass; on a secant the stress cannot pass it."""
    return strength_over(memory.gap, shared(interface.combined, memory.intact_s) * memory.intact_n, interface)


@register_jitable
def strength_over(gap, intact, interface):
    """The tensile strength left, or no limit."""
    if gap is None:
        return filled(inf, intact)
    return intact * interface.tensile_strength


@register_jitable
def normal_stress(interface, memory, e):
    """sigma(e): full kn in compression; in tension by secant (damage) or elastic (plastic opening) unloading."""
    return unload(memory.gap, interface, memory, e)


@register_jitable
def unload(gap, interface, memory, e):
    """Elastic, or along the secant."""
    if gap is not None:
        return interface.normal_stiffness * (e - gap)
    return e * where(e > 0.0, memory.secant, interface.normal_stiffness)


@register_jitable
def coulomb(interface, memory, e, sigma):
    """Peak and residual shear strength at the present stress, eq. (8); never negative, never crossed.

    The residual cohesion acts between faces that touch: torn faces lose it as they open, and find it again on closing.
    """
    peak = maximum(interface.cohesion - sigma * interface.tan_friction, 0.0)
    c_res = residual_cohesion(interface, memory, e)
    residual = maximum(c_res - sigma * interface.tan_residual_friction, 0.0)
    return maximum(peak, residual), residual


@register_jitable
def residual_cohesion(interface, memory, e):
    """Residual cohesion (Pa) of faces that stand open by e."""
    c_res = filled(interface.residual_cohesion, e)
    if interface.residual_cohesion == 0.0:
        return c_res
    stands_open = (e > 0.0) & (memory.intact_n < 1.0)
    if not any_lane(stands_open):
        return c_res
    lost = (1.0 - shared(interface.combined, memory.intact_n)) * minimum(e / memory.opening_max, 1.0)
    return where(stands_open, c_res * (1.0 - lost), c_res)


@register_jitable
def strength(interface, memory, e, sigma):
    """Shear strength (Pa) that this history leaves at the present stress."""
    peak, residual = coulomb(interface, memory, e, sigma)
    return left_of(interface, memory, memory.intact_s, peak, residual)


@register_jitable
def left_of(interface, memory, whole, peak, residual):
    """Shear strength (Pa) where a share `whole` of it is left in shear."""
    return residual + whole * shared(interface.combined, memory.intact_n) * (peak - residual)


@register_jitable
def shared(combined, intact):
    """The other mode's intact share where tension and cohesion are lost together, D = dt + ds - dt ds; else 1."""
    if combined is None:
        return filled(1.0, intact)
    return intact


@register_jitable
def softened(shape, interface, memory, slip, peak, residual, sigma):
    """Share of the shear strength above the residual that is left after a slip (m) of this step; it only falls."""
    left = shear_intact(shape, interface, memory.intact_s, slip, peak, residual, maximum(-sigma, 0.0))
    return where((slip > 0.0) & (peak > residual), minimum(memory.intact_s, left), memory.intact_s)


@register_jitable
def softening_slip(plastic_softening, shape, interface, memory, e, sigma, tau, peak, residual):
    """How far (m) this step takes a contact along its curve: by the total slip (the paper), or by the plastic slip."""
    if plastic_softening is None:
        return total_slip(interface.tan_dilation, shape, interface, memory, e, sigma, tau, peak, residual)
    return plastic_slip(shape, interface, memory, e, sigma, tau, peak, residual)


@register_jitable
def total_slip(tan_dilation, shape, interface, memory, e, sigma, tau, peak, residual):
    """Tau beyond the strength that was left, over ks.

    In one direction and under constant stress that is all the slip of the step, at first what lies beyond the peak;
    after a way back it goes on where the contact slides again. Where dilation presses the faces, the strength is that
    under the new stress.
    """
    ks, whole = interface.shear_stiffness, memory.intact_s
    slip = maximum(tau - left_of(interface, memory, whole, peak, residual), 0.0) / ks
    if tan_dilation is None:
        return slip
    for _ in range(ROUNDS):
        left = softened(shape, interface, memory, slip, peak, residual, sigma)
        _, top, last = pressed(interface, memory, e, tau, left, peak, residual)
        slip = maximum(tau - left_of(interface, memory, whole, top, last), 0.0) / ks
    return slip


@register_jitable
def plastic_slip(shape, interface, memory, e, sigma, tau, peak, residual):
    """The plastic slip s of the step, on which the strength that it leaves depends: s = (tau - strength(s)) / ks.

    Solved by secants, exactly where the strength falls along a line. Taken from before the step, it would lag behind.
    """
    ks = interface.shear_stiffness
    most = maximum(tau - residual, 0.0) / ks
    before, slip = filled(0.0, tau), filled(0.0, tau)
    wanted = filled(0.0, tau)
    for _ in range(SECANTS):
        left = softened(shape, interface, memory, slip, peak, residual, sigma)
        _, top, last = pressed(interface, memory, e, tau, left, peak, residual)
        wanted, was = maximum(tau - left_of(interface, memory, left, top, last), 0.0) / ks, wanted
        way = slip - before
        rise = where(abs(way) > 0.0, (wanted - was) / way, 0.0)
        before, slip = slip, minimum(slip + (wanted - slip) / maximum(1.0 - rise, LEAST_SLOPE), most)
    return slip


@register_jitable
def pressed(interface, memory, e, tau, whole, peak, residual):
    """Rise (m) by dilation of a contact that slides and keeps a share `whole`; peak and residual (Pa) under it."""
    excess = maximum(tau - left_of(interface, memory, whole, peak, residual), 0.0)
    rise = dilation(interface.tan_dilation, interface, memory, e, excess, whole)
    top, last = cone_after(interface.tan_dilation, interface, memory, e - rise, peak, residual)
    return rise, top, last


@register_jitable
def secant_energy(interface, memory, e):
    """Twice the energy (J/m2) that tension holds, released as shear takes its share away."""
    if interface.combined is None:
        return filled(0.0, e)
    held = memory.intact_n * interface.tensile_strength * e * e / memory.opening_max
    return on_secant(memory.gap, where(e > 0.0, held, 0.0))


@register_jitable
def on_secant(gap, energy):
    """Only a secant gives energy back at a lower stiffness; elastic unloading books it as opening that stays."""
    if gap is None:
        return energy
    return filled(0.0, energy)


@register_jitable
def dilation(tan_dilation, interface, memory, e, excess, whole):
    """Rise (m) by eqs (9) and (10) up to the cut-off; torn faces that stand open do not dilate.

    The elastic shear stress exceeds the cone by `excess` (Pa), and the rise itself lifts the cone: both return at once.
    """
    if tan_dilation is None:
        return filled(0.0, e)
    room = maximum(interface.dilation_cutoff - memory.run, 0.0)
    room = where((e > 0.0) & (memory.intact_n < 1.0), 0.0, room)
    tan_res = interface.tan_residual_friction
    slope = tan_res + whole * shared(interface.combined, memory.intact_n) * (interface.tan_friction - tan_res)
    slipped = excess / (interface.shear_stiffness + slope * interface.normal_stiffness * tan_dilation)
    return tan_dilation * minimum(slipped, room)


@register_jitable
def cone_after(tan_dilation, interface, memory, e, peak, residual):
    """Peak and residual shear strength (Pa) once dilation has pressed the faces; unchanged without it."""
    if tan_dilation is None:
        return peak, residual
    return coulomb(interface, memory, e, normal_stress(interface, memory, e))
