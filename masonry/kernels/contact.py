"""The sweep over contact points: relative displacement in, force out. Knows no kinematics and no law's formula."""

from math import sqrt

from numba import prange
from numba.extending import register_jitable

from masonry.kernels.compiler import jit, jit_parallel
from masonry.laws.mechanism import evolve, quiet, stored
from masonry.laws.state import Memory, add_slip, plastic_slip, recall, spend, store


@register_jitable
def relative(u, a, b, nx, ny, nz):
    """Displacement of point b against point a, split into opening along n and slip (m)."""
    dx, dy, dz = u[b, 0] - u[a, 0], u[b, 1] - u[a, 1], u[b, 2] - u[a, 2]
    opening = dx * nx + dy * ny + dz * nz
    return opening, dx - opening * nx, dy - opening * ny, dz - opening * nz


def _sweep(
    shape, interface, first, last, sides, normal, area, u, force,
    opening_max, intact_n, intact_s, slip, spent, uplift, gap, run,
):  # fmt: skip
    """Contacts first..last: d = u_b - u_a, split along n; force[c] acts on side a, its opposite on side b."""
    ks = interface.shear_stiffness
    for c in prange(first, last):
        nx, ny, nz = normal[c, 0], normal[c, 1], normal[c, 2]
        opening, sx, sy, sz = relative(u, sides[c, 0], sides[c, 1], nx, ny, nz)
        px, py, pz = plastic_slip(slip, c)
        tx, ty, tz = ks * (sx - px), ks * (sy - py), ks * (sz - pz)
        tau_squared = tx * tx + ty * ty + tz * tz
        memory = Memory(
            recall(opening_max, c), recall(intact_n, c), recall(intact_s, c),
            recall(uplift, c), recall(gap, c), recall(run, c),
        )  # fmt: skip
        sigma, unchanged = quiet(shape, interface, memory, opening, tau_squared)
        if not unchanged:
            total = sqrt(sx * sx + sy * sy + sz * sz)
            answer = evolve(shape, interface, memory, opening, total, sqrt(tau_squared))
            store(opening_max, c, answer.memory.opening_max)
            store(intact_n, c, answer.memory.intact_n)
            store(intact_s, c, answer.memory.intact_s)
            store(uplift, c, answer.memory.uplift)
            store(gap, c, answer.memory.gap)
            store(run, c, answer.memory.run)
            spend(spent, c, answer.mode_1, answer.mode_2, answer.friction)
            sigma, share = answer.sigma, answer.share
            if share < 1.0:
                left = (1.0 - share) / ks
                add_slip(slip, c, left * tx, left * ty, left * tz)
                tx, ty, tz = share * tx, share * ty, share * tz
        force[c, 0] = area[c] * (sigma * nx + tx)
        force[c, 1] = area[c] * (sigma * ny + ty)
        force[c, 2] = area[c] * (sigma * nz + tz)


_sweep_serial = jit(_sweep)
_sweep_parallel = jit_parallel(_sweep)


@jit
def sweep(parallel, shape, interface, state, first, last, sides, normal, area, u, force):
    """One contact group; `parallel` is None or True, and only the version that is used gets compiled."""
    if parallel is None:
        _sweep_serial(
            shape, interface, first, last, sides, normal, area, u, force, state.opening_max, state.intact_n,
            state.intact_s, state.slip, state.spent, state.uplift, state.gap, state.run,
        )  # fmt: skip
    else:
        _sweep_parallel(
            shape, interface, first, last, sides, normal, area, u, force, state.opening_max, state.intact_n,
            state.intact_s, state.slip, state.spent, state.uplift, state.gap, state.run,
        )  # fmt: skip


@jit
def observe(shape, interface, state, first, last, sides, normal, area, u, force, seen):
    """Fill seen[c] = opening, slip, sigma, tau, and return the stored energy (J) of the group.

    Stresses come from the force that acts; opening, slip and stored energy from displacements and state.
    """
    energy, ks = 0.0, interface.shear_stiffness
    for c in range(first, last):
        nx, ny, nz = normal[c, 0], normal[c, 1], normal[c, 2]
        opening, sx, sy, sz = relative(u, sides[c, 0], sides[c, 1], nx, ny, nz)
        px, py, pz = plastic_slip(state.slip, c)
        tau_squared = ks * ks * ((sx - px) ** 2 + (sy - py) ** 2 + (sz - pz) ** 2)
        memory = Memory(
            recall(state.opening_max, c), recall(state.intact_n, c), recall(state.intact_s, c),
            recall(state.uplift, c), recall(state.gap, c), recall(state.run, c),
        )  # fmt: skip
        energy += area[c] * stored(shape, interface, memory, opening, tau_squared)
        sigma = (force[c, 0] * nx + force[c, 1] * ny + force[c, 2] * nz) / area[c]
        fx, fy, fz = force[c, 0] / area[c], force[c, 1] / area[c], force[c, 2] / area[c]
        seen[c, 0] = opening
        seen[c, 1] = sqrt(sx * sx + sy * sy + sz * sz)
        seen[c, 2] = sigma
        seen[c, 3] = sqrt((fx - sigma * nx) ** 2 + (fy - sigma * ny) ** 2 + (fz - sigma * nz) ** 2)
    return energy
