"""Contact points that are held while their pair has hardly moved: material points of both bodies.

A held point is one point of each body, on the faces that touch. Its gap is measured along the normal, which turns with
both bodies; it lies midway between its two points, where both bodies feel its force, so that no couple is left over.
"""

from math import sqrt

from masonry.detection.bare import bare, inlined
from masonry.detection.narrow import EDGE, MOVED

QUIET = 0.01
"""Of the skin: motion after which two pieces that touch nowhere are looked at again, however near they are."""


@bare
def hold_point(x, y, z, position, frame, cof, arm):
    """Write the material point (3,) of a body at (x, y, z) into arm; cof is the cofactor matrix of its frame."""
    x, y, z = x - position[0], y - position[1], z - position[2]
    size = frame[0, 0] * cof[0, 0] + frame[0, 1] * cof[0, 1] + frame[0, 2] * cof[0, 2]
    for k in range(3):
        arm[k] = (cof[0, k] * x + cof[1, k] * y + cof[2, k] * z) / size


@bare
def hold_points(point, gap, count, axis, i, j, position, frame, cof, arm_a, arm_b):
    """Material points of bodies i and j for `count` points as `touch` gives them, into arm_a, arm_b (K, 3).

    position (N, 3) m; frame, cof (N, 3, 3): how the bodies are turned, and its cofactor (the same array where rigid)
    """
    nx, ny, nz = axis[0], axis[1], axis[2]
    for k in range(count):
        x, y, z, half = point[k, 0], point[k, 1], point[k, 2], 0.5 * gap[k]
        hold_point(x - half * nx, y - half * ny, z - half * nz, position[i], frame[i], cof[i], arm_a[k])
        hold_point(x + half * nx, y + half * ny, z + half * nz, position[j], frame[j], cof[j], arm_b[k])


@bare
def hold_axis(pieces, witness, axis, frame_a, frame_b, normal_a, normal_b):
    """The normal as each body carries it, into normal_a, normal_b (3,): of their faces; of crossed edges the axis."""
    if witness[0] == EDGE:
        for k in range(3):
            normal_a[k] = frame_a[0, k] * axis[0] + frame_a[1, k] * axis[1] + frame_a[2, k] * axis[2]
            normal_b[k] = frame_b[0, k] * axis[0] + frame_b[1, k] * axis[1] + frame_b[2, k] * axis[2]
    else:
        normal = pieces.normal
        for k in range(3):
            normal_a[k], normal_b[k] = normal[witness[1], k], -normal[witness[2], k]


@inlined
def present_axis(cof_a, cof_b, normal_a, normal_b, blend):
    """The normal of a held pair now, a unit vector; of affine blocks the shares weigh normals times their stretch."""
    nx = ny = nz = 0.0
    if blend > 0.0:
        x, y, z = blend * normal_a[0], blend * normal_a[1], blend * normal_a[2]
        nx = cof_a[0, 0] * x + cof_a[0, 1] * y + cof_a[0, 2] * z
        ny = cof_a[1, 0] * x + cof_a[1, 1] * y + cof_a[1, 2] * z
        nz = cof_a[2, 0] * x + cof_a[2, 1] * y + cof_a[2, 2] * z
    if blend < 1.0:
        x, y, z = (1.0 - blend) * normal_b[0], (1.0 - blend) * normal_b[1], (1.0 - blend) * normal_b[2]
        nx += cof_b[0, 0] * x + cof_b[0, 1] * y + cof_b[0, 2] * z
        ny += cof_b[1, 0] * x + cof_b[1, 1] * y + cof_b[1, 2] * z
        nz += cof_b[2, 0] * x + cof_b[2, 1] * y + cof_b[2, 2] * z
    share = 1.0 / sqrt(nx * nx + ny * ny + nz * nz)
    return share * nx, share * ny, share * nz


@inlined
def present_points(i, j, position, frame, nx, ny, nz, first, last, arm_a, arm_b, born, point, gap):
    """Where the held points first..last of bodies i and j are now: point (C, 3) m and gap (C,) m along n.

    arm_a, arm_b (C, 3) m, born (C,) m: as they were held, and the gap then. Returns the square (m2) of the most that
    the two sides of a point have moved against each other since.
    """
    a, b, c = frame[i, 0, 0], frame[i, 0, 1], frame[i, 0, 2]
    d, e, f = frame[i, 1, 0], frame[i, 1, 1], frame[i, 1, 2]
    g, h, o = frame[i, 2, 0], frame[i, 2, 1], frame[i, 2, 2]
    p, q, r = frame[j, 0, 0], frame[j, 0, 1], frame[j, 0, 2]
    s, t, u = frame[j, 1, 0], frame[j, 1, 1], frame[j, 1, 2]
    v, w, m = frame[j, 2, 0], frame[j, 2, 1], frame[j, 2, 2]
    ix, iy, iz = position[i, 0], position[i, 1], position[i, 2]
    jx, jy, jz = position[j, 0] - ix, position[j, 1] - iy, position[j, 2] - iz
    ix, iy, iz = ix + 0.5 * jx, iy + 0.5 * jy, iz + 0.5 * jz
    moved = 0.0
    for k in range(first, last):
        x, y, z = arm_a[k, 0], arm_a[k, 1], arm_a[k, 2]
        ax, ay, az = a * x + b * y + c * z, d * x + e * y + f * z, g * x + h * y + o * z
        x, y, z = arm_b[k, 0], arm_b[k, 1], arm_b[k, 2]
        bx, by, bz = p * x + q * y + r * z, s * x + t * y + u * z, v * x + w * y + m * z
        x, y, z = bx - ax + jx, by - ay + jy, bz - az + jz
        apart, then = nx * x + ny * y + nz * z, born[k]
        gap[k] = apart
        point[k, 0] = ix + 0.5 * (ax + bx)
        point[k, 1] = iy + 0.5 * (ay + by)
        point[k, 2] = iz + 0.5 * (az + bz)
        square = x * x + y * y + z * z + then * (then - 2.0 * apart)  # of what is left without n times the gap of then
        moved = square if square > moved else moved
    return moved


@bare
def present_pairs(
    body_a, body_b, start, count, normal_a, normal_b, blend, size, arm_a, arm_b, born,
    position, frame, cof, axis, point, gap, stale,
):  # fmt: skip
    """`present_axis` and `present_points` of M pairs, whose points are start[m]..start[m] + count[m].

    body_a, body_b, start, count, blend, size (M,), normal_a, normal_b (M, 3): as held. Writes axis (M, 3), point, gap,
    and stale (M,): whether a pair must be clipped anew. Returns how many must.
    """
    found = 0
    for m in range(len(start)):
        i, j = body_a[m], body_b[m]
        nx, ny, nz = present_axis(cof[i], cof[j], normal_a[m], normal_b[m], blend[m])
        axis[m, 0], axis[m, 1], axis[m, 2] = nx, ny, nz
        moved = present_points(
            i, j, position, frame, nx, ny, nz, start[m], start[m] + count[m], arm_a, arm_b, born, point, gap
        )
        stale[m] = has_moved(moved, size[m])
        found += stale[m]
    return found


@inlined
def has_moved(moved, size):
    """Whether a pair that moved (m2, as `present_points` returns it) must be clipped anew; size (m) as `touch` says."""
    return moved > MOVED * MOVED * size * size


@bare
def quiet_distance(separation, skin):
    """How far (m) the bodies of a pair that touches nowhere may move against each other until it is looked at again."""
    return max(separation, QUIET * skin)
