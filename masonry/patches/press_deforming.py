"""Patches between blocks of which some deform: the plane of a point is one of the material of its reference block.

As press.py, with deformation gradients F in place of rotations: the plane N . X = L of the reference is n . y = l in
space, with n along F^-T N. As it stretches with its block, the rate of a gap g is n . (velocity of the point less that
of the reference at the foot of the point on the plane). So the normal force acts on the reference at that foot, g along
its own line from the point, and the shear force at the point: no couple is left, and the springs are conservative.
"""

from masonry.jit.compiled_parts import CompiledPart
from masonry.jit.compiler import inlined, inner
from masonry.jit.records import unpack
from masonry.kinematics.planes import into, plane_of, turned
from masonry.patches.arrays import CRUSHED, DASHPOT, FRICTION, LEVEL, between, joint_of
from masonry.patches.crushed_points import four_with_closing, row_that_crushes, with_crushing
from masonry.patches.press import any_branches, clear, ease, four_of, places, respond, rise_of
from masonry.simd import FOUR, below, filled, four, total


@CompiledPart
def press_deforming(record):
    """Forces and first moments of all points of all patches into motion.push (B, 12), as `press` does for rigid blocks.

    A row is the force f, then sum of f_i y_j row by row, with y from the centroid now.
    """
    near, dt = unpack(record)
    pairs, points, rules, motion, account = near.pairs, near.points, near.rules, near.motion, near.account
    centre, moved, frame, v, push = motion.centre, motion.moved, motion.frame, motion.v, motion.push
    dual, rate = motion.dual, motion.rate
    body, slot, points_of, normal = pairs.body, pairs.slot, pairs.points_of, pairs.normal
    friction = damped = crushing = filled(0.0, four())
    parted = False
    clear(push, 12)
    for p in range(pairs.number[0]):
        s = slot[p]
        if s < 0:
            continue
        owner = points_of[p]
        ref, other = body[p, 1 - owner], body[p, owner]
        nx, ny, nz, scale = plane_of(frame, dual, ref, normal[p, 0], normal[p, 1], normal[p, 2])
        ox, oy, oz = between(centre, moved, ref, other)
        half = 0.5 * dt
        spin = half * (v[ref, 3] + v[other, 3]), half * (v[ref, 4] + v[other, 4]), half * (v[ref, 5] + v[other, 5])
        lx, ly, lz = turned(rate, ref, *into(frame, dual, ref, nx, ny, nz))
        stretching, along = nx * lx + ny * ly + nz * lz, nx * ox + ny * oy + nz * oz
        slack, dashpot, count, joint = pairs.slack[p], pairs.dashpot[p], points.number[s], joint_of(rules, pairs.law[p])
        row = row_that_crushes(points.crushed, pairs, p)
        fx = fy = fz = pressed = work = filled(0.0, four())
        xx = xy = xz = yx = yy = yz = zx = zy = zz = filled(0.0, four())
        for k in range(0, count, FOUR):
            ax, ay, az = places(frame, other, points, s, k)
            gap = nx * ax + ny * ay + nz * az + along - scale * four_of(points, s, k, LEVEL)
            lx, ly, lz = turned(rate, ref, *into(frame, dual, ref, ax + ox, ay + oy, az + oz))
            dx, dy, dz = places(rate, other, points, s, k)  # velocity of the other block against the reference
            dx = dx + (v[other, 0] - v[ref, 0]) - lx
            dy = dy + (v[other, 1] - v[ref, 1]) - ly
            dz = dz + (v[other, 2] - v[ref, 2]) - lz
            speed = dx * nx + dy * ny + dz * nz
            closed = four_with_closing(points.crushed, s, k, gap + slack)
            (gx, gy, gz), sigma, by_friction, by_dashpot, by_crushing = respond(
                *(points, joint, dashpot, s, k, below(count - k, four()), closed),
                *((dx, dy, dz), speed, speed + gap * stretching, (nx, ny, nz), spin, dt),
                *(rules.keep, rules.gain, rise_of(rules.rise, pairs.law[p])),
                *(points.crushed, rules.cap, rules.cut_off, row),
            )
            crushing = with_crushing(points.crushed, crushing, by_crushing)
            friction, work, pressed = friction + by_friction, work + by_dashpot, pressed + sigma * gap
            gx, gy, gz = gx + sigma * nx, gy + sigma * ny, gz + sigma * nz
            fx, fy, fz = fx + gx, fy + gy, fz + gz
            xx, xy, xz = xx + gx * ax, xy + gx * ay, xz + gx * az
            yx, yy, yz = yx + gy * ax, yy + gy * ay, yz + gy * az
            zx, zy, zz = zx + gz * ax, zy + gz * ay, zz + gz * az
        force = total(fx), total(fy), total(fz)
        moments = (
            total(xx), total(xy), total(xz), total(yx), total(yy), total(yz), total(zx), total(zy), total(zz),
        )  # fmt: skip
        push_both(push, ref, other, force, moments, (ox, oy, oz), -total(pressed), (nx, ny, nz))
        if dashpot > 0.0 or any_branches(rules.keep):
            damped, pairs.damped[p] = damped + work, pairs.damped[p] + total(work)
        parted = parted or (slack != 0.0 and force[0] == 0.0 and force[1] == 0.0 and force[2] == 0.0)
    account[FRICTION] += total(friction)
    account[DASHPOT] += total(damped)
    account[CRUSHED] += with_crushing(points.crushed, 0.0, total(crushing))
    if parted:
        ease(pairs, points, motion)


@inlined
def push_both(push, ref, other, force, moments, o, foot, n):
    """Add what a patch bears to both blocks: o (m) from the centroid of the reference to that of the other one, foot
    (J) the normal force times how far along n the reference bears it from the points."""
    add(push, ref, 1.0, force, moments)
    add_moments(push, ref, force, o[0], o[1], o[2])
    add_moments(push, ref, (foot * n[0], foot * n[1], foot * n[2]), n[0], n[1], n[2])
    add(push, other, -1.0, force, moments)


@inner
def add(push, b, sign, force, moments):
    """Add a force and its first moments, times a sign, to what block b is pushed by."""
    for i in range(3):
        push[b, i] += sign * force[i]
    for i in range(9):
        push[b, 3 + i] += sign * moments[i]


@inner
def add_moments(push, b, force, x, y, z):
    """Add first moments: a force times a lever."""
    for i in range(3):
        push[b, 3 + 3 * i] += force[i] * x
        push[b, 4 + 3 * i] += force[i] * y
        push[b, 5 + 3 * i] += force[i] * z
