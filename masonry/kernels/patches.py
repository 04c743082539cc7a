"""Patches: contacts that are detected, press and slide with friction, and have no strength.

A point of a patch is a material point of one of the two blocks; the plane that it meets is fixed in the other, the
reference. Its gap is measured from that geometry at every step, never summed up. The force acts on both blocks at this
one point: as the plane turns with the reference, the rate of the gap is the velocity of the point less that of the
reference at the same place, so the springs are conservative and no couple is left.
"""

from math import sqrt
from typing import NamedTuple

import numpy as np

from masonry.detection.bare import bare, inlined
from masonry.kernels.planes import plane_of, turned

FRICTION, DASHPOT, SHEAR_LOST, NORMAL_GAINED, BORN = range(5)
"""Of the account (J): dissipated by friction and by dashpots; lost as shear went to new points; gained as the areas of
points that press changed, and by points that were born pressing."""


class Pairs(NamedTuple):
    """Pairs of convex pieces that are near to each other, sorted; there is room for more than there are.

    number    (1,) how many there are; the arrays below have a row for each
    piece     (P, 2) numbers of the pieces, the lower first     body  (P, 2) their blocks
    slot      (P,) where its points are kept; -1 where the two are apart
    points_of (P,) which side the points belong to (0, 1); the plane is fixed in the other one, the reference
    normal    (P, 3) of the plane, from side 0 to side 1, in the frame of the reference
    axis      (P, 3) the same at the last look, in space     witness (P, 3) of that look (detection/narrow.py)
    mark      (P,) m, travel of both blocks at the last look     limit  (P,) m, travel until the next one
    law       (P,) row of Rules    dashpot (P,) Pa s/m
    """

    number: np.ndarray
    piece: np.ndarray
    body: np.ndarray
    slot: np.ndarray
    points_of: np.ndarray
    normal: np.ndarray
    axis: np.ndarray
    witness: np.ndarray
    mark: np.ndarray
    limit: np.ndarray
    law: np.ndarray
    dashpot: np.ndarray


class Points(NamedTuple):
    """Points of the pairs that touch, or nearly: S slots of up to K points, and which slots are free.

    held     (S,) points of a slot
    material (S, K, 3) m, from the centroid of the block that they belong to, in its frame
    level    (S, K) m, of the plane that the point meets, along the normal from the centroid of the reference
    area     (S, K) m2       feature (S, K) names
    shear    (S, K, 3) Pa, elastic shear traction on side 0, in space
    damper   (S, K) Pa, stress of the dashpot at the last step
    free     (S + 1,) the last number is how many slots are free, the first ones which
    """

    held: np.ndarray
    material: np.ndarray
    level: np.ndarray
    area: np.ndarray
    feature: np.ndarray
    shear: np.ndarray
    damper: np.ndarray
    free: np.ndarray


class Rules(NamedTuple):
    """What two groups of blocks do where they meet, (R,) each: Pa/m, Pa/m, tangent, share of critical damping."""

    normal_stiffness: np.ndarray
    shear_stiffness: np.ndarray
    tan_friction: np.ndarray
    dashpot: np.ndarray


class Motion(NamedTuple):
    """How B blocks stand and move: rigid ones, or with `dual` and what follows blocks of which some deform.

    centre  (B, 3) m, centroids of the undeformed shape     moved (B, 6) m, the first three: how far they are from there
    frame   (B, 3, 3) rotation from the start, or deformation gradient F
    v       (B, 6) velocity and spin about x, y, z
    push    (B, 6) out: force and moment about the centroid; (B, 12) force and first moments where blocks deform
    radius  (B,) m, of the sphere about the centroid that holds the block
    travel  (B,) m, bound of how far any point has moved so far
    dual    (B, 3, 3) F^-T, which carries normals; None where all blocks are rigid, and so are the next two
    rate    (B, 3, 3) 1/s, F'
    strain  (B,) 1/s, norm of the rate of stretching: the symmetric part of F' F^-1
    """

    centre: np.ndarray
    moved: np.ndarray
    frame: np.ndarray
    v: np.ndarray
    push: np.ndarray
    radius: np.ndarray
    travel: np.ndarray
    dual: np.ndarray | None = None
    rate: np.ndarray | None = None
    strain: np.ndarray | None = None


@bare
def press(near, dt):
    """Forces and moments of all points of all patches into motion.push, from their gaps and the slip of this step.

    near is what redetection.Near says; its account gets what friction and the dashpots dissipate.
    """
    pairs, points, rules, motion, account = near.pairs, near.points, near.rules, near.motion, near.account
    centre, moved, frame, v, push = motion.centre, motion.moved, motion.frame, motion.v, motion.push
    body, slot, points_of, normal = pairs.body, pairs.slot, pairs.points_of, pairs.normal
    law, dashpot, count = pairs.law, pairs.dashpot, points.held
    material, level, area, shear, damper = points.material, points.level, points.area, points.shear, points.damper
    friction = damped = 0.0
    for b in range(len(push)):
        for i in range(6):
            push[b, i] = 0.0
    for p in range(pairs.number[0]):
        s = slot[p]
        if s < 0:
            continue
        own = points_of[p]
        ref, other = body[p, 1 - own], body[p, own]
        kn, ks, tan = rules.normal_stiffness[law[p]], rules.shear_stiffness[law[p]], rules.tan_friction[law[p]]
        side = 1.0 if own == 1 else -1.0  # the normal points from side 0 to side 1
        nx, ny, nz = turned(frame, ref, normal[p, 0], normal[p, 1], normal[p, 2])
        ox, oy, oz = (  # the sums of the places would lose digits far from the origin
            (centre[other, 0] - centre[ref, 0]) + (moved[other, 0] - moved[ref, 0]),
            (centre[other, 1] - centre[ref, 1]) + (moved[other, 1] - moved[ref, 1]),
            (centre[other, 2] - centre[ref, 2]) + (moved[other, 2] - moved[ref, 2]),
        )
        wx, wy, wz = 0.5 * (v[ref, 3] + v[other, 3]), 0.5 * (v[ref, 4] + v[other, 4]), 0.5 * (v[ref, 5] + v[other, 5])
        fx = fy = fz = rx = ry = rz = qx = qy = qz = 0.0
        for k in range(count[s]):
            ax, ay, az = turned(frame, other, material[s, k, 0], material[s, k, 1], material[s, k, 2])
            bx, by, bz = ax + ox, ay + oy, az + oz
            gap = side * (nx * bx + ny * by + nz * bz - level[s, k])
            # velocity of side 1 against side 0 at the point
            dx = v[other, 0] - v[ref, 0] + v[other, 4] * az - v[other, 5] * ay - v[ref, 4] * bz + v[ref, 5] * by
            dy = v[other, 1] - v[ref, 1] + v[other, 5] * ax - v[other, 3] * az - v[ref, 5] * bx + v[ref, 3] * bz
            dz = v[other, 2] - v[ref, 2] + v[other, 3] * ay - v[other, 4] * ax - v[ref, 3] * by + v[ref, 4] * bx
            dx, dy, dz = side * dx, side * dy, side * dz
            rate = dx * nx + dy * ny + dz * nz
            sigma = kn * min(gap, 0.0)
            if dashpot[p] > 0.0:  # its work by the trapezoid, as that of all forces on the blocks
                now = min(dashpot[p] * rate, -sigma) if gap < 0.0 else 0.0
                damped += 0.5 * (now + damper[s, k]) * rate * dt * area[s, k]
                damper[s, k] = now
                sigma += now
            hx, hy, hz = turned_with(shear, s, k, wx * dt, wy * dt, wz * dt, nx, ny, nz)
            sx, sy, sz = dt * (dx - rate * nx), dt * (dy - rate * ny), dt * (dz - rate * nz)
            tx, ty, tz, taken = slide(hx, hy, hz, sx, sy, sz, ks, -tan * sigma)
            friction += taken * area[s, k]
            if gap >= 0.0:
                shear[s, k, 0] = shear[s, k, 1] = shear[s, k, 2] = 0.0
                continue
            shear[s, k, 0], shear[s, k, 1], shear[s, k, 2] = tx, ty, tz
            gx = area[s, k] * (sigma * nx + tx)
            gy = area[s, k] * (sigma * ny + ty)
            gz = area[s, k] * (sigma * nz + tz)
            fx, fy, fz = fx + gx, fy + gy, fz + gz
            rx, ry, rz = rx + by * gz - bz * gy, ry + bz * gx - bx * gz, rz + bx * gy - by * gx
            qx, qy, qz = qx + ay * gz - az * gy, qy + az * gx - ax * gz, qz + ax * gy - ay * gx
        add(push, ref, side, fx, fy, fz, rx, ry, rz)
        add(push, other, -side, fx, fy, fz, qx, qy, qz)
    account[FRICTION] += friction
    account[DASHPOT] += damped


@inlined
def slide(hx, hy, hz, sx, sy, sz, ks, most):
    """The shear traction (Pa), no more than `most`, after a slip s (m) from h; and what friction took (J/m2): what the
    trapezoid puts in, less what the springs then hold more."""
    tx, ty, tz = hx + ks * sx, hy + ks * sy, hz + ks * sz
    trial = sqrt(tx * tx + ty * ty + tz * tz)
    if trial <= most:
        return tx, ty, tz, 0.0
    fraction = most / trial
    tx, ty, tz = fraction * tx, fraction * ty, fraction * tz
    put_in = (hx + tx) * sx + (hy + ty) * sy + (hz + tz) * sz
    held = (most * most - hx * hx - hy * hy - hz * hz) / ks
    return tx, ty, tz, 0.5 * (put_in - held)


@bare
def turned_with(shear, s, k, wx, wy, wz, nx, ny, nz):
    """The shear traction of a point after a turn (rad) of the two blocks: in the plane, and of the same size."""
    x, y, z = shear[s, k, 0], shear[s, k, 1], shear[s, k, 2]
    before = x * x + y * y + z * z
    if before == 0.0:
        return 0.0, 0.0, 0.0
    x, y, z = x + wy * z - wz * y, y + wz * x - wx * z, z + wx * y - wy * x
    along = x * nx + y * ny + z * nz
    x, y, z = x - along * nx, y - along * ny, z - along * nz
    after = x * x + y * y + z * z
    if after == 0.0:
        return 0.0, 0.0, 0.0
    share = sqrt(before / after)
    return share * x, share * y, share * z


@bare
def add(push, b, side, fx, fy, fz, mx, my, mz):
    """Add a force and its moment, times a sign, to what a block is pushed by."""
    push[b, 0] += side * fx
    push[b, 1] += side * fy
    push[b, 2] += side * fz
    push[b, 3] += side * mx
    push[b, 4] += side * my
    push[b, 5] += side * mz


@bare
def stored(pairs, points, rules, motion, p):
    """Elastic energies (J) of the points of a pair as they stand: normal, and shear."""
    pressed, sheared, s = 0.0, 0.0, pairs.slot[p]
    kn, ks = rules.normal_stiffness[pairs.law[p]], rules.shear_stiffness[pairs.law[p]]
    for k in range(points.held[s] if s >= 0 else 0):
        gap = gap_of(pairs, points, motion, p, k)
        if gap < 0.0:
            x, y, z = points.shear[s, k, 0], points.shear[s, k, 1], points.shear[s, k, 2]
            pressed += 0.5 * points.area[s, k] * kn * gap * gap
            sheared += 0.5 * points.area[s, k] * (x * x + y * y + z * z) / ks
    return pressed, sheared


@bare
def gap_of(pairs, points, motion, p, k):
    """Gap (m) of a point now, below 0 where the blocks press."""
    own, s = pairs.points_of[p], pairs.slot[p]
    ref, other = pairs.body[p, 1 - own], pairs.body[p, own]
    x, y, z = pairs.normal[p, 0], pairs.normal[p, 1], pairs.normal[p, 2]
    nx, ny, nz, share = plane_of(motion.frame, motion.dual, ref, x, y, z)
    n = nx, ny, nz
    a = turned(motion.frame, other, points.material[s, k, 0], points.material[s, k, 1], points.material[s, k, 2])
    along = 0.0
    for i in range(3):
        between = (motion.centre[other, i] - motion.centre[ref, i]) + (motion.moved[other, i] - motion.moved[ref, i])
        along += n[i] * (a[i] + between)
    return (along - share * points.level[s, k]) * (1.0 if own == 1 else -1.0)


@bare
def stored_energy(near):
    """Elastic energy (J) of all patches."""
    energy = 0.0
    for p in range(near.pairs.number[0]):
        pressed, sheared = stored(near.pairs, near.points, near.rules, near.motion, p)
        energy += pressed + sheared
    return energy


@bare
def deepest(near, width):
    """How far points overlap at most, over the least width (B,) m of the thinner of their two blocks."""
    pairs, points, most = near.pairs, near.points, 0.0
    for p in range(pairs.number[0]):
        s = pairs.slot[p]
        for k in range(points.held[s] if s >= 0 else 0):
            gap = gap_of(pairs, points, near.motion, p, k)
            most = max(most, -gap / min(width[pairs.body[p, 0]], width[pairs.body[p, 1]]))
    return most


def no_pairs(room: int) -> Pairs:
    """Room for so many pairs, and none in it."""
    numbers, twice, vectors = (room,), (room, 2), (room, 3)
    whole = {
        name: np.zeros(shape, dtype=np.int64) for name, shape in (("piece", twice), ("body", twice), ("law", numbers))
    }
    return Pairs(
        number=np.zeros(1, dtype=np.int64),
        slot=np.full(room, -1, dtype=np.int64),
        points_of=np.zeros(room, dtype=np.int64),
        normal=np.zeros(vectors),
        axis=np.zeros(vectors),
        witness=np.full(vectors, -1, dtype=np.int64),
        mark=np.zeros(room),
        limit=np.zeros(room),
        dashpot=np.zeros(room),
        **whole,
    )


def no_points(room: int, most: int) -> Points:
    """Room for the points of so many pairs, `most` (K) each, and none in it."""
    one, three = (room, most), (room, most, 3)
    return Points(
        held=np.zeros(room, dtype=np.int64),
        material=np.zeros(three),
        level=np.zeros(one),
        area=np.zeros(one),
        feature=np.zeros(one, dtype=np.int64),
        shear=np.zeros(three),
        damper=np.zeros(one),
        free=np.append(np.arange(room)[::-1], room).astype(np.int64),
    )
