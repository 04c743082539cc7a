"""Hand-written contacts: what the same work costs with nothing general about it, on flat padded rows.

Rows of u and force are padded to four; ends (C, 2) are unsigned rows of u; frame (C, 4) is the normal and the area.
"""

from functools import cache
from math import exp, sqrt

import numba

from masonry.jit.compiler import OPTIONS

compiled = numba.njit(**OPTIONS | {"cache": False})


@cache
def shoving(contacts):
    """Moves side b of every contact by by[c] and sweeps over the contacts (or not), round after round."""

    @compiled
    def shove(rounds, by, sweeps, law, ends, frame, u, force, past, slip, dissipated):
        for _ in range(rounds):
            for c in range(len(by)):
                b = ends[c, 1]
                u[b, 0] += by[c, 0]
                u[b, 1] += by[c, 1]
                u[b, 2] += by[c, 2]
            if sweeps:
                contacts(law, ends, frame, u, force, past, slip, dissipated)

    return shove


@compiled
def elastic(law, ends, frame, u, force, past, slip, dissipated):
    """Eqs (5) and (6): no history."""
    kn, ks = law[0], law[1]
    for c in range(len(frame)):
        a, b = ends[c, 0], ends[c, 1]
        nx, ny, nz, area = frame[c, 0], frame[c, 1], frame[c, 2], frame[c, 3]
        dx, dy, dz = u[b, 0] - u[a, 0], u[b, 1] - u[a, 1], u[b, 2] - u[a, 2]
        e = dx * nx + dy * ny + dz * nz
        normal = (kn - ks) * e
        force[c, 0] = area * (normal * nx + ks * dx)
        force[c, 1] = area * (normal * ny + ks * dy)
        force[c, 2] = area * (normal * nz + ks * dz)


def softening(curved: bool):
    """Eqs (5) to (8), secant unloading, combined loss, energies booked, history written on change.

    curved        softens by eqs (16) and (17); else all is lost at once
    past (C, 4)   largest opening, shares left in tension and in shear, and the secant stiffness that follows from them
    """

    @compiled
    def contacts(law, ends, frame, u, force, past, slip, dissipated):
        kn, ks, ft, c0, tan0, cr, tanr, g1, g2 = law
        un0, steep, fall, soft = ft / kn, -ft / g1, -c0 / g2, 1.0 / ks
        for c in range(len(frame)):
            a, b = ends[c, 0], ends[c, 1]
            nx, ny, nz, area = frame[c, 0], frame[c, 1], frame[c, 2], frame[c, 3]
            dx, dy, dz = u[b, 0] - u[a, 0], u[b, 1] - u[a, 1], u[b, 2] - u[a, 2]
            e = dx * nx + dy * ny + dz * nz
            sx, sy, sz = dx - e * nx, dy - e * ny, dz - e * nz
            tx, ty, tz = ks * (sx - slip[c, 0]), ks * (sy - slip[c, 1]), ks * (sz - slip[c, 2])
            squared = tx * tx + ty * ty + tz * tz
            opened, dn, ds = past[c, 0], past[c, 1], past[c, 2]
            sigma = e * (kn if e <= 0.0 else past[c, 3])
            stays = cr if e <= 0.0 or dn == 1.0 else cr * (1.0 - (1.0 - dn) * min(e / opened, 1.0))
            rest = max(stays - sigma * tanr, 0.0)
            peak = max(c0 - sigma * tan0, rest)
            most = rest + ds * dn * (peak - rest)
            if squared > most * most or e > opened:
                first = 0.0
                if e > opened:
                    left = min(dn, exp(steep * (e - un0))) if curved else 0.0
                    first = ds * (g1 * (dn - left) - 0.5 * ft * (left * e - dn * opened))
                    opened, dn = e, left
                    sigma = ds * dn * ft
                    rest = max(cr * dn - sigma * tanr, 0.0)
                    peak = max(c0 - sigma * tan0, rest)
                tau = sqrt(squared)
                most = rest + ds * dn * (peak - rest)
                if tau > most:
                    beyond = sqrt(sx * sx + sy * sy + sz * sz) - peak * soft
                    whole = ds
                    if beyond > 0.0 and peak > rest:
                        whole = min(ds, exp(fall * beyond)) if curved else 0.0
                        if e > 0.0:
                            first += 0.5 * dn * ft * e * e / opened * (ds - whole)
                        ds = whole
                    yielded = rest + ds * dn * (peak - rest)
                    fraction = yielded / tau
                    path = (tau - yielded) * soft
                    dissipated[c, 1] += path * 0.5 * (most + yielded - 2.0 * rest)
                    dissipated[c, 2] += path * rest
                    left = (1.0 - fraction) * soft
                    slip[c, 0] += left * tx
                    slip[c, 1] += left * ty
                    slip[c, 2] += left * tz
                    tx, ty, tz = fraction * tx, fraction * ty, fraction * tz
                dissipated[c, 0] += first
                secant = dn * ds * ft / opened
                sigma = e * (kn if e <= 0.0 else secant)
                past[c, 0], past[c, 1], past[c, 2], past[c, 3] = opened, dn, ds, secant
            force[c, 0] = area * (sigma * nx + tx)
            force[c, 1] = area * (sigma * ny + ty)
            force[c, 2] = area * (sigma * nz + tz)

    return contacts


exponential, brittle = softening(True), softening(False)
