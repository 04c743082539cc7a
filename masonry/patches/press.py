"""Patches: contacts that are detected, press and slide with friction, and have no strength.

A point of a patch is a material point of one of the two blocks; the plane that it meets is fixed in the other, the
reference. Its gap is measured from that geometry at every step, never summed up. The force acts on both blocks at this
one point: as the plane turns with the reference, the rate of the gap is the velocity of the point less that of the
reference at the same place, so the springs are conservative and no couple is left.
"""

from math import sqrt

import numpy as np

from masonry.jit.compiled_parts import CompiledPart
from masonry.jit.compiler import inlined, inner, jit
from masonry.jit.records import unpack
from masonry.kinematics.planes import plane_of, turned
from masonry.patches.arrays import (
    AREA,
    CRUSHED,
    DASHPOT,
    FRICTION,
    LEVEL,
    PLACE,
    SHEAR,
    between,
    joint_of,
    number_of,
    vector_of,
)
from masonry.patches.branches import beside
from masonry.patches.crushed_points import (
    crush,
    four_with_closing,
    least,
    row_that_crushes,
    with_closing,
    with_crushing,
)
from masonry.patches.pairs import FAR
from masonry.simd import FOUR, any_lane, below, filled, four, minimum, put, take, total, where

ROUND_OFF = 1e-15
"""Of a sum of three squares, after a few operations on each."""


@CompiledPart
def press(record):
    """Forces and moments of all points of all patches into motion.push, from their gaps and the slip of this step.

    near is what arrays.Near says; its account gets what friction and the dashpots dissipate. Four points of a
    patch are computed at a time: with a their places from the centroid of the block that they belong to, o from the
    centroid of the reference to that one, and v, w velocities and spins, the other block moves against the reference
    at a by v - v_ref - w_ref x o + (w - w_ref) x a, and the moment on the reference is that on the other and o x force.
    """
    near, dt = unpack(record)
    pairs, points, rules, motion, account = near.pairs, near.points, near.rules, near.motion, near.account
    centre, moved, frame, v, push = motion.centre, motion.moved, motion.frame, motion.v, motion.push
    body, slot, points_of, normal = pairs.body, pairs.slot, pairs.points_of, pairs.normal
    friction = damped = crushing = filled(0.0, four())
    parted = False
    clear(push, 6)
    for p in range(pairs.number[0]):
        if slot[p] < 0:
            continue
        owner, s = points_of[p], np.uint64(slot[p])  # an index without a sign is not looked at for one
        ref, other = np.uint64(body[p, 1 - owner]), np.uint64(body[p, owner])
        n = turned(frame, ref, normal[p, 0], normal[p, 1], normal[p, 2])
        ox, oy, oz = between(centre, moved, ref, other)
        rx, ry, rz, wx, wy, wz = v[ref, 3], v[ref, 4], v[ref, 5], v[other, 3], v[other, 4], v[other, 5]
        ux = v[other, 0] - v[ref, 0] - ry * oz + rz * oy
        uy = v[other, 1] - v[ref, 1] - rz * ox + rx * oz
        uz = v[other, 2] - v[ref, 2] - rx * oy + ry * ox
        rotation = 0.5 * dt * (rx + wx), 0.5 * dt * (ry + wy), 0.5 * dt * (rz + wz)
        wx, wy, wz, along = wx - rx, wy - ry, wz - rz, n[0] * ox + n[1] * oy + n[2] * oz
        slack, dashpot, count, joint = pairs.slack[p], pairs.dashpot[p], points.number[s], joint_of(rules, pairs.law[p])
        row = row_that_crushes(points.crushed, pairs, p)
        fx = fy = fz = qx = qy = qz = work = filled(0.0, four())
        for k in range(0, count, FOUR):
            ax, ay, az = places(frame, other, points, s, k)
            gap = n[0] * ax + n[1] * ay + n[2] * az + along - four_of(points, s, k, LEVEL)
            d = ux + wy * az - wz * ay, uy + wz * ax - wx * az, uz + wx * ay - wy * ax
            rate = d[0] * n[0] + d[1] * n[1] + d[2] * n[2]
            present = below(count - k, four())
            (gx, gy, gz), sigma, by_friction, by_dashpot, by_crushing = respond(
                points,
                joint,
                dashpot,
                s,
                k,
                present,
                four_with_closing(points.crushed, s, k, gap + slack),
                d,
                rate,
                rate,
                n,
                rotation,
                dt,
                rules.keep,
                rules.gain,
                rise_of(rules.rise, pairs.law[p]),
                points.crushed,
                rules.cap,
                rules.cut_off,
                row,
            )
            friction, work = friction + by_friction, work + by_dashpot
            crushing = with_crushing(points.crushed, crushing, by_crushing)
            gx, gy, gz = gx + sigma * n[0], gy + sigma * n[1], gz + sigma * n[2]
            fx, fy, fz = fx + gx, fy + gy, fz + gz
            qx, qy, qz = qx + (ay * gz - az * gy), qy + (az * gx - ax * gz), qz + (ax * gy - ay * gx)
        fx, fy, fz, qx, qy, qz = total(fx), total(fy), total(fz), total(qx), total(qy), total(qz)
        add(push, ref, 1.0, fx, fy, fz, qx + (oy * fz - oz * fy), qy + (oz * fx - ox * fz), qz + (ox * fy - oy * fx))
        add(push, other, -1.0, fx, fy, fz, qx, qy, qz)
        if dashpot > 0.0 or any_branches(rules.keep):
            damped, pairs.damped[p] = damped + work, pairs.damped[p] + total(work)
        parted = parted or (slack != 0.0 and fx == 0.0 and fy == 0.0 and fz == 0.0)
    account[FRICTION] += total(friction)
    account[DASHPOT] += total(damped)
    account[CRUSHED] += with_crushing(points.crushed, 0.0, total(crushing))
    if parted:
        ease(pairs, points, motion)


@inlined
def clear(push, width):
    """Nothing pushes any block; width: how many numbers a row of `push` has."""
    for b in range(len(push)):
        for i in range(width):
            push[b, i] = 0.0


@inlined
def four_of(points, s, k, row):
    """A number of four points of a slot, from point k on."""
    return take(points.quads, (k // FOUR, s, row, 0), four())


@inlined
def places(frame, b, points, s, k):
    """x, y, z in space of four points of a slot, from the centroid of the block that they belong to."""
    x, y, z = four_of(points, s, k, PLACE), four_of(points, s, k, PLACE + 1), four_of(points, s, k, PLACE + 2)
    return turned(frame, b, x, y, z)


@inlined
def respond(
    points, joint, dashpot, s, k, present, gap, d, along, closing, n, rotation, dt, keep, gain, rise,
    crushed, cap, cut_off, row,
):  # fmt: skip
    """Forces of four points of a patch: shear (3) and normal (N); energy that friction, dashpot and crushing took (J).

    joint     as `joint_of`; dashpot Pa s/m     present  which of the four there are
    d, along  m/s, of the other block against the reference, and its part along the normal n
    gap, closing  m, with the plastic closing, and its rate (m/s)     rotation  rad, of the two blocks in this step
    keep, gain  of branches.py, or None   rise, cap, cut_off  of Rules, or None, and row of them, -1 of edges
    """
    (kn, ks, tan, cohesion), size = joint, four_of(points, s, k, AREA)
    touches = (gap < 0.0) & present
    sigma = where(touches, kn * gap, 0.0)
    work = filled(0.0, gap)
    shear = four_of(points, s, k, SHEAR), four_of(points, s, k, SHEAR + 1), four_of(points, s, k, SHEAR + 2)
    before = shear[0] * shear[0] + shear[1] * shear[1] + shear[2] * shear[2]
    closed, limit, by_closing, by_slip = crush(
        crushed, cap, cut_off, row, s, k, joint, touches, gap, closing, shear, before, d, along, n, dt
    )
    sigma = with_crushing(crushed, sigma, kn * closed)
    if dashpot > 0.0:  # its work by the trapezoid, as that of all forces on the blocks
        now = where(touches, minimum(dashpot * while_closed(rise, gap, closing, dt), -sigma), 0.0)
        work = 0.5 * dt * size * closing * (now + take(points.damper, (k // FOUR, s, 0), four()))
        put(points.damper, (k // FOUR, s, 0), now)
        sigma = sigma + now
    if keep is None and not any_lane(touches | (before > 0.0)):
        return (sigma, sigma, sigma), sigma, sigma, work, sigma
    shear, out = turned_with(shear, before, rotation, n)
    shear_limit = least(crushed, strength(cohesion, tan, sigma, touches), limit)
    t, heat = slide(shear, out, d, along, n, dt, ks, shear_limit)
    x, y, z = where(touches, t[0], 0.0), where(touches, t[1], 0.0), where(touches, t[2], 0.0)
    put(points.quads, (k // FOUR, s, SHEAR, 0), x)
    put(points.quads, (k // FOUR, s, SHEAR + 1, 0), y)
    put(points.quads, (k // FOUR, s, SHEAR + 2, 0), z)
    if keep is not None:
        m, taken = beside(
            points.branches, keep, gain, s, k, joint, dt, touches, (x, y, z), shear_limit, sigma, d, along, n, rotation
        )
        x, y, z, work = x + m[0], y + m[1], z + m[2], work + size * taken
    heat = with_crushing(crushed, heat, -by_slip)
    return (size * x, size * y, size * z), size * sigma, size * heat, work, size * (by_closing + by_slip)


@inlined
def rise_of(rise, law):
    """Above 0 where a row of rules has a restitution; None where none has."""
    if rise is None:
        return None
    return rise[law, 0]


@inlined
def while_closed(rise, gap, closing, dt):
    """m/s, rate of a gap (m) as far as it closed in this step, where a restitution is given: so it does not depend on
    where in the step an impact begins."""
    if rise is None:
        return closing
    begins = where(gap - dt * closing > 0.0, gap / dt, closing)
    return begins if rise > 0.0 else closing


@inlined
def any_branches(keep):
    """Whether springs have branches beside them."""
    return keep is not None


@inlined
def strength(cohesion, tan, sigma, touches):
    """The most shear (Pa) that points bear; those that part lose all of theirs to friction."""
    if cohesion is None:
        return -tan * sigma
    return where(touches, cohesion - tan * sigma, 0.0)


@inlined
def turned_with(t, before, rotation, n):
    """The shear traction of points, of norm^2 `before`, after a rotation (rad), and what of it is out of the plane:
    without that it has the same size.

    A rotation of less than some 1e-8 changes the size by no more than round-off does, and needs no root.
    """
    x, y, z = (
        t[0] + rotation[1] * t[2] - rotation[2] * t[1],
        t[1] + rotation[2] * t[0] - rotation[0] * t[2],
        t[2] + rotation[0] * t[1] - rotation[1] * t[0],
    )
    out = x * n[0] + y * n[1] + z * n[2]
    after = x * x + y * y + z * z - out * out
    if not any_lane(abs(after - before) > ROUND_OFF * before):
        return (x, y, z), out
    scale = where(after > 0.0, sqrt(before / after), 0.0)
    return (scale * x, scale * y, scale * z), scale * out


@inlined
def slide(h, out, d, along, n, dt, ks, shear_limit):
    """The shear traction (Pa), no more than `shear_limit`, after a step with velocity d (m/s), and what friction
    took (J/m2): what the trapezoid puts in, less what the springs then hold more.

    h, out  Pa, the traction before, and its part along n that is not one of shear; along  m/s, that of d
    """
    stiff = dt * ks
    lift = out + stiff * along
    tx, ty, tz = h[0] + stiff * d[0] - lift * n[0], h[1] + stiff * d[1] - lift * n[1], h[2] + stiff * d[2] - lift * n[2]
    trial = tx * tx + ty * ty + tz * tz
    slides = trial > shear_limit * shear_limit
    if not any_lane(slides):
        return (tx, ty, tz), filled(0.0, trial)
    fraction = where(slides, shear_limit / sqrt(trial), 1.0)
    tx, ty, tz = fraction * tx, fraction * ty, fraction * tz
    sx, sy, sz = dt * (d[0] - along * n[0]), dt * (d[1] - along * n[1]), dt * (d[2] - along * n[2])
    x, y, z = h[0] - out * n[0], h[1] - out * n[1], h[2] - out * n[2]
    put_in = (x + tx) * sx + (y + ty) * sy + (z + tz) * sz
    stored_more = (shear_limit * shear_limit - x * x - y * y - z * z) / ks
    return (tx, ty, tz), where(slides, 0.5 * (put_in - stored_more), 0.0)


@inner
def add(push, b, side, fx, fy, fz, mx, my, mz):
    """Add a force and its moment, times a sign, to what a block is pushed by."""
    push[b, 0] += side * fx
    push[b, 1] += side * fy
    push[b, 2] += side * fz
    push[b, 3] += side * mx
    push[b, 4] += side * my
    push[b, 5] += side * mz


@jit
def stored(pairs, points, rules, motion, p):
    """Elastic energies (J) of the points of a pair as they stand: normal, and shear."""
    pressed, sheared, s = 0.0, 0.0, pairs.slot[p]
    kn, ks = rules.normal_stiffness[pairs.law[p]], rules.shear_stiffness[pairs.law[p]]
    for k in range(points.number[s] if s >= 0 else 0):
        gap = pressing_gap(pairs, points, motion, p, k)
        if gap < 0.0:
            (x, y, z), area = vector_of(points, s, k, SHEAR), number_of(points, s, k, AREA)
            pressed += 0.5 * area * kn * gap * gap
            sheared += 0.5 * area * (x * x + y * y + z * z) / ks
    return pressed, sheared


@inner
def ease(pairs, points, motion):
    """Take back as much of the slack of each pair of which nothing presses as its points have parted."""
    for p in range(pairs.number[0]):
        if pairs.slot[p] < 0 or pairs.slack[p] == 0.0:
            continue
        gap = FAR
        for k in range(points.number[pairs.slot[p]]):
            gap = min(gap, with_closing(points.crushed, pairs.slot[p], k, gap_of(pairs, points, motion, p, k)))
            if gap + pairs.slack[p] < 0.0:
                break
        if gap + pairs.slack[p] >= 0.0:
            pairs.slack[p] = min(max(-gap, 0.0), max(pairs.slack[p], 0.0))


@jit
def gap_of(pairs, points, motion, p, k):
    """Gap (m) of a point now, below 0 where the blocks press."""
    owner, s = pairs.points_of[p], pairs.slot[p]
    ref, other = pairs.body[p, 1 - owner], pairs.body[p, owner]
    x, y, z = pairs.normal[p, 0], pairs.normal[p, 1], pairs.normal[p, 2]
    nx, ny, nz, scale = plane_of(motion.frame, motion.dual, ref, x, y, z)
    n = nx, ny, nz
    x, y, z = vector_of(points, s, k, PLACE)
    a = turned(motion.frame, other, x, y, z)
    o, along = between(motion.centre, motion.moved, ref, other), 0.0
    for i in range(3):
        along += n[i] * (a[i] + o[i])
    return along - scale * number_of(points, s, k, LEVEL)


@jit
def pressing_gap(pairs, points, motion, p, k):
    """The gap (m) by which a point presses: with the slack of its pair and its plastic closing."""
    slot, gap = pairs.slot[p], gap_of(pairs, points, motion, p, k)
    return with_closing(points.crushed, slot, k, gap + pairs.slack[p])
