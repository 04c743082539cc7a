"""The sweep over contact points: relative displacement in, force out. Knows no kinematics and no law's formula."""

from math import sqrt

from numba import prange
from numba.extending import register_jitable

from masonry.jit.compiler import jit, jit_parallel
from masonry.laws.dispatch import contacts_at_once
from masonry.laws.mechanism import elastic_trial, return_mapping, stored_energy
from masonry.laws.state import ContactHistory
from masonry.simd import any_lane, below, gather, local, or_zero, put_rows, put_where, take, unless, width_of


@register_jitable
def apart(a, b, n):
    """Displacement of side b against side a, split into opening along n and slip (m); all of them x, y, z."""
    dx, dy, dz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    opening = dx * n[0] + dy * n[1] + dz * n[2]
    return opening, dx - opening * n[0], dy - opening * n[1], dz - opening * n[2]


def _sweep(
    like, shape, interface, first, last, sides, normal, area, u, force,
    opening_max, intact_n, intact_s, secant, slip, spent, uplift, gap, run,
):  # fmt: skip
    """Contacts first..last, as many at a time as `like` has: d = u_b - u_a, split along n; force acts on side a.

    The last ones may be fewer: what is beyond them is read (arrays have room behind their last number), and its history
    left alone; its force is written, and written again by the group that it belongs to.
    Arrays are read and written by `take` and `put` alone: handed to a function they would be counted at every contact.
    Parameters of shape and interface that are arrays hold one number for each contact of the group, from 0 on.
    """
    ks, width = interface.shear_stiffness, width_of(like)
    flexibility = 1.0 / ks
    for k in prange((last - first + width - 1) // width):
        c = first + width * k
        own = below(last - c, like)
        nx, ny, nz = take(normal, (c, 0), like), take(normal, (c, 1), like), take(normal, (c, 2), like)
        a, b = gather(u, sides, (c, 0), like), gather(u, sides, (c, 1), like)
        opening, sx, sy, sz = apart(a, b, (nx, ny, nz))
        px = or_zero(take(slip, (c, 0), like), like)
        py = or_zero(take(slip, (c, 1), like), like)
        pz = or_zero(take(slip, (c, 2), like), like)
        tx, ty, tz = ks * (sx - px), ks * (sy - py), ks * (sz - pz)
        tau_squared = tx * tx + ty * ty + tz * tz
        memory = ContactHistory(
            take(opening_max, c, like), take(intact_n, c, like), take(intact_s, c, like), take(secant, c, like),
            take(uplift, c, like), take(gap, c, like), take(run, c, like),
        )  # fmt: skip
        form, joint = local(shape, c - first, like), local(interface, c - first, like)
        sigma, unchanged = elastic_trial(form, joint, memory, opening, tau_squared)
        if any_lane(unless(own, unchanged)):
            total = sqrt(sx * sx + sy * sy + sz * sz)
            answer = return_mapping(form, joint, memory, opening, total, sqrt(tau_squared))
            put_where(own, opening_max, c, answer.memory.opening_max)
            put_where(own, intact_n, c, answer.memory.intact_n)
            put_where(own, intact_s, c, answer.memory.intact_s)
            put_where(own, secant, c, answer.memory.secant)
            put_where(own, uplift, c, answer.memory.uplift)
            put_where(own, gap, c, answer.memory.gap)
            put_where(own, run, c, answer.memory.run)
            put_where(own, spent, (c, 0), or_zero(take(spent, (c, 0), like), like) + answer.mode_1)
            put_where(own, spent, (c, 1), or_zero(take(spent, (c, 1), like), like) + answer.mode_2)
            put_where(own, spent, (c, 2), or_zero(take(spent, (c, 2), like), like) + answer.friction)
            sigma, share = answer.sigma, answer.share
            left = (1.0 - share) * flexibility
            put_where(own, slip, (c, 0), px + left * tx)
            put_where(own, slip, (c, 1), py + left * ty)
            put_where(own, slip, (c, 2), pz + left * tz)
            tx, ty, tz = share * tx, share * ty, share * tz
        size = take(area, c, like)
        put_rows(force, c, size * (sigma * nx + tx), size * (sigma * ny + ty), size * (sigma * nz + tz))


_sweep_serial = jit(_sweep)
_sweep_parallel = jit_parallel(_sweep)


@jit
def sweep(parallel, shape, interface, state, first, last, sides, normal, area, u, force):
    """One contact group, as many contacts at a time as its law allows.

    `parallel` is None or True, and only the version that is used gets compiled.
    """
    like = contacts_at_once(shape)
    if parallel is None:
        _sweep_serial(
            like, shape, interface, first, last, sides, normal, area, u, force, state.opening_max, state.intact_n,
            state.intact_s, state.secant, state.slip, state.spent, state.uplift, state.gap, state.run,
        )  # fmt: skip
    else:
        _sweep_parallel(
            like, shape, interface, first, last, sides, normal, area, u, force, state.opening_max, state.intact_n,
            state.intact_s, state.secant, state.slip, state.spent, state.uplift, state.gap, state.run,
        )  # fmt: skip


@jit
def observe(shape, interface, state, first, last, sides, normal, area, u, force, seen):
    """Fill seen[:, c] = opening, slip, sigma, tau, and return the stored energy (J) of the group.

    Stresses come from the force that acts; opening, slip and stored energy from displacements and state.
    """
    energy, ks = 0.0, interface.shear_stiffness
    for c in range(first, last):
        nx, ny, nz = normal[c, 0], normal[c, 1], normal[c, 2]
        a, b = gather(u, sides, (c, 0), 0.0), gather(u, sides, (c, 1), 0.0)
        opening, sx, sy, sz = apart(a, b, (nx, ny, nz))
        px = or_zero(take(state.slip, (c, 0), 0.0), 0.0)
        py = or_zero(take(state.slip, (c, 1), 0.0), 0.0)
        pz = or_zero(take(state.slip, (c, 2), 0.0), 0.0)
        tau_squared = ks * ks * ((sx - px) ** 2 + (sy - py) ** 2 + (sz - pz) ** 2)
        memory = ContactHistory(
            take(state.opening_max, c, 0.0), take(state.intact_n, c, 0.0), take(state.intact_s, c, 0.0),
            take(state.secant, c, 0.0), take(state.uplift, c, 0.0), take(state.gap, c, 0.0), take(state.run, c, 0.0),
        )  # fmt: skip
        form, joint = local(shape, c - first, 0.0), local(interface, c - first, 0.0)
        energy += area[c] * stored_energy(form, joint, memory, opening, tau_squared)
        sigma = (force[c, 0] * nx + force[c, 1] * ny + force[c, 2] * nz) / area[c]
        fx, fy, fz = force[c, 0] / area[c], force[c, 1] / area[c], force[c, 2] / area[c]
        seen[0, c] = opening
        seen[1, c] = sqrt(sx * sx + sy * sy + sz * sz)
        seen[2, c] = sigma
        seen[3, c] = sqrt((fx - sigma * nx) ** 2 + (fy - sigma * ny) ** 2 + (fz - sigma * nz) ** 2)
    return energy
