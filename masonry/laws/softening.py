"""The mechanism that all softening laws share: envelope, unloading, return to the Coulomb line (`cone.py`), energies.

A law file gives the curves (`tension_intact`, `tension_area`, `shear_intact`); this file says when a contact follows
them. Sign: sigma > 0 is tension. History never heals: `intact_n`, `intact_s` only fall, `opening_max` only grows.
"""

from math import inf

from masonry.jit.extending import register_jitable
from masonry.laws.cone import (
    answer,
    caught,
    coulomb,
    in_springs,
    left_of,
    normal_stress,
    pressed,
    shared,
    spent,
    strength,
)
from masonry.laws.law_dispatch import shear_intact, tension_area, tension_intact
from masonry.laws.state import ContactHistory, grown
from masonry.simd import any_lane, filled, maximum, minimum, or_zero, where

SECANTS, LEAST_SLOPE, ROUNDS = 4, 1e-3, 2
"""Looks at a curve over the plastic slip in a step, and how near to a snap-back the secants still go by it; looks at
what dilation and softening by the total slip make of each other."""


def elastic_trial(parameters, joint, history, opening, tau_squared):
    """(sigma, whether the elastic answer stands): the contact neither opens further, nor tears, nor slips."""
    e = opening - or_zero(history.dilation, opening)
    sigma = normal_stress(joint, history, e)
    shear_strength = strength(joint, history, e, sigma)
    within = (tau_squared <= shear_strength * shear_strength) & (sigma <= tensile_limit(joint, history))
    return sigma, within & (e <= history.opening_max)


def return_mapping(parameters, joint, history, opening, total, tau, before=None):
    """Follow the envelope in tension, then return to the Coulomb line: the stress update after eq. (6) of the paper."""
    e = opening - or_zero(history.dilation, opening)
    torn, mode_1 = tear(parameters, joint, history, e)
    sigma = normal_stress(joint, torn, e)
    peak, residual = coulomb(joint, torn, e, sigma)
    shear_strength, whole_tau = left_of(joint, torn, torn.intact_s, peak, residual), tau
    torn, e, tau, floats = caught(joint.tan_dilation, joint, torn, e, tau, shear_strength)
    slides = tau > shear_strength
    if not any_lane(slides):
        fraction = where(tau < whole_tau, tau / whole_tau, 1.0)
        return answer(floats, sigma, fraction, torn, mode_1, filled(0.0, e), filled(0.0, e))

    slip = softening_slip(joint.plastic_softening, parameters, joint, torn, e, sigma, tau, peak, residual)
    whole = where(slides, softened(parameters, joint, torn, slip, peak, residual, sigma), torn.intact_s)
    mode_1 += 0.5 * secant_energy(joint, torn, e) * (torn.intact_s - whole)
    started = minimum(tau, strength(joint, history, e, sigma))
    rise, peak, last = pressed(joint, torn, e, tau, whole, peak, residual)
    yielded = where(slides, left_of(joint, torn, whole, peak, last), tau)
    slipped, rise = (tau - yielded) / joint.shear_stiffness, where(slides, rise, 0.0)
    lift_now, run_now = grown(torn.dilation, rise), grown(torn.plastic_slip, slipped)
    slid = history_with_secant(joint, torn.opening_max, torn.intact_n, whole, lift_now, torn.permanent_opening, run_now)
    lifted = normal_stress(joint, slid, e - rise)
    parted, energy = stay_open(slid.permanent_opening, joint, slid, e - rise, lifted)
    mode_2, friction = spent(
        before, joint, history, whole_tau, whole_tau - tau, slipped, rise,
        (started, residual, normal_stress(joint, slid, e)), (yielded, last, lifted),
    )  # fmt: skip
    sigma, fraction = normal_stress(joint, parted, e - rise), where(yielded < whole_tau, yielded / whole_tau, 1.0)
    return answer(floats, sigma, fraction, parted, mode_1 + energy, mode_2, friction)


def stored_energy(parameters, joint, history, opening, tau_squared):
    """Recoverable energy per area (J/m2): normal (secant or elastic) and shear."""
    e = opening - or_zero(history.dilation, opening)
    elastic = e - or_zero(history.permanent_opening, e)
    sheared = in_springs(joint.tan_dilation, joint, history, e, tau_squared)
    return 0.5 * (normal_stress(joint, history, e) * elastic + sheared / joint.shear_stiffness)


@register_jitable
def tear(parameters, joint, history, e):
    """The history after an opening e, and the energy of mode I (J/m2) that it cost."""
    held = shared(joint.combined, history.intact_s) * history.intact_n * joint.tensile_strength
    opens = e > history.opening_max
    if not any_lane(opens):
        return stay_open(history.permanent_opening, joint, history, e, held)
    widest, intact = where(opens, e, history.opening_max), where(opens, 0.0, history.intact_n)
    if any_lane(joint.tensile_strength > 0.0):
        intact = minimum(history.intact_n, where(opens, tension_intact(parameters, joint, widest), history.intact_n))
    others = history.intact_s, history.dilation, history.permanent_opening, history.plastic_slip
    torn = history_with_secant(joint, widest, intact, *others)
    torn, energy = stay_open(history.permanent_opening, joint, torn, e, held)
    if any_lane(joint.tensile_strength > 0.0):
        gained = envelope_energy(history.permanent_opening, parameters, joint, history, widest, intact)
        energy += where(opens, gained, 0.0)
    return torn, energy


@register_jitable
def envelope_energy(permanent_opening, parameters, joint, history, e, intact):
    """Secant unloading: area under the envelope between two openings less what the secants give back."""
    if permanent_opening is not None:
        return filled(0.0, e)
    gained = tension_area(parameters, joint, e, intact)
    gained -= tension_area(parameters, joint, history.opening_max, history.intact_n)
    gained -= 0.5 * joint.tensile_strength * (intact * e - history.intact_n * history.opening_max)
    return shared(joint.combined, history.intact_s) * gained


@register_jitable
def history_with_secant(joint, opening_max, intact_n, intact_s, dilation, permanent_opening, plastic_slip):
    """A history with the secant that follows from it."""
    secant = secant_of(permanent_opening, joint, opening_max, shared(joint.combined, intact_s) * intact_n)
    return ContactHistory(opening_max, intact_n, intact_s, secant, dilation, permanent_opening, plastic_slip)


@register_jitable
def secant_of(permanent_opening, joint, opening_max, intact):
    """Stiffness in tension below the largest opening; a share lost in shear no longer carries tension either."""
    if permanent_opening is not None:
        return filled(0.0, opening_max)
    return where(opening_max > 0.0, intact * joint.tensile_strength / opening_max, 0.0)


@register_jitable
def stay_open(permanent_opening, joint, history, e, held):
    """Elastic unloading: what exceeds the strength becomes opening that stays; with its energy (J/m2).

    held  Pa, the most that the contact bore before, so that an elastic rise up to there costs nothing
    """
    if permanent_opening is None:
        return history, filled(0.0, e)
    kn, sigma = joint.normal_stiffness, joint.normal_stiffness * (e - permanent_opening)
    limit = shared(joint.combined, history.intact_s) * history.intact_n * joint.tensile_strength
    parted = where(sigma > limit, (sigma - limit) / kn, 0.0)
    energy = 0.5 * (minimum(sigma, held) + limit) * parted
    old, stays = history, permanent_opening + parted
    now = ContactHistory(old.opening_max, old.intact_n, old.intact_s, old.secant, old.dilation, stays, old.plastic_slip)
    return now, energy


@register_jitable
def tensile_limit(joint, history):
    """Strength that elastic unloading must not pass; on a secant the stress cannot pass it."""
    return strength_over(history.permanent_opening, shared(joint.combined, history.intact_s) * history.intact_n, joint)


@register_jitable
def strength_over(permanent_opening, intact, joint):
    """The tensile strength left, or no limit."""
    if permanent_opening is None:
        return filled(inf, intact)
    return intact * joint.tensile_strength


@register_jitable
def softened(parameters, joint, history, slip, peak, residual, sigma):
    """Share of the shear strength above the residual that is left after a slip (m) of this step; it only falls."""
    intact = shear_intact(parameters, joint, history.intact_s, slip, peak, residual, maximum(-sigma, 0.0))
    return where((slip > 0.0) & (peak > residual), minimum(history.intact_s, intact), history.intact_s)


@register_jitable
def softening_slip(plastic_softening, parameters, joint, history, e, sigma, tau, peak, residual):
    """How far (m) this step takes a contact along its curve: by the total slip (the paper), or by the plastic slip."""
    if plastic_softening is None:
        return total_slip_increment(joint.tan_dilation, parameters, joint, history, e, sigma, tau, peak, residual)
    return plastic_slip_increment(parameters, joint, history, e, sigma, tau, peak, residual)


@register_jitable
def total_slip_increment(tan_dilation, parameters, joint, history, e, sigma, tau, peak, residual):
    """Tau beyond the strength that was left, over ks.

    In one direction and under constant stress that is all the slip of the step, at first what lies beyond the peak;
    after a way back it goes on where the contact slides again. Where dilation presses the faces, the strength is that
    under the new stress.
    """
    ks, whole = joint.shear_stiffness, history.intact_s
    slip = maximum(tau - left_of(joint, history, whole, peak, residual), 0.0) / ks
    if tan_dilation is None:
        return slip
    for _ in range(ROUNDS):
        intact = softened(parameters, joint, history, slip, peak, residual, sigma)
        _, top, last = pressed(joint, history, e, tau, intact, peak, residual)
        slip = maximum(tau - left_of(joint, history, whole, top, last), 0.0) / ks
    return slip


@register_jitable
def plastic_slip_increment(parameters, joint, history, e, sigma, tau, peak, residual):
    """The plastic slip s of the step, on which the strength that it leaves depends: s = (tau - strength(s)) / ks.

    Solved by secants, exactly where the strength falls along a line. Taken from before the step, it would lag behind.
    """
    ks = joint.shear_stiffness
    bound = maximum(tau - residual, 0.0) / ks
    before = slip = target = filled(0.0, tau)
    for _ in range(SECANTS):
        intact = softened(parameters, joint, history, slip, peak, residual, sigma)
        _, top, last = pressed(joint, history, e, tau, intact, peak, residual)
        target, was = maximum(tau - left_of(joint, history, intact, top, last), 0.0) / ks, target
        further = slip - before
        rise = where(abs(further) > 0.0, (target - was) / further, 0.0)
        before, slip = slip, minimum(slip + (target - slip) / maximum(1.0 - rise, LEAST_SLOPE), bound)
    return slip


@register_jitable
def secant_energy(joint, history, e):
    """Twice the energy (J/m2) that tension holds, released as shear takes its share away."""
    if joint.combined is None:
        return filled(0.0, e)
    held = history.intact_n * joint.tensile_strength * e * e / history.opening_max
    return on_secant(history.permanent_opening, where(e > 0.0, held, 0.0))


@register_jitable
def on_secant(permanent_opening, energy):
    """Only a secant gives energy back at a lower stiffness; elastic unloading books it as opening that stays."""
    if permanent_opening is None:
        return energy
    return filled(0.0, energy)
