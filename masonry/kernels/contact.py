"""The sweep over contact points: relative displacement in, force out. Knows no kinematics and no law's formula."""

from math import sqrt

from numba import prange

from masonry.jit.compiled_parts import CompiledPart
from masonry.jit.compiler import inlined, inner, inner_parallel
from masonry.jit.extending import register_jitable
from masonry.jit.records import unpack
from masonry.laws.compression_cap import acts_on, is_within, return_to_cap, strength_left
from masonry.laws.cone import acted, slip_of
from masonry.laws.law_dispatch import contacts_at_once
from masonry.laws.mechanism import elastic_trial, return_mapping, stored_energy
from masonry.laws.state import ContactHistory
from masonry.patches.branches import of_bond, pull_left, stiffness_now
from masonry.simd import (
    any_lane,
    below,
    filled,
    gather,
    local,
    or_zero,
    put_rows,
    put_where,
    take,
    unless,
    where,
    width_of,
)


@register_jitable
def apart(a, b, n):
    """Displacement of side b against side a, split into opening along n and slip (m); all of them x, y, z."""
    dx, dy, dz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    opening = dx * n[0] + dy * n[1] + dz * n[2]
    return opening, dx - opening * n[0], dy - opening * n[1], dz - opening * n[2]


@inlined
def crush(lanes, crushed, c, joint, history, bears, opening, sigma, tau, acting):
    """Opening (m) and elastic shear stress (Pa) that the law sees, once the contacts from c on are back on their cap.

    lanes  which of them there are    sigma, tau  Pa, elastic stresses    acting  those that acted until now
    """
    closing, hardening, taken = take(crushed, (c, 0), tau), take(crushed, (c, 1), tau), take(crushed, (c, 2), tau)
    squeezed = return_to_cap(joint, history, closing, hardening, bears, opening, sigma, tau, acting)
    put_where(lanes, crushed, (c, 0), squeezed.closing)
    put_where(lanes, crushed, (c, 1), squeezed.hardening)
    put_where(lanes, crushed, (c, 2), taken + squeezed.work)
    return squeezed.opening, squeezed.tau


@inlined
def write_history(lanes, c, update, opening_max, intact_n, intact_s, secant, dilation, permanent_opening, plastic_slip):
    """Write the history after an update, of those contacts from c on that there are; nothing where an array is None."""
    put_where(lanes, opening_max, c, update.history.opening_max)
    put_where(lanes, intact_n, c, update.history.intact_n)
    put_where(lanes, intact_s, c, update.history.intact_s)
    put_where(lanes, secant, c, update.history.secant)
    put_where(lanes, dilation, c, update.history.dilation)
    put_where(lanes, permanent_opening, c, update.history.permanent_opening)
    put_where(lanes, plastic_slip, c, update.history.plastic_slip)


def _sweep(
    like, parameters, joint, first, last, sides, normal, area, u, force,
    opening_max, intact_n, intact_s, secant, slip, dissipated, dilation, permanent_opening, plastic_slip, crushed,
    keep, gain, before, stress, taken,
):  # fmt: skip
    """Contacts first..last, as many at a time as `like` has: d = u_b - u_a, split along n; force acts on side a.

    The last ones may be fewer: what is beyond them is read (arrays have room behind their last number) and left alone.
    Laws ask for the force that acted until now: that of the next group is its own.
    Arrays are read and written by `take` and `put` alone: handed to a function they would be counted at every contact.
    Numbers of `parameters` and `joint` that are arrays hold one number for each contact of the group, from 0 on.
    keep, gain, before, stress, taken: of Dashpots, None without any. Friction follows the stress of the springs.
    """
    ks, width = joint.shear_stiffness, width_of(like)
    flexibility = 1.0 / ks
    for k in prange((last - first + width - 1) // width):
        c = first + width * k
        lanes = below(last - c, like)
        nx, ny, nz = take(normal, (c, 0), like), take(normal, (c, 1), like), take(normal, (c, 2), like)
        a, b = gather(u, sides, (c, 0), like), gather(u, sides, (c, 1), like)
        opening, sx, sy, sz = apart(a, b, (nx, ny, nz))
        if crushed is not None:
            opening = opening + take(crushed, (c, 0), like)
        px = or_zero(take(slip, (c, 0), like), like)
        py = or_zero(take(slip, (c, 1), like), like)
        pz = or_zero(take(slip, (c, 2), like), like)
        tx, ty, tz = ks * (sx - px), ks * (sy - py), ks * (sz - pz)
        tau_squared = tx * tx + ty * ty + tz * tz
        history = ContactHistory(
            take(opening_max, c, like), take(intact_n, c, like), take(intact_s, c, like), take(secant, c, like),
            take(dilation, c, like), take(permanent_opening, c, like), take(plastic_slip, c, like),
        )  # fmt: skip
        parameters_c, joint_c = local(parameters, c - first, like), local(joint, c - first, like)
        sigma, unchanged = elastic_trial(parameters_c, joint_c, history, opening, tau_squared)
        if crushed is not None:
            bears = strength_left(joint_c, take(crushed, (c, 1), like))
            inside = is_within(joint_c, bears, sigma, tau_squared)
            unchanged = unchanged & inside
        stays = filled(1.0, opening)
        if any_lane(unless(lanes, unchanged)):
            total, tau = sqrt(sx * sx + sy * sy + sz * sz), sqrt(tau_squared)
            acts = acted(dilation, c, like, force, (nx, ny, nz), area)
            left_by_cap = tau
            if crushed is not None and any_lane(unless(lanes, inside)):
                acting = acts_on(c, like, force, (nx, ny, nz), take(area, c, like))
                opening, left_by_cap = crush(lanes, crushed, c, joint_c, history, bears, opening, sigma, tau, acting)
                sigma, unchanged = elastic_trial(parameters_c, joint_c, history, opening, left_by_cap * left_by_cap)
            fraction, slip_factor = filled(1.0, opening), filled(0.0, opening)
            if crushed is None or any_lane(unless(lanes, unchanged)):
                update = return_mapping(parameters_c, joint_c, history, opening, total, left_by_cap, acts)
                write_history(
                    lanes, c, update, opening_max, intact_n, intact_s, secant, dilation, permanent_opening, plastic_slip
                )
                put_where(lanes, dissipated, (c, 0), or_zero(take(dissipated, (c, 0), like), like) + update.mode_1)
                put_where(lanes, dissipated, (c, 1), or_zero(take(dissipated, (c, 1), like), like) + update.mode_2)
                put_where(lanes, dissipated, (c, 2), or_zero(take(dissipated, (c, 2), like), like) + update.friction)
                sigma, fraction = update.sigma, update.fraction
                if crushed is not None:
                    fraction = where(tau > 0.0, fraction * left_by_cap / tau, fraction)
                slip_factor = slip_of(update, (1.0 - fraction) * flexibility)
            elif crushed is not None:
                fraction = where(tau > 0.0, left_by_cap / tau, fraction)
                slip_factor = (1.0 - fraction) * flexibility
            stays = filled(fraction, opening)
            put_where(lanes, slip, (c, 0), px + slip_factor * tx)
            put_where(lanes, slip, (c, 1), py + slip_factor * ty)
            put_where(lanes, slip, (c, 2), pz + slip_factor * tz)
            tx, ty, tz = fraction * tx, fraction * ty, fraction * tz
        if stress is not None:
            stiff = stiffness_now(joint_c.normal_stiffness, sigma, opening)
            stuck = where((stiff > 0.0) & (stays == 1.0), ks * (stiff / joint_c.normal_stiffness), 0.0)
            room = pull_left(joint_c.tensile_strength, take(intact_n, c, like), sigma)
            parted = b[0] - a[0], b[1] - a[1], b[2] - a[2]
            q, work = of_bond(lanes, keep, gain, before, stress, c, parted, (nx, ny, nz), stiff, stuck, room)
            put_where(lanes, taken, c, take(taken, c, like) + work)
            tx, ty, tz = tx + q[0], ty + q[1], tz + q[2]
        size = take(area, c, like)
        put_rows(force, c, last - c, size * (sigma * nx + tx), size * (sigma * ny + ty), size * (sigma * nz + tz))


_sweep_serial, _sweep_parallel = inner(_sweep), inner_parallel(_sweep)


@inner
def sweep(
    parallel, parameters, joint, state, first, last, sides, normal, area, u, force, keep, gain, before, stress, taken
):
    """One contact group, as many contacts at a time as its law allows.

    `parallel` is None or True, and only the version that is used gets compiled.
    """
    like = contacts_at_once(parameters)
    if parallel is None:
        _sweep_serial(
            like, parameters, joint, first, last, sides, normal, area, u, force, state.opening_max, state.intact_n,
            state.intact_s, state.secant, state.slip, state.dissipated, state.dilation, state.permanent_opening,
            state.plastic_slip, state.crushed, keep, gain, before, stress, taken,
        )  # fmt: skip
    else:
        _sweep_parallel(
            like, parameters, joint, first, last, sides, normal, area, u, force, state.opening_max, state.intact_n,
            state.intact_s, state.secant, state.slip, state.dissipated, state.dilation, state.permanent_opening,
            state.plastic_slip, state.crushed, keep, gain, before, stress, taken,
        )  # fmt: skip


@CompiledPart
def look(record):
    """Fill seen (4, C) for the contacts of a group, as `observe` does, and add what they store (J) to stored (1,)."""
    parameters, joint, state, first, last, sides, normal, area, u, force, seen, stored = unpack(record)
    stored[0] += observe(parameters, joint, state, first, last, sides, normal, area, u, force, seen)


@inner
def observe(parameters, joint, state, first, last, sides, normal, area, u, force, seen):
    """Fill seen[:, c] = opening, slip, sigma, tau, and return the stored energy (J) of the group.

    Stresses come from the force that acts; opening, slip and stored energy from displacements and state.
    """
    energy, ks = 0.0, joint.shear_stiffness
    for c in range(first, last):
        nx, ny, nz = normal[c, 0], normal[c, 1], normal[c, 2]
        a, b = gather(u, sides, (c, 0), 0.0), gather(u, sides, (c, 1), 0.0)
        opening, sx, sy, sz = apart(a, b, (nx, ny, nz))
        closed = opening + or_zero(take(state.crushed, (c, 0), 0.0), 0.0)
        px = or_zero(take(state.slip, (c, 0), 0.0), 0.0)
        py = or_zero(take(state.slip, (c, 1), 0.0), 0.0)
        pz = or_zero(take(state.slip, (c, 2), 0.0), 0.0)
        tau_squared = ks * ks * ((sx - px) ** 2 + (sy - py) ** 2 + (sz - pz) ** 2)
        history = ContactHistory(
            take(state.opening_max, c, 0.0), take(state.intact_n, c, 0.0), take(state.intact_s, c, 0.0),
            take(state.secant, c, 0.0), take(state.dilation, c, 0.0), take(state.permanent_opening, c, 0.0),
            take(state.plastic_slip, c, 0.0),
        )  # fmt: skip
        parameters_c, joint_c = local(parameters, c - first, 0.0), local(joint, c - first, 0.0)
        energy += area[c] * stored_energy(parameters_c, joint_c, history, closed, tau_squared)
        sigma = (force[c, 0] * nx + force[c, 1] * ny + force[c, 2] * nz) / area[c]
        fx, fy, fz = force[c, 0] / area[c], force[c, 1] / area[c], force[c, 2] / area[c]
        seen[0, c] = opening
        seen[1, c] = sqrt(sx * sx + sy * sy + sz * sz)
        seen[2, c] = sigma
        seen[3, c] = sqrt((fx - sigma * nx) ** 2 + (fy - sigma * ny) ** 2 + (fz - sigma * nz) ** 2)
    return energy
