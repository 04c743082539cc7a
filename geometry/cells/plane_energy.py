"""Power diagrams of the plane, cell by cell, and how far they are from what is asked: one number with its gradient.

The energy is a sum over cells of (area / target - 1)^2, over edges shorter than a threshold of (1 - length /
threshold)^2, and the same over short segments of joints, where the corners of cells on both sides count. A vertex is
the solution of two linear equations in its three generators (cells or walls), so what the energy wants of a vertex is
handed on to the generators by one adjoint solve; the division stays a power diagram, with straight edges, throughout.
"""

from typing import NamedTuple

import numpy as np

from geometry.jit_cache import compiled

MOST = 64
"""Corners that a cell may have while it is cut."""


class Domains(NamedTuple):
    """U convex polygons with W walls in all. A corner is the start of a wall; walls run counter-clockwise.

    cell_start, wall_start  (U + 1,) cells and walls of each polygon
    corner                  (W, 2)
    normal, offset          (W, 2), (W,) inside: normal . x <= offset
    line                    (W,) number of the joint that the wall lies in, or -1
    along                   (W, 2) direction in which the joint is measured
    """

    cell_start: np.ndarray
    wall_start: np.ndarray
    corner: np.ndarray
    normal: np.ndarray
    offset: np.ndarray
    line: np.ndarray
    along: np.ndarray


class PlaneTargets(NamedTuple):
    """target (n,) areas; thresholds of edges and joint segments; weights of the three sums."""

    target: np.ndarray
    edge: float
    segment: float
    of_size: float
    of_edges: float
    of_segments: float


@compiled
def cut_cell(i, site, weight, order, place, rank, heaviest, at, label, spare, spare_label, count):
    """Cell i, cut out of the polygon whose count corners stand in at and label, by the cells of the same polygon.

    order, place  cells of the polygon sorted along its longer side, and where they stand; i is number rank of them
    A label is a cell, or -1 - wall. Returns the number of corners, 0 for an empty cell, -1 where there are too many.
    """
    x, z = site[i, 0], site[i, 1]
    reach = _reach(at, count, x, z)
    bonus = min(0.0, weight[i] - heaviest)
    lower, upper = rank - 1, rank + 1
    while lower >= 0 or upper < len(order):
        to_left = place[rank] - place[lower] if lower >= 0 else np.inf
        to_right = place[upper] - place[rank] if upper < len(order) else np.inf
        distance = min(to_left, to_right)
        level = 0.5 * (distance * distance + bonus)  # no cell from here on cuts nearer than level / distance
        if level > 0.0 and level * level >= distance * distance * reach:
            break
        if to_left <= to_right:
            j = order[lower]
            lower -= 1
        else:
            j = order[upper]
            upper += 1
        a, b = site[j, 0] - x, site[j, 1] - z
        square = a * a + b * b
        level = 0.5 * (square + weight[i] - weight[j])  # a (X - x) + b (Z - z) <= level
        if level > 0.0 and level * level >= square * reach:
            continue
        if square == 0.0:
            return 0  # two sites in one place: neither has a cell
        remaining = _cut(a, b, level, j, x, z, at, label, spare, spare_label, count)
        if remaining < 0:
            continue
        count = remaining
        if count < 3:
            return 0
        if count >= MOST - 1:
            return -1
        for k in range(count):
            at[k, 0], at[k, 1], label[k] = spare[k, 0], spare[k, 1], spare_label[k]
        reach = _reach(at, count, x, z)
    return count


@compiled
def _cut(a, b, level, j, x, z, at, label, spare, spare_label, count):
    """The part of a convex polygon with a (X - x) + b (Z - z) <= level, in spare; its corners, or -1 if that is all."""
    corners, outside = 0, False
    here = a * (at[0, 0] - x) + b * (at[0, 1] - z) - level
    for k in range(count):
        after = k + 1 if k + 1 < count else 0
        there = a * (at[after, 0] - x) + b * (at[after, 1] - z) - level
        if here <= 0.0:
            spare[corners, 0], spare[corners, 1], spare_label[corners] = at[k, 0], at[k, 1], label[k]
            corners += 1
        else:
            outside = True
        if (here <= 0.0) != (there <= 0.0):
            fraction = here / (here - there)
            spare[corners, 0] = at[k, 0] + fraction * (at[after, 0] - at[k, 0])
            spare[corners, 1] = at[k, 1] + fraction * (at[after, 1] - at[k, 1])
            spare_label[corners] = j if here <= 0.0 else label[k]
            corners += 1
        here = there
    return corners if outside else -1


@compiled
def _reach(at, count, x, z):
    """Largest squared distance from (x, z) to a corner."""
    largest = 0.0
    for k in range(count):
        square = (at[k, 0] - x) ** 2 + (at[k, 1] - z) ** 2
        if square > largest:
            largest = square
    return largest


@compiled
def _hand_on(i, a, b, vx, vz, gx, gz, site, normal, to_site, to_weight):
    """Gradient (gx, gz) of the vertex between cell i and the generators a and b, handed on to the generators."""
    if a < 0 and b < 0:
        return
    ax, az = _row(i, a, site, normal)
    bx, bz = _row(i, b, site, normal)
    det = ax * bz - az * bx
    if abs(det) < 1e-12:
        return
    for generator, factor in ((a, (gx * bz - gz * bx) / det), (b, (gz * ax - gx * az) / det)):
        if generator >= 0:
            to_site[generator, 0] += factor * (site[generator, 0] - vx)
            to_site[generator, 1] += factor * (site[generator, 1] - vz)
            to_site[i, 0] -= factor * (site[i, 0] - vx)
            to_site[i, 1] -= factor * (site[i, 1] - vz)
            to_weight[generator] -= 0.5 * factor
            to_weight[i] += 0.5 * factor


@compiled
def _row(i, generator, site, normal):
    if generator >= 0:
        return site[generator, 0] - site[i, 0], site[generator, 1] - site[i, 1]
    return normal[-1 - generator, 0], normal[-1 - generator, 1]


@compiled
def tessellate(site, weight, domains, at, label, count):
    """Corners (n, MOST, 2), labels (n, MOST) and their number (n,) of every cell; returns whether all had room."""
    spare, spare_label = np.empty((MOST, 2)), np.empty(MOST, dtype=np.int64)
    for u in range(len(domains.cell_start) - 1):
        wall_first, wall_last = domains.wall_start[u], domains.wall_start[u + 1]
        first, last = domains.cell_start[u], domains.cell_start[u + 1]
        corner = domains.corner[wall_first:wall_last]
        axis = 0 if np.ptp(corner[:, 0]) >= np.ptp(corner[:, 1]) else 1
        order = np.argsort(site[first:last, axis].copy()) + first  # a copy: one sort is compiled, not two
        place = site[order, axis]
        heaviest = weight[first:last].max()
        for rank in range(len(order)):
            i = order[rank]
            for k in range(len(corner)):
                at[i, k, 0], at[i, k, 1], label[i, k] = corner[k, 0], corner[k, 1], -1 - (wall_first + k)
            count[i] = cut_cell(
                *(i, site, weight, order, place, rank, heaviest),
                *(at[i], label[i], spare, spare_label, len(corner)),
            )
            if count[i] < 0:
                return False
    return True


@compiled
def energy(site, weight, domains, wishes, at, label, count, to_site, to_weight):
    """The energy; its gradient is written to to_site (n, 2) and to_weight (n,). Infinite for a cell without area."""
    to_site[:], to_weight[:] = 0.0, 0.0
    if not tessellate(site, weight, domains, at, label, count):
        return np.inf
    total = 0.0
    pull = np.empty((MOST, 2))
    for i in range(len(site)):
        if count[i] < 3:
            return np.inf
        total += _of_cell(i, at[i], label[i], count[i], wishes, pull)
        for k in range(count[i]):
            if pull[k, 0] != 0.0 or pull[k, 1] != 0.0:
                before = label[i, k - 1] if k > 0 else label[i, count[i] - 1]
                _hand_on(
                    *(i, before, label[i, k], at[i, k, 0], at[i, k, 1], pull[k, 0], pull[k, 1]),
                    *(site, domains.normal, to_site, to_weight),
                )
    if wishes.of_segments > 0.0:
        total += _of_joints(site, domains, wishes, at, label, count, to_site, to_weight)
    return total


@compiled
def _of_cell(i, at, label, count, wishes, pull):
    """Size and edges of cell i, each edge between two cells once; what they want of the corners goes into pull."""
    area = 0.0
    for k in range(count):
        m = k + 1 if k + 1 < count else 0
        area += at[k, 0] * at[m, 1] - at[k, 1] * at[m, 0]
    excess = 0.5 * area / wishes.target[i] - 1.0
    slope = wishes.of_size * excess / wishes.target[i]
    total = wishes.of_size * excess * excess
    for k in range(count):
        m, before = (k + 1 if k + 1 < count else 0), (k - 1 if k > 0 else count - 1)
        pull[k, 0] = slope * (at[m, 1] - at[before, 1])
        pull[k, 1] = slope * (at[before, 0] - at[m, 0])
    for k in range(count):
        if 0 <= label[k] < i:
            continue
        m = k + 1 if k + 1 < count else 0
        x, z = at[m, 0] - at[k, 0], at[m, 1] - at[k, 1]
        length = np.sqrt(x * x + z * z)
        if length < wishes.edge:
            lack = 1.0 - length / wishes.edge
            total += wishes.of_edges * lack * lack
            if length > 1e-12:
                factor = -2.0 * wishes.of_edges * lack / (wishes.edge * length)
                pull[m, 0] += factor * x
                pull[m, 1] += factor * z
                pull[k, 0] -= factor * x
                pull[k, 1] -= factor * z
    return total


@compiled
def joint_points(domains, at, label, count):
    """Where edges of cells begin on walls in joints: line (m,), place along it (m,), cell (m,), corner (m,)."""
    number = 0
    for i in range(len(count)):
        for k in range(count[i]):
            if label[i, k] < 0 and domains.line[-1 - label[i, k]] >= 0:
                number += 2
    line, place = np.empty(number, dtype=np.int64), np.empty(number)
    cell, corner = np.empty(number, dtype=np.int64), np.empty(number, dtype=np.int64)
    m = 0
    for i in range(len(count)):
        for k in range(count[i]):
            wall = -1 - label[i, k]
            if wall < 0 or domains.line[wall] < 0:
                continue
            for end in (k, k + 1 if k + 1 < count[i] else 0):
                line[m], cell[m], corner[m] = domains.line[wall], i, end
                place[m] = domains.along[wall, 0] * at[i, end, 0] + domains.along[wall, 1] * at[i, end, 1]
                m += 1
    return line, place, cell, corner


@compiled
def _of_joints(site, domains, wishes, at, label, count, to_site, to_weight):
    """Short segments between corners that follow each other along a joint, from cells on either side."""
    line, place, cell, corner = joint_points(domains, at, label, count)
    order = np.argsort(line * 1e6 + place)
    total = 0.0
    for n in range(len(order) - 1):
        p, q = order[n], order[n + 1]
        gap = place[q] - place[p]
        if line[p] != line[q] or gap >= wishes.segment or gap < 1e-9:
            continue
        lack = 1.0 - gap / wishes.segment
        total += wishes.of_segments * lack * lack
        slope = -2.0 * wishes.of_segments * lack / wishes.segment
        for point, gradient in ((q, slope), (p, -slope)):
            i, k = cell[point], corner[point]
            before = label[i, k - 1] if k > 0 else label[i, count[i] - 1]
            a = label[i, k]
            wall = -1 - (a if a < 0 else before)
            if wall >= 0 and domains.line[wall] == line[point]:
                x, z = gradient * domains.along[wall, 0], gradient * domains.along[wall, 1]
                _hand_on(i, before, a, at[i, k, 0], at[i, k, 1], x, z, site, domains.normal, to_site, to_weight)
    return total
