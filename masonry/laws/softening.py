"""The mechanism that all softening laws share: envelope, unloading, return to the Coulomb line, dilation, energies.

A law file gives the curves (`tension_intact`, `tension_area`, `shear_intact`); this file says when a contact follows
them. Sign: sigma > 0 is tension. History never heals: `intact_n`, `intact_s` only fall, `opening_max` only grows.
"""

from math import sqrt

from numba.extending import register_jitable

from masonry.laws.door import shear_intact, tension_area, tension_intact
from masonry.laws.state import add, read


def respond(shape, interface, c, opening, slip_x, slip_y, slip_z, state):
    """Stresses of contact c under a total opening and slip (m): the stress update after eq. (6) of the paper."""
    ks = interface.shear_stiffness
    e = opening - read(state.uplift, c)
    intact_before = state.intact_s[c] * shared_loss(interface.combined, state.intact_n[c])
    if e > state.opening_max[c]:
        open_further(shape, interface, c, e, state)
    sigma = normal_stress(interface, c, e, state)

    tau_x = ks * (slip_x - state.slip[c, 0])
    tau_y = ks * (slip_y - state.slip[c, 1])
    tau_z = ks * (slip_z - state.slip[c, 2])
    tau_squared = tau_x * tau_x + tau_y * tau_y + tau_z * tau_z
    peak, residual = coulomb(interface, c, e, sigma, state)
    untorn = shared_loss(interface.combined, state.intact_n[c])
    strength = residual + state.intact_s[c] * untorn * (peak - residual)
    if tau_squared <= strength * strength:
        return sigma, tau_x, tau_y, tau_z

    tau = sqrt(tau_squared)
    total = sqrt(slip_x * slip_x + slip_y * slip_y + slip_z * slip_z)
    beyond = slip_beyond_peak(interface.plastic_softening, total - peak / ks, state.run, c)
    intact = state.intact_s[c]
    if beyond > 0.0 and peak > residual:
        intact = soften_shear(shape, interface, c, e, beyond, peak, residual, max(-sigma, 0.0), state)
    yielded = residual + intact * untorn * (peak - residual)
    started = min(tau, residual + intact_before * (peak - residual))
    slipped = (tau - yielded) / ks
    share = yielded / tau
    state.slip[c, 0] += tau_x * (1.0 - share) / ks
    state.slip[c, 1] += tau_y * (1.0 - share) / ks
    state.slip[c, 2] += tau_z * (1.0 - share) / ks
    state.spent[c, 1] += slipped * (0.5 * (started + yielded) - residual)
    state.spent[c, 2] += slipped * residual
    dilate(interface.tan_dilation, interface, c, e, sigma, slipped, state)
    add(state.run, c, slipped)
    sigma = normal_stress(interface, c, opening - read(state.uplift, c), state)
    return sigma, tau_x * share, tau_y * share, tau_z * share


@register_jitable
def open_further(shape, interface, c, e, state):
    """Follow the tension envelope to a new largest opening; what it costs is fracture energy of mode I."""
    fT = interface.tensile_strength
    before = state.intact_n[c]
    intact = 0.0
    if fT > 0.0:
        intact = min(before, tension_intact(shape, interface, e))
        gained = tension_area(shape, interface, e, intact)
        gained -= tension_area(shape, interface, state.opening_max[c], before)
        left = shared_loss(interface.combined, state.intact_s[c])
        if state.gap is None:
            gained -= 0.5 * fT * (intact * e - before * state.opening_max[c])
            state.spent[c, 0] += left * gained
    state.opening_max[c] = e
    state.intact_n[c] = intact


@register_jitable
def normal_stress(interface, c, e, state):
    """sigma(e): full kn in compression; in tension by secant (damage) or elastic (plastic opening) unloading."""
    return unload(state.gap, interface, c, e, state)


@register_jitable
def unload(gap, interface, c, e, state):
    """Elastic unloading is there where the contact has a memory for the opening that stays."""
    if gap is None:
        return secant_stress(interface, c, e, state)
    return plastic_stress(interface, c, e, gap, state)


@register_jitable
def secant_stress(interface, c, e, state):
    """Tension on the secant of the largest opening; a share lost in shear no longer carries tension either."""
    if e <= 0.0:
        return interface.normal_stiffness * e
    left = shared_loss(interface.combined, state.intact_s[c])
    return left * state.intact_n[c] * interface.tensile_strength * e / state.opening_max[c]


@register_jitable
def plastic_stress(interface, c, e, gap, state):
    """Slope kn; where the strength is passed the excess becomes an opening that stays (compression then meets a gap)."""
    kn = interface.normal_stiffness
    sigma = kn * (e - gap[c])
    limit = shared_loss(interface.combined, state.intact_s[c]) * state.intact_n[c] * interface.tensile_strength
    if sigma <= limit:
        return sigma
    state.spent[c, 0] += 0.5 * (sigma + limit) * (sigma - limit) / kn
    gap[c] = e - limit / kn
    return limit


@register_jitable
def coulomb(interface, c, e, sigma, state):
    """Peak and residual shear strength at the present stress, eq. (8); never negative, never crossed.

    The residual cohesion acts between faces that touch: torn faces lose it as they stand open, and find it again on closing.
    """
    peak = max(interface.cohesion - sigma * interface.tan_friction, 0.0)
    c_res = interface.residual_cohesion
    if e > 0.0 and state.opening_max[c] > 0.0:
        torn = 1.0 - shared_loss(interface.combined, state.intact_n[c])
        c_res *= 1.0 - torn * e / state.opening_max[c]
    residual = max(c_res - sigma * interface.tan_residual_friction, 0.0)
    return max(peak, residual), residual


@register_jitable
def shared_loss(combined, intact):
    """The other mode's intact share where tension and cohesion are lost together, D = dt + ds - dt ds; else 1."""
    if combined is None:
        return 1.0
    return intact


@register_jitable
def slip_beyond_peak(plastic_softening, beyond, run, c):
    """Softening variable: total slip less the slip at peak (the paper), or the path of plastic slip."""
    if plastic_softening is None:
        return beyond
    return run[c]


@register_jitable
def soften_shear(shape, interface, c, e, beyond, peak, residual, compression, state):
    """Follow the shear envelope; tension lost with it releases its stored energy as fracture energy of mode I."""
    before = state.intact_s[c]
    intact = min(before, shear_intact(shape, interface, beyond, peak, residual, compression))
    if intact < before:
        if interface.combined is not None and state.gap is None and e > 0.0:
            held = state.intact_n[c] * interface.tensile_strength * e / state.opening_max[c]
            state.spent[c, 0] += 0.5 * held * e * (before - intact)
        state.intact_s[c] = intact
    return intact


@register_jitable
def dilate(tan_dilation, interface, c, e, sigma, slipped, state):
    """Eqs (9) and (10): plastic slip lifts the faces apart until the cut-off; torn faces that stand open do not dilate."""
    if tan_dilation is None:
        return
    room = interface.dilation_cutoff - state.run[c]
    if room <= 0.0 or (e > 0.0 and state.intact_n[c] < 1.0):
        return
    rise = tan_dilation * min(slipped, room)
    state.uplift[c] += rise
    after = normal_stress(interface, c, e - rise, state)
    state.spent[c, 2] += 0.5 * (sigma + after) * rise


def stored(shape, interface, c, opening, slip_x, slip_y, slip_z, state):
    """Recoverable energy per area: normal (secant or elastic) and shear."""
    e = opening - read(state.uplift, c)
    x, y, z = slip_x - state.slip[c, 0], slip_y - state.slip[c, 1], slip_z - state.slip[c, 2]
    shear = 0.5 * interface.shear_stiffness * (x * x + y * y + z * z)
    return shear + stored_normal(state.gap, interface, c, e, state)


@register_jitable
def stored_normal(gap, interface, c, e, state):
    """Recoverable energy of the normal stress; looks only, changes nothing."""
    if gap is None:
        return 0.5 * secant_stress(interface, c, e, state) * e
    return 0.5 * interface.normal_stiffness * (e - gap[c]) ** 2
