"""Patches between blocks of which some deform: the plane of a point is one of the material of its reference block.

As patches.py, with deformation gradients F in place of rotations: the plane N . X = L of the reference is n . y = l in
space, with n along F^-T N. As it stretches with its block, the rate of a gap g is n . (velocity of the point less that
of the reference at the foot of the point on the plane). So the normal force acts on the reference at that foot, g along
its own line from the point, and the shear force at the point: no couple is left, and the springs are conservative.
"""

from masonry.detection.bare import bare
from masonry.kernels.patches import DASHPOT, FRICTION, slide, turned_with
from masonry.kernels.planes import into, plane_of, turned


@bare
def press_deforming(near, dt):
    """Forces and first moments of all points of all patches into motion.push (B, 12), as `press` does for rigid blocks.

    A row is the force f, then sum of f_i y_j row by row, with y from the centroid now.
    """
    pairs, points, rules, motion, account = near.pairs, near.points, near.rules, near.motion, near.account
    centre, moved, frame, v, push = motion.centre, motion.moved, motion.frame, motion.v, motion.push
    dual, rate = motion.dual, motion.rate
    body, slot, points_of, normal = pairs.body, pairs.slot, pairs.points_of, pairs.normal
    law, dashpot, count = pairs.law, pairs.dashpot, points.held
    material, level, area, shear, damper = points.material, points.level, points.area, points.shear, points.damper
    friction = damped = 0.0
    for b in range(len(push)):
        for i in range(12):
            push[b, i] = 0.0
    for p in range(pairs.number[0]):
        s = slot[p]
        if s < 0:
            continue
        own = points_of[p]
        ref, other = body[p, 1 - own], body[p, own]
        kn, ks, tan = rules.normal_stiffness[law[p]], rules.shear_stiffness[law[p]], rules.tan_friction[law[p]]
        side = 1.0 if own == 1 else -1.0  # the normal points from side 0 to side 1
        nx, ny, nz, share = plane_of(frame, dual, ref, normal[p, 0], normal[p, 1], normal[p, 2])
        ox, oy, oz = (  # the sums of the places would lose digits far from the origin
            (centre[other, 0] - centre[ref, 0]) + (moved[other, 0] - moved[ref, 0]),
            (centre[other, 1] - centre[ref, 1]) + (moved[other, 1] - moved[ref, 1]),
            (centre[other, 2] - centre[ref, 2]) + (moved[other, 2] - moved[ref, 2]),
        )
        wx, wy, wz = 0.5 * (v[ref, 3] + v[other, 3]), 0.5 * (v[ref, 4] + v[other, 4]), 0.5 * (v[ref, 5] + v[other, 5])
        ex, ey, ez = into(frame, dual, ref, nx, ny, nz)
        lx, ly, lz = turned(rate, ref, ex, ey, ez)
        stretching = nx * lx + ny * ly + nz * lz
        for k in range(count[s]):
            ax, ay, az = turned(frame, other, material[s, k, 0], material[s, k, 1], material[s, k, 2])
            bx, by, bz = ax + ox, ay + oy, az + oz
            gap = side * (nx * bx + ny * by + nz * bz - share * level[s, k])
            # velocity of side 1 against side 0 at the point
            ex, ey, ez = into(frame, dual, ref, bx, by, bz)
            lx, ly, lz = turned(rate, ref, ex, ey, ez)
            dx, dy, dz = turned(rate, other, material[s, k, 0], material[s, k, 1], material[s, k, 2])
            dx = side * (dx + v[other, 0] - v[ref, 0] - lx)
            dy = side * (dy + v[other, 1] - v[ref, 1] - ly)
            dz = side * (dz + v[other, 2] - v[ref, 2] - lz)
            along = dx * nx + dy * ny + dz * nz
            closing = along + gap * stretching
            sigma = kn * min(gap, 0.0)
            if dashpot[p] > 0.0:
                now = min(dashpot[p] * closing, -sigma) if gap < 0.0 else 0.0
                damped += 0.5 * (now + damper[s, k]) * closing * dt * area[s, k]
                damper[s, k] = now
                sigma += now
            hx, hy, hz = turned_with(shear, s, k, wx * dt, wy * dt, wz * dt, nx, ny, nz)
            sx, sy, sz = dt * (dx - along * nx), dt * (dy - along * ny), dt * (dz - along * nz)
            tx, ty, tz, taken = slide(hx, hy, hz, sx, sy, sz, ks, -tan * sigma)
            friction += taken * area[s, k]
            if gap >= 0.0:
                shear[s, k, 0] = shear[s, k, 1] = shear[s, k, 2] = 0.0
                continue
            shear[s, k, 0], shear[s, k, 1], shear[s, k, 2] = tx, ty, tz
            pressed = side * area[s, k] * sigma
            fx = side * area[s, k] * tx + pressed * nx
            fy = side * area[s, k] * ty + pressed * ny
            fz = side * area[s, k] * tz + pressed * nz
            add(push, ref, fx, fy, fz, bx, by, bz)
            add(push, other, -fx, -fy, -fz, ax, ay, az)
            foot = -pressed * side * gap
            add_moments(push, ref, foot * nx, foot * ny, foot * nz, nx, ny, nz)
    account[FRICTION] += friction
    account[DASHPOT] += damped


@bare
def add(push, b, fx, fy, fz, x, y, z):
    """Add a force that acts at (x, y, z) from the centroid of block b, and its first moments."""
    push[b, 0] += fx
    push[b, 1] += fy
    push[b, 2] += fz
    add_moments(push, b, fx, fy, fz, x, y, z)


@bare
def add_moments(push, b, fx, fy, fz, x, y, z):
    """Add first moments: a force times a lever."""
    push[b, 3] += fx * x
    push[b, 4] += fx * y
    push[b, 5] += fx * z
    push[b, 6] += fy * x
    push[b, 7] += fy * y
    push[b, 8] += fy * z
    push[b, 9] += fz * x
    push[b, 10] += fz * y
    push[b, 11] += fz * z
