"""Shear tractions carried from the points of a patch to those of the patch that it has become.

Each point stands for the quarter of the patch beside it: between centroid, corner and the middles of its two edges,
whose area is that of corners.py. Tractions are constant there, and go over by the areas that old and new regions share:
the L2 projection. As a mean of what came, it cannot add to sum area |tau|^2 / (2 k_s); force is kept where the old
patch is covered by the new one, and area that is new starts at 0. A point inside (spread.py) stands for the quarter of
its corner, with its own share of the area: what corners hold goes to corners, what points inside hold to points inside.
"""

from math import cos, sin, sqrt

from masonry.detection.clip import area_and_centroid
from masonry.detection.corners import region, region_area, shared_area
from masonry.detection.spread import layers
from masonry.jit.compiler import inner, jit

TURNED_OVER = -0.5
"""Cosine between two normals that are 120 degrees apart."""
SAME = 1e-12
"""Of an area: points of one name and area are the same."""


@jit
def turn_tractions(tau, count, n, axis, spin):
    """Turn tractions (K, 3) by the least rotation from n (3,) to axis (3,), then about it by spin (rad); norms stay.

    Where the normal has turned over, two blocks meet from another side: tractions begin anew, at 0.
    """
    vx, vy, vz = n[1] * axis[2] - n[2] * axis[1], n[2] * axis[0] - n[0] * axis[2], n[0] * axis[1] - n[1] * axis[0]
    c = n[0] * axis[0] + n[1] * axis[1] + n[2] * axis[2]
    if c < TURNED_OVER:
        tau[:count] = 0.0
        return
    fraction = 1.0 / (1.0 + c)
    ax, ay, az, cosine, sine = axis[0], axis[1], axis[2], cos(spin), sin(spin)
    for k in range(count):
        x, y, z = tau[k, 0], tau[k, 1], tau[k, 2]
        along = fraction * (vx * x + vy * y + vz * z)
        x, y, z = (
            c * x + vy * z - vz * y + along * vx,
            c * y + vz * x - vx * z + along * vy,
            c * z + vx * y - vy * x + along * vz,
        )
        along = (1.0 - cosine) * (ax * x + ay * y + az * z)
        tau[k, 0] = cosine * x + sine * (ay * z - az * y) + along * ax
        tau[k, 1] = cosine * y + sine * (az * x - ax * z) + along * ay
        tau[k, 2] = cosine * z + sine * (ax * y - ay * x) + along * az


@jit
def transfer(
    point, area, feature, tau, count, new_point, new_area, new_feature, new_tau, new_count, axis, scratch
):  # fmt: skip
    """Write the tractions of the new points into new_tau (K, 3) Pa; returns the loss in Pa2 m2: k_s times the energy.

    point, area, feature, tau    (K, 3) m where the old points are now, (K,) m2, (K,), (K, 3) Pa turned already
    new_point, ...               as `touch` gives them; axis (3,) their normal
    """
    before = energy(area, tau, count)
    if _same(area, feature, count, new_area, new_feature, new_count):
        for k in range(count):
            new_tau[k, 0], new_tau[k, 1], new_tau[k, 2] = tau[k, 0], tau[k, 1], tau[k, 2]
        return before - energy(new_area, new_tau, new_count)
    for k in range(new_count):
        new_tau[k, 0] = new_tau[k, 1] = new_tau[k, 2] = 0.0
    rounds = min(layers(feature, count), layers(new_feature, new_count))
    if not _by_regions(
        point, area, tau, count // rounds, new_point, new_area, new_tau, new_count // rounds, rounds, axis,
        scratch.u, scratch.v, scratch.label, scratch.weight, scratch.wu, scratch.wv, scratch.edge_u, scratch.edge_v,
    ):  # fmt: skip
        for k in range(new_count):
            for i in range(count):
                _give(tau, i, new_tau, k, min(area[i] / new_count, new_area[k] / count))
    for k in range(new_count):
        scale = 1.0 / new_area[k] if new_area[k] > 0.0 else 0.0
        for x in range(3):
            new_tau[k, x] *= scale
    return before - energy(new_area, new_tau, new_count)


@jit
def energy(area, tau, count):
    """Sum area |tau|^2 / 2 of `count` points, Pa2 m2."""
    total = 0.0
    for k in range(count):
        total += 0.5 * area[k] * (tau[k, 0] * tau[k, 0] + tau[k, 1] * tau[k, 1] + tau[k, 2] * tau[k, 2])
    return total


@inner
def _same(area, feature, count, new_area, new_feature, new_count):
    """Whether the new points have the names and areas of the old ones, in this order."""
    same = count == new_count
    if same:
        for k in range(count):
            same = same and feature[k] == new_feature[k] and abs(area[k] - new_area[k]) <= SAME * area[k]
    return same


@inner
def _give(tau, i, new_tau, k, part):
    """An area (m2) of old point i goes to new point k."""
    for x in range(3):
        new_tau[k, x] += part * tau[i, x]


@inner
def _by_regions(
    point, area, tau, count, new_point, new_area, new_tau, new_count, rounds, axis,
    u, v, label, height, wu, wv, eu, ev,
):  # fmt: skip
    """Add the forces (N) that go over with the shared areas to new_tau; False where a patch has no area of its own.
    count, new_count: of corners, in each round of points."""
    if count < 3 or new_count < 3:
        return False
    _flatten(new_point, new_count, new_point, axis, eu, ev, 1)
    _flatten(point, count, new_point, axis, eu, ev, 0)
    whole, nu, nv = area_and_centroid(eu, ev, 1, new_count)
    if whole <= 0.0:  # the points run round the other way: seen from the other side
        for k in range(max(count, new_count)):
            ev[0, k], ev[1, k] = -ev[0, k], -ev[1, k]
        whole, nu, nv = area_and_centroid(eu, ev, 1, new_count)
    old, ou, ov = area_and_centroid(eu, ev, 0, count)
    if whole <= 0.0 or old <= 0.0:
        return False
    for i in range(count):
        old_region = region(eu, ev, 0, count, ou, ov, i)
        if region_area(old_region) <= 0.0:
            continue
        for k in range(new_count):
            theirs = region(eu, ev, 1, new_count, nu, nv, k)
            if region_area(theirs) > 0.0:
                shared = shared_area(old_region, theirs, u, v, label, height, wu, wv)
                for r in range(rounds if shared > 0.0 else 0):
                    j, m = r * count + i, r * new_count + k
                    fraction = min(area[j] / region_area(old_region), new_area[m] / region_area(theirs))
                    _give(tau, j, new_tau, m, shared * fraction)
    return True


@inner
def _flatten(point, count, origin, axis, eu, ev, row):
    """Points in axes across the normal, from the first point of origin, into a row of eu, ev."""
    nx, ny, nz = axis[0], axis[1], axis[2]
    if abs(nx) <= abs(ny) and abs(nx) <= abs(nz):
        sx, sy, sz = 0.0, nz, -ny
    elif abs(ny) <= abs(nz):
        sx, sy, sz = -nz, 0.0, nx
    else:
        sx, sy, sz = ny, -nx, 0.0
    scale = 1.0 / sqrt(sx * sx + sy * sy + sz * sz)
    sx, sy, sz = scale * sx, scale * sy, scale * sz
    tx, ty, tz = ny * sz - nz * sy, nz * sx - nx * sz, nx * sy - ny * sx
    for k in range(count):
        x, y, z = point[k, 0] - origin[0, 0], point[k, 1] - origin[0, 1], point[k, 2] - origin[0, 2]
        eu[row, k], ev[row, k] = sx * x + sy * y + sz * z, tx * x + ty * y + tz * z
