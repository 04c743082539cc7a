"""Blocks of constant-strain tets that turn and deform as far as they like: total Lagrangian, St Venant-Kirchhoff.

As tets.py, with the quadratic strain: gradients of the shape functions and volumes are kept apart. The frame of a block
is its mean deformation gradient, F = 1 + sum of u_i g_i with g_i the mean gradient of node i's shape function: the g_i
vanish inside and add up to nothing. So a couple beyond material points (levers.py), antisymmetric first moments T,
brought to the nodes as T F^-T g_i, has no resultant and exactly its moment, and does the work of the turn of F.
"""

from typing import NamedTuple

import numpy as np
from numba import prange

from masonry.jit.compiler import jit
from masonry.jit.extending import register_jitable
from masonry.kinematics.deforming import keep_drawn
from masonry.kinematics.levers import skew
from masonry.kinematics.matrices import (
    determinant,
    inverse,
    largest_stretch,
    matrix_at,
    product,
    put_matrix,
    second_piola,
    strain,
    times_symmetric,
    transposed,
    work_density,
)
from masonry.kinematics.motion import advance, keep
from masonry.kinematics.tets import gradient, interpolate, pulled
from masonry.simd import (
    EIGHT,
    FOUR,
    eight,
    four,
    gather_corners,
    numbers,
    pack,
    part,
    plus,
    put,
    scatter,
    take,
    take_row,
    take_slopes,
    total,
)


class DeformingTets(NamedTuple):
    """Arrays of B meshed blocks with N nodes and T tets; node k is row k of u.

    v, dt_over_mass, contact, hold, inner, start, code, node_start, group_start, corner, lame, load to pull_fraction  as
                    Tets
    slope           (G, 9, 8) 1/m, gradients of the last three shape functions; 0 where filled up
    volume          (G, 8) m3 at the start; 0 where filled up
    work            (B, 4) J: contacts, damping, external, and what was put into the tets
    frame           (B, 3, 3) mean deformation gradient, or None where nobody asks for it; needed with `apart`
    mean_slope      (N, 3) 1/m, mean gradient over the block of the node's shape function; None without frame
    apart           rows like force: u_b - u_a of every contact, see levers.py; None for 0
    patches         (N, 3) N, forces of detected contacts on the nodes, or None
    """

    v: np.ndarray
    dt_over_mass: np.ndarray
    contact: np.ndarray
    hold: np.ndarray
    inner: np.ndarray
    start: np.ndarray
    code: np.ndarray
    node_start: np.ndarray
    group_start: np.ndarray
    corner: np.ndarray
    slope: np.ndarray
    volume: np.ndarray
    lame: np.ndarray
    work: np.ndarray | None = None
    load: np.ndarray | None = None
    guess: np.ndarray | None = None
    change: np.ndarray | None = None
    corner_between: np.ndarray | None = None
    fraction_between: np.ndarray | None = None
    start_between: np.ndarray | None = None
    first_between: np.uint32 | None = None
    pull_start: np.ndarray | None = None
    pull_code: np.ndarray | None = None
    pull_fraction: np.ndarray | None = None
    frame: np.ndarray | None = None
    mean_slope: np.ndarray | None = None
    apart: np.ndarray | None = None
    patches: np.ndarray | None = None


@register_jitable(inline="always")
def _deformation(h):
    """F = 1 + h."""
    return h[0] + 1.0, h[1], h[2], h[3], h[4] + 1.0, h[5], h[6], h[7], h[8] + 1.0


@register_jitable(inline="always")
def _push(p, x, y, z):
    """Force of a tet's stress p against the node whose shape function has the gradient (x, y, z)."""
    return p[0] * x + p[1] * y + p[2] * z, p[3] * x + p[4] * y + p[5] * z, p[6] * x + p[7] * y + p[8] * z


def update_positions(body, dt, u):
    """Advance the nodes by dt v, and with them the points between nodes and the frames."""
    v, start, frame, mean_slope = body.v, body.node_start, body.frame, body.mean_slope
    corner, fraction, begin, first = body.corner_between, body.fraction_between, body.start_between, body.first_between
    for b in prange(len(body.lame)):
        for n in range(start[b], start[b + 1]):
            for i in range(0, 3, FOUR):
                put(u, (n, i), take(u, (n, i), four()) + dt * take(v, (n, i), four()))
        interpolate(corner, fraction, begin, first, b, u)
        _put_frame(frame, mean_slope, start, b, u)


@register_jitable
def _put_frame(frame, mean_slope, start, b, u):
    """Write the mean deformation gradient of block b."""
    if frame is None:
        return
    by_x = by_y = by_z = pack((0.0, 0.0, 0.0, 0.0))
    for n in range(start[b], start[b + 1]):
        moved = take_row(u, n)
        by_x = plus(by_x, mean_slope[n, 0], moved)
        by_y = plus(by_y, mean_slope[n, 1], moved)
        by_z = plus(by_z, mean_slope[n, 2], moved)
    x, y, z = numbers(by_x), numbers(by_y), numbers(by_z)
    put_matrix(frame, b, (1.0 + x[0], y[0], z[0], x[1], 1.0 + y[1], z[1], x[2], y[2], 1.0 + z[2]))


@register_jitable
def _couple(apart, frame, first, last, start, code, pull_start, pull_code, pull_fraction, force, b):
    """T F^-T, with T of the couple of the forces on sides a about their material points; 0 without `apart`."""
    if apart is None:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    by_x = by_y = by_z = pack((0.0, 0.0, 0.0, 0.0))
    for k in range(start[first], start[last]):
        c, on_a = code[k] >> 1, 1.0 - (code[k] & 1)
        row = take_row(force, c)
        by_x, by_y = plus(by_x, on_a * apart[c, 0], row), plus(by_y, on_a * apart[c, 1], row)
        by_z = plus(by_z, on_a * apart[c, 2], row)
    if pull_start is not None:
        for k in range(pull_start[first], pull_start[last]):
            c, on_a = pull_code[k] >> 1, pull_fraction[k] * (1.0 - (pull_code[k] & 1))
            row = take_row(force, c)
            by_x, by_y = plus(by_x, on_a * apart[c, 0], row), plus(by_y, on_a * apart[c, 1], row)
            by_z = plus(by_z, on_a * apart[c, 2], row)
    x, y, z = numbers(by_x), numbers(by_y), numbers(by_z)
    couple = y[2] - z[1], z[0] - x[2], x[1] - y[0]
    return product(skew(couple), transposed(inverse(matrix_at(frame, b))))


@register_jitable
def _turned(apart, mean_slope, n, couple, contact):
    """The force on node n with its share of the couple of its block."""
    if apart is None:
        return contact
    contact = plus(contact, mean_slope[n, 0], pack((couple[0], couple[3], couple[6], 0.0)))
    contact = plus(contact, mean_slope[n, 1], pack((couple[1], couple[4], couple[7], 0.0)))
    return plus(contact, mean_slope[n, 2], pack((couple[2], couple[5], couple[8], 0.0)))


@register_jitable
def _patched(patches, n, contact):
    """The force on node n with that of detected contacts."""
    if patches is None:
        return contact
    return plus(contact, 1.0, take_row(patches, n))


def move(body, dt, damping, loading, force, u):
    """Eq. (4) with F S in place of the stress: of every tet to its corners; then contacts, damping and motion."""
    inner, corner, slope, volume, lame = body.inner, body.corner, body.slope, body.volume, body.lame
    start, code, v, work, frame, mean_slope = body.start, body.code, body.v, body.work, body.frame, body.mean_slope
    pull_start, pull_code, pull_fraction = body.pull_start, body.pull_code, body.pull_fraction
    apart, patches = body.apart, body.patches
    for b in prange(len(lame)):
        first, last = body.node_start[b], body.node_start[b + 1]
        drawn = four()
        for n in range(first, last):
            for i in range(0, 3, FOUR):
                drawn = drawn + take(inner, (n, i), four()) * take(v, (n, i), four())
                put(inner, (n, i), four())
        for t in range(body.group_start[b], body.group_start[b + 1]):
            for j in range(0, 8, EIGHT):
                g, size = take_slopes(slope, t, j, eight()), take(volume, (t, j), eight())
                h = gradient(gather_corners(u, corner, t, j, eight()), g)
                p = times_symmetric(_deformation(h), second_piola(strain(h), -lame[b, 0] * size, -lame[b, 1] * size))
                px, py, pz = _push(p, g[0], g[1], g[2])
                qx, qy, qz = _push(p, g[3], g[4], g[5])
                rx, ry, rz = _push(p, g[6], g[7], g[8])
                scatter(inner, corner, (t, 0, j), -(px + qx + rx), -(py + qy + ry), -(pz + qz + rz))
                scatter(inner, corner, (t, 1, j), px, py, pz)
                scatter(inner, corner, (t, 2, j), qx, qy, qz)
                scatter(inner, corner, (t, 3, j), rx, ry, rz)
        couple = _couple(apart, frame, first, last, start, code, pull_start, pull_code, pull_fraction, force, b)
        done = four(), four(), four()
        for n in range(first, last):
            contact = pack((0.0, 0.0, 0.0, 0.0))
            for k in range(start[n], start[n + 1]):
                contact = plus(contact, 1.0 - 2.0 * (code[k] & 1), take_row(force, code[k] >> 1))
            contact = pulled(pull_start, pull_code, pull_fraction, n, force, contact)
            contact = _patched(patches, n, _turned(apart, mean_slope, n, couple, contact))
            for i in range(0, 3, FOUR):
                inner_force = take(inner, (n, i), four())
                drawn = drawn + inner_force * take(v, (n, i), four())
                done = advance(body, (n, i), part(contact, i), inner_force, dt, damping, loading, done)
        keep(work, b, done)
        keep_drawn(work, b, 0.5 * dt * total(drawn))


@jit
def observe(body, u, stress):
    """Write the mean of Cauchy's stress over every block as it is now (B, 6) Pa times its volume at the start.

    Returns the elastic energy (J), the least det F of any tet, and a bound on the largest stretch of any line.
    """
    energy, smallest, largest = 0.0, np.inf, 0.0
    for b in range(len(body.lame)):
        stress[b] = 0.0
        before = now = 0.0
        for t in range(body.group_start[b], body.group_start[b + 1]):
            for j in range(8):
                if body.volume[t, j] == 0.0:
                    continue
                size, g = body.volume[t, j], take_slopes(body.slope, t, j, 0.0)
                h = gradient(gather_corners(u, body.corner, t, j, 0.0), g)
                e, f = strain(h), _deformation(h)
                s, jacobian = second_piola(e, body.lame[b, 0], body.lame[b, 1]), determinant(f)
                p = product(times_symmetric(f, s), transposed(f))
                for i, value in enumerate((p[0], p[4], p[8], p[5], p[2], p[1])):
                    stress[b, i] += size * value
                energy += size * work_density(s, e)
                before, now = before + size, now + size * jacobian
                smallest, largest = min(smallest, jacobian), max(largest, largest_stretch(e))
        for i in range(6):
            stress[b, i] *= before / now
    return energy, smallest, largest


def mean_slopes(
    nodes: int, corner: np.ndarray, slope: np.ndarray, volume: np.ndarray, node_start: np.ndarray
) -> np.ndarray:
    """(N, 3) `mean_slope` of the tets' gradients: sum of V grad N over each node's tets, over its block's volume."""
    found, size = np.zeros((nodes, 3)), np.zeros(nodes)
    last = (slope * volume[:, None]).reshape(-1, 3, 3, 8)
    for k, part_of in enumerate((-last.sum(axis=1), last[:, 0], last[:, 1], last[:, 2])):
        np.add.at(found, corner[:, k].ravel(), part_of.transpose(0, 2, 1).reshape(-1, 3))
        np.add.at(size, corner[:, k].ravel(), 0.25 * volume.ravel())
    block = np.add.reduceat(size, node_start[:-1])
    return found / np.repeat(block, np.diff(node_start))[:, None]
