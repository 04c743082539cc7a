"""Hand-written steps of rigid blocks and of blocks of tets: displace, contacts, forces, damping, ledger, motion.

`damped` and `booked` are known when a step is compiled, so that one without damping or ledger holds nothing of it.
"""

from functools import cache

import numpy as np

from verification.reference_step.contacts import compiled

ONE = np.uint32(1)


@cache
def dof(damped: bool, booked: bool):
    """The kick of eq. (1) for one dof, with local damping, eq. (3), and works (J): of contacts, and of what holds.

    What holds is damping where the dof can move, and else (pace 0) the reaction, whose work is external.
    """

    @compiled
    def kick(xi, half, i, row, pace, v, before, work, contact, inner):
        velocity, give = v[row, i], pace[row, i]
        total = contact + inner
        hold = 0.0
        if damped:
            hold = xi * abs(total)
            hold = -hold if velocity > 0.0 else (hold if velocity < 0.0 else 0.0)
        hold = -total if give == 0.0 else hold
        if booked:
            move = half * velocity
            work[row, i] += (contact + before[row, i]) * move
            work[row, 4 + i] += (hold + before[row, 4 + i]) * move
            before[row, i] = contact
            before[row, 4 + i] = hold
        v[row, i] = velocity + give * (total + hold)

    return kick


@cache
def rigid_step(contacts, damped: bool, booked: bool):
    """Rows 2 b and 2 b + 1 of q, v, pace (2 B, 4), before and work (2 B, 8) are the moves and the turns of block b.

    start (B + 1,), code (S,)  contact sides of each block, 2 * contact + (1 on side b); arm (S, 4)
    """
    kick = dof(damped, booked)

    @compiled
    def steps(
        count, dt, xi, law, ends, frame, u, force, past, slip, dissipated, q, v, pace, before, work, start, code, arm
    ):
        for _ in range(count):
            for b in range(len(start) - 1):
                m, t = 2 * b, 2 * b + 1
                for i in range(4):
                    q[m, i] += dt * v[m, i]
                    q[t, i] += dt * v[t, i]
                x, y, z, p, r, s = q[m, 0], q[m, 1], q[m, 2], q[t, 0], q[t, 1], q[t, 2]
                for k in range(start[b], start[b + 1]):
                    u[k, 0] = x + r * arm[k, 2] - s * arm[k, 1]
                    u[k, 1] = y + s * arm[k, 0] - p * arm[k, 2]
                    u[k, 2] = z + p * arm[k, 1] - r * arm[k, 0]
            contacts(law, ends, frame, u, force, past, slip, dissipated)
            for b in range(len(start) - 1):
                fx, fy, fz, mx, my, mz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
                for k in range(start[b], start[b + 1]):
                    c, side = code[k] >> ONE, 1.0 - 2.0 * (code[k] & ONE)
                    gx, gy, gz = side * force[c, 0], side * force[c, 1], side * force[c, 2]
                    fx, fy, fz = fx + gx, fy + gy, fz + gz
                    mx += arm[k, 1] * gz - arm[k, 2] * gy
                    my += arm[k, 2] * gx - arm[k, 0] * gz
                    mz += arm[k, 0] * gy - arm[k, 1] * gx
                for i, sums in enumerate(((fx, mx), (fy, my), (fz, mz))):
                    kick(xi, 0.5 * dt, i, 2 * b, pace, v, before, work, sums[0], 0.0)
                    kick(xi, 0.5 * dt, i, 2 * b + 1, pace, v, before, work, sums[1], 0.0)

    return steps


@cache
def tet_step(contacts, damped: bool, booked: bool):
    """The same for blocks of tets with rows n of u, v, pace, inner (N, 4), before and work (N, 8); one block at a time.

    slope (T, 9)  sqrt(volume) times the gradients of the last three shape functions; lame (B, 2) Pa
    """
    kick = dof(damped, booked)

    @compiled
    def tets(first, last, corner, slope, lame, mu, u, inner):
        for e in range(first, last):
            o, a, b, c = corner[e, 0], corner[e, 1], corner[e, 2], corner[e, 3]
            ax, ay, az = u[a, 0] - u[o, 0], u[a, 1] - u[o, 1], u[a, 2] - u[o, 2]
            bx, by, bz = u[b, 0] - u[o, 0], u[b, 1] - u[o, 1], u[b, 2] - u[o, 2]
            cx, cy, cz = u[c, 0] - u[o, 0], u[c, 1] - u[o, 1], u[c, 2] - u[o, 2]
            g0, g1, g2 = slope[e, 0], slope[e, 1], slope[e, 2]
            g3, g4, g5 = slope[e, 3], slope[e, 4], slope[e, 5]
            g6, g7, g8 = slope[e, 6], slope[e, 7], slope[e, 8]
            h0, h4, h8 = ax * g0 + bx * g3 + cx * g6, ay * g1 + by * g4 + cy * g7, az * g2 + bz * g5 + cz * g8
            pressure = lame * (h0 + h4 + h8)
            sx, sy, sz = pressure + 2.0 * mu * h0, pressure + 2.0 * mu * h4, pressure + 2.0 * mu * h8
            syz = mu * (ay * g2 + by * g5 + cy * g8 + az * g1 + bz * g4 + cz * g7)
            sxz = mu * (ax * g2 + bx * g5 + cx * g8 + az * g0 + bz * g3 + cz * g6)
            sxy = mu * (ax * g1 + bx * g4 + cx * g7 + ay * g0 + by * g3 + cy * g6)
            px, py, pz = sx * g0 + sxy * g1 + sxz * g2, sxy * g0 + sy * g1 + syz * g2, sxz * g0 + syz * g1 + sz * g2
            qx, qy, qz = sx * g3 + sxy * g4 + sxz * g5, sxy * g3 + sy * g4 + syz * g5, sxz * g3 + syz * g4 + sz * g5
            rx, ry, rz = sx * g6 + sxy * g7 + sxz * g8, sxy * g6 + sy * g7 + syz * g8, sxz * g6 + syz * g7 + sz * g8
            inner[a, 0] -= px
            inner[a, 1] -= py
            inner[a, 2] -= pz
            inner[b, 0] -= qx
            inner[b, 1] -= qy
            inner[b, 2] -= qz
            inner[c, 0] -= rx
            inner[c, 1] -= ry
            inner[c, 2] -= rz
            inner[o, 0] += px + qx + rx
            inner[o, 1] += py + qy + ry
            inner[o, 2] += pz + qz + rz
            for n in (o, a, b, c):
                inner[n, 3] += 0.0

    @compiled
    def steps(
        count, dt, xi, law, ends, frame, u, force, past, slip, dissipated,
        v, pace, before, work, start, code, node_start, tet_start, corner, slope, lame, inner,
    ):  # fmt: skip
        for _ in range(count):
            for n in range(len(v)):
                for i in range(4):
                    u[n, i] += dt * v[n, i]
            contacts(law, ends, frame, u, force, past, slip, dissipated)
            for b in range(len(lame)):
                first, last = node_start[b], node_start[b + 1]
                for n in range(first, last):
                    for i in range(4):
                        inner[n, i] = 0.0
                tets(tet_start[b], tet_start[b + 1], corner, slope, lame[b, 0], lame[b, 1], u, inner)
                for n in range(first, last):
                    fx, fy, fz = 0.0, 0.0, 0.0
                    for k in range(start[n], start[n + 1]):
                        c, side = code[k] >> ONE, 1.0 - 2.0 * (code[k] & ONE)
                        fx += side * force[c, 0]
                        fy += side * force[c, 1]
                        fz += side * force[c, 2]
                    kick(xi, 0.5 * dt, 0, n, pace, v, before, work, fx, inner[n, 0])
                    kick(xi, 0.5 * dt, 1, n, pace, v, before, work, fy, inner[n, 1])
                    kick(xi, 0.5 * dt, 2, n, pace, v, before, work, fz, inner[n, 2])

    return steps
