"""The mechanism that all softening laws share: envelope, unloading, return to the Coulomb line, dilation, energies.

A law file gives the curves (`tension_intact`, `tension_area`, `shear_intact`); this file says when a contact follows
them. Sign: sigma > 0 is tension. History never heals: `intact_n`, `intact_s` only fall, `opening_max` only grows.
All helpers take and return plain numbers, so that an untouched contact costs no more than its springs.
"""

from math import inf

from numba.extending import register_jitable

from masonry.laws.door import shear_intact, tension_area, tension_intact
from masonry.laws.state import Answer, Memory, grown, lift


def quiet(shape, interface, memory, opening, tau_squared):
    """(sigma, whether the elastic answer stands): the contact neither opens further, nor tears, nor slips."""
    e = opening - lift(memory.uplift)
    sigma = normal_stress(interface, memory, e)
    most = strength(interface, memory, e, sigma)
    within = tau_squared <= most * most and sigma <= tensile_limit(interface, memory)
    return sigma, within and e <= memory.opening_max


def evolve(shape, interface, memory, opening, total, tau):
    """Follow the envelope in tension, then return to the Coulomb line: the stress update after eq. (6) of the paper."""
    e = opening - lift(memory.uplift)
    torn, mode_1 = tear(shape, interface, memory, e)
    sigma = normal_stress(interface, torn, e)
    peak, residual = coulomb(interface, torn, e, sigma)
    cohesive = shared(interface.combined, torn.intact_n) * (peak - residual)
    if tau <= residual + torn.intact_s * cohesive:
        return Answer(sigma, 1.0, torn, mode_1, 0.0, 0.0)

    beyond = slip_beyond_peak(interface.plastic_softening, torn.run, total - peak / interface.shear_stiffness)
    whole = torn.intact_s
    if beyond > 0.0 and peak > residual:
        whole = min(whole, shear_intact(shape, interface, beyond, peak, residual, max(-sigma, 0.0)))
        mode_1 += 0.5 * secant_energy(interface, torn, e) * (torn.intact_s - whole)
    started = min(tau, strength(interface, memory, e, sigma))
    rise = dilation(interface.tan_dilation, interface, torn, e, tau - residual - whole * cohesive, whole)
    peak, last = cone_after(interface.tan_dilation, interface, torn, e - rise, peak, residual)
    yielded = last + whole * shared(interface.combined, torn.intact_n) * (peak - last)
    slipped = (tau - yielded) / interface.shear_stiffness
    slid = Memory(torn.opening_max, torn.intact_n, whole, grown(torn.uplift, rise), torn.gap, grown(torn.run, slipped))
    lifted = normal_stress(interface, slid, e - rise)
    parted, energy = stay_open(slid.gap, interface, slid, e - rise, slid.opening_max, slid.intact_n, lifted)
    mode_2 = slipped * 0.5 * (started - residual + yielded - last)
    friction = slipped * 0.5 * (residual + last) + 0.5 * (normal_stress(interface, slid, e) + lifted) * rise
    return Answer(normal_stress(interface, parted, e - rise), yielded / tau, parted, mode_1 + energy, mode_2, friction)


def stored(shape, interface, memory, opening, tau_squared):
    """Recoverable energy per area (J/m2): normal (secant or elastic) and shear."""
    e = opening - lift(memory.uplift)
    return 0.5 * (
        normal_stress(interface, memory, e) * (e - lift(memory.gap)) + tau_squared / interface.shear_stiffness
    )


@register_jitable
def tear(shape, interface, memory, e):
    """The history after an opening e, and the energy of mode I (J/m2) that it cost."""
    held = shared(interface.combined, memory.intact_s) * memory.intact_n * interface.tensile_strength
    if e <= memory.opening_max:
        return stay_open(memory.gap, interface, memory, e, memory.opening_max, memory.intact_n, held)
    fT = interface.tensile_strength
    left = 0.0
    if fT > 0.0:
        left = min(memory.intact_n, tension_intact(shape, interface, e))
    torn, energy = stay_open(memory.gap, interface, memory, e, e, left, held)
    if fT > 0.0:
        energy += envelope_energy(memory.gap, shape, interface, memory, e, left)
    return torn, energy


@register_jitable
def envelope_energy(gap, shape, interface, memory, e, left):
    """Secant unloading: area under the envelope between two openings less what the secants give back."""
    if gap is not None:
        return 0.0
    gained = tension_area(shape, interface, e, left)
    gained -= tension_area(shape, interface, memory.opening_max, memory.intact_n)
    gained -= 0.5 * interface.tensile_strength * (left * e - memory.intact_n * memory.opening_max)
    return shared(interface.combined, memory.intact_s) * gained


@register_jitable
def stay_open(gap, interface, memory, e, widest, left, held):
    """Elastic unloading: what exceeds the strength becomes opening that stays; with its energy (J/m2).

    held  Pa, the most that the contact bore before, so that an elastic rise up to there costs nothing
    """
    if gap is None:
        return Memory(widest, left, memory.intact_s, memory.uplift, memory.gap, memory.run), 0.0
    kn = interface.normal_stiffness
    sigma = kn * (e - gap)
    limit = shared(interface.combined, memory.intact_s) * left * interface.tensile_strength
    if sigma <= limit:
        return Memory(widest, left, memory.intact_s, memory.uplift, gap, memory.run), 0.0
    parted = (sigma - limit) / kn
    energy = 0.5 * (min(sigma, held) + limit) * parted
    return Memory(widest, left, memory.intact_s, memory.uplift, gap + parted, memory.run), energy


@register_jitable
def tensile_limit(interface, memory):
    """Strength that elastic unloading must not pass; on a secant the stress cannot pass it."""
    return strength_over(memory.gap, shared(interface.combined, memory.intact_s) * memory.intact_n, interface)


@register_jitable
def strength_over(gap, intact, interface):
    """The tensile strength left, or no limit."""
    if gap is None:
        return inf
    return intact * interface.tensile_strength


@register_jitable
def normal_stress(interface, memory, e):
    """sigma(e): full kn in compression; in tension by secant (damage) or elastic (plastic opening) unloading."""
    return unload(memory.gap, interface, memory, e)


@register_jitable
def unload(gap, interface, memory, e):
    """On the secant a share lost in shear no longer carries tension either."""
    if gap is not None:
        return interface.normal_stiffness * (e - gap)
    if e <= 0.0:
        return interface.normal_stiffness * e
    left = shared(interface.combined, memory.intact_s) * memory.intact_n
    return left * interface.tensile_strength * e / memory.opening_max


@register_jitable
def coulomb(interface, memory, e, sigma):
    """Peak and residual shear strength at the present stress, eq. (8); never negative, never crossed.

    The residual cohesion acts between faces that touch: torn faces lose it as they open, and find it again on closing.
    """
    peak = max(interface.cohesion - sigma * interface.tan_friction, 0.0)
    c_res = interface.residual_cohesion
    if e > 0.0 and memory.intact_n < 1.0:
        c_res *= 1.0 - (1.0 - shared(interface.combined, memory.intact_n)) * min(e / memory.opening_max, 1.0)
    residual = max(c_res - sigma * interface.tan_residual_friction, 0.0)
    return max(peak, residual), residual


@register_jitable
def strength(interface, memory, e, sigma):
    """Shear strength (Pa) that this history leaves at the present stress."""
    peak, residual = coulomb(interface, memory, e, sigma)
    return residual + memory.intact_s * shared(interface.combined, memory.intact_n) * (peak - residual)


@register_jitable
def shared(combined, intact):
    """The other mode's intact share where tension and cohesion are lost together, D = dt + ds - dt ds; else 1."""
    if combined is None:
        return 1.0
    return intact


@register_jitable
def slip_beyond_peak(plastic_softening, run, beyond):
    """Softening variable: total slip less the slip at peak (the paper), or the path of plastic slip."""
    if plastic_softening is None:
        return beyond
    return run


@register_jitable
def secant_energy(interface, memory, e):
    """Twice the energy (J/m2) that tension holds, released as shear takes its share away."""
    if interface.combined is None or e <= 0.0:
        return 0.0
    return on_secant(memory.gap, memory.intact_n * interface.tensile_strength * e * e / memory.opening_max)


@register_jitable
def on_secant(gap, energy):
    """Only a secant gives energy back at a lower stiffness; elastic unloading books it as opening that stays."""
    if gap is None:
        return energy
    return 0.0


@register_jitable
def dilation(tan_dilation, interface, memory, e, excess, whole):
    """Rise (m) by eqs (9) and (10) up to the cut-off; torn faces that stand open do not dilate.

    The elastic shear stress exceeds the cone by `excess` (Pa), and the rise itself lifts the cone: both return at once.
    """
    if tan_dilation is None:
        return 0.0
    room = interface.dilation_cutoff - memory.run
    if room <= 0.0 or (e > 0.0 and memory.intact_n < 1.0):
        return 0.0
    tan_res = interface.tan_residual_friction
    slope = tan_res + whole * shared(interface.combined, memory.intact_n) * (interface.tan_friction - tan_res)
    slipped = excess / (interface.shear_stiffness + slope * interface.normal_stiffness * tan_dilation)
    return tan_dilation * min(slipped, room)


@register_jitable
def cone_after(tan_dilation, interface, memory, e, peak, residual):
    """Peak and residual shear strength (Pa) once dilation has pressed the faces; unchanged without it."""
    if tan_dilation is None:
        return peak, residual
    return coulomb(interface, memory, e, normal_stress(interface, memory, e))
