"""The sweep over contact points: relative displacement in, force out. Knows neither kinematics nor any law's formula."""

from numba import prange

from masonry.kernels.compiler import jit, jit_parallel
from masonry.laws.mechanism import respond, stored


def _sweep(shape, interface, state, first, last, sides, normal, area, u, force):
    """Contacts first..last: d = u_b - u_a, split along n; force[c] acts on side a, its opposite on side b."""
    for c in prange(first, last):
        a, b = sides[c, 0], sides[c, 1]
        dx, dy, dz = u[b, 0] - u[a, 0], u[b, 1] - u[a, 1], u[b, 2] - u[a, 2]
        nx, ny, nz = normal[c, 0], normal[c, 1], normal[c, 2]
        opening = dx * nx + dy * ny + dz * nz
        slip_x, slip_y, slip_z = dx - opening * nx, dy - opening * ny, dz - opening * nz
        sigma, tau_x, tau_y, tau_z = respond(shape, interface, c, opening, slip_x, slip_y, slip_z, state)
        force[c, 0] = area[c] * (sigma * nx + tau_x)
        force[c, 1] = area[c] * (sigma * ny + tau_y)
        force[c, 2] = area[c] * (sigma * nz + tau_z)


_sweep_serial = jit(_sweep)
_sweep_parallel = jit_parallel(_sweep)


@jit
def sweep(parallel, shape, interface, state, first, last, sides, normal, area, u, force):
    """One contact group; `parallel` is None or True, and only the version that is used gets compiled."""
    if parallel is None:
        _sweep_serial(shape, interface, state, first, last, sides, normal, area, u, force)
    else:
        _sweep_parallel(shape, interface, state, first, last, sides, normal, area, u, force)


@jit
def observe(shape, interface, state, first, last, sides, normal, area, u, force, seen):
    """Fill seen[c] = opening, slip, sigma, tau, and return the stored energy (J) of the group.

    Stresses come from the force that acts; opening, slip and stored energy from displacements and state.
    """
    energy = 0.0
    for c in range(first, last):
        a, b = sides[c, 0], sides[c, 1]
        dx, dy, dz = u[b, 0] - u[a, 0], u[b, 1] - u[a, 1], u[b, 2] - u[a, 2]
        nx, ny, nz = normal[c, 0], normal[c, 1], normal[c, 2]
        opening = dx * nx + dy * ny + dz * nz
        sx, sy, sz = dx - opening * nx, dy - opening * ny, dz - opening * nz
        energy += area[c] * stored(shape, interface, c, opening, sx, sy, sz, state)
        sigma = (force[c, 0] * nx + force[c, 1] * ny + force[c, 2] * nz) / area[c]
        tx = force[c, 0] / area[c] - sigma * nx
        ty = force[c, 1] / area[c] - sigma * ny
        tz = force[c, 2] / area[c] - sigma * nz
        seen[c, 0] = opening
        seen[c, 1] = (sx * sx + sy * sy + sz * sz) ** 0.5
        seen[c, 2] = sigma
        seen[c, 3] = (tx * tx + ty * ty + tz * tz) ** 0.5
    return energy
