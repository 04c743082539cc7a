"""Hand-written reference kernels: what the same work costs with nothing general about it."""

from math import sqrt

import numpy as np

from masonry.kernels.compiler import jit


@jit
def elastic_contacts(kn, ks, sides, normal, area, u, force):
    """Eqs (5) and (6) on flat arrays, one loop, no law, no history."""
    for c in range(len(area)):
        a, b = sides[c, 0], sides[c, 1]
        dx, dy, dz = u[b, 0] - u[a, 0], u[b, 1] - u[a, 1], u[b, 2] - u[a, 2]
        nx, ny, nz = normal[c, 0], normal[c, 1], normal[c, 2]
        opening = dx * nx + dy * ny + dz * nz
        sigma = kn * opening
        force[c, 0] = area[c] * (sigma * nx + ks * (dx - opening * nx))
        force[c, 1] = area[c] * (sigma * ny + ks * (dy - opening * ny))
        force[c, 2] = area[c] * (sigma * nz + ks * (dz - opening * nz))


@jit
def exponential_contacts(kn, ks, fT, c0, tan0, tanr, GI, GII, sides, normal, area, u, force, opened, whole, slip):
    """Exponential law written out by hand for one group: secant, combined coupling, no energies."""
    for c in range(len(area)):
        a, b = sides[c, 0], sides[c, 1]
        dx, dy, dz = u[b, 0] - u[a, 0], u[b, 1] - u[a, 1], u[b, 2] - u[a, 2]
        nx, ny, nz = normal[c, 0], normal[c, 1], normal[c, 2]
        e = dx * nx + dy * ny + dz * nz
        sx, sy, sz = dx - e * nx, dy - e * ny, dz - e * nz
        if e > opened[c]:
            opened[c] = e
            whole[c, 0] = np.exp(-fT / GI * (e - fT / kn))
        sigma = kn * e if e <= 0.0 else whole[c, 0] * whole[c, 1] * fT * e / opened[c]
        tx, ty, tz = ks * (sx - slip[c, 0]), ks * (sy - slip[c, 1]), ks * (sz - slip[c, 2])
        peak, rest = max(c0 - sigma * tan0, 0.0), max(-sigma * tanr, 0.0)
        tau = sqrt(tx * tx + ty * ty + tz * tz)
        if tau > rest + whole[c, 0] * whole[c, 1] * (peak - rest):
            beyond = sqrt(sx * sx + sy * sy + sz * sz) - peak / ks
            if beyond > 0.0:
                whole[c, 1] = min(whole[c, 1], np.exp(-c0 / GII * beyond))
            share = (rest + whole[c, 0] * whole[c, 1] * (peak - rest)) / tau
            slip[c, 0] += (1.0 - share) * tx / ks
            slip[c, 1] += (1.0 - share) * ty / ks
            slip[c, 2] += (1.0 - share) * tz / ks
            tx, ty, tz = share * tx, share * ty, share * tz
        force[c, 0] = area[c] * (sigma * nx + tx)
        force[c, 1] = area[c] * (sigma * ny + ty)
        force[c, 2] = area[c] * (sigma * nz + tz)
