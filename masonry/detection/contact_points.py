"""Contact points of a pair: the corners of the overlap of two faces, or the place where two edges cross."""

from math import inf, sqrt

from masonry.detection.clip import area_and_centroid, cut_by
from masonry.detection.corners import MERGED, merge, weigh
from masonry.detection.features import CUT, corner_feature, crossing_feature, lone_feature
from masonry.detection.overlap import heights, point_of
from masonry.jit.compiler import inlined, inner


@inlined
def polygon_points(
    u, v, label, row, count, full, plane, snap, reach, minimum_area, face_a, face_b, weight, name,
    point, gap, area, feature,
):  # fmt: skip
    """The corners of an overlap of area `full` (m2), cut where the gap is wider than `reach`; returns their number.

    Points lie midway between the faces, from the position of the first body. Of an overlap that is cut, the areas add
    up to min(full, least) or more: a block on its edge or corner then rests on a stiffness that stays.
    """
    gu, gv = plane.bu - plane.au, plane.bv - plane.av
    slope = sqrt(gu * gu + gv * gv)
    if slope > 0.0:
        level = (reach - plane.b0) / slope
        row, count = cut_by(u, v, label, weight, row, count, 0.0, 0.0, gu / slope, gv / slope, level, CUT, snap)
    elif plane.b0 > reach:
        count = 0
    if count < 3:
        return 0
    total, cu, cv = area_and_centroid(u, v, row, count)
    if total <= 0.0:
        return 0
    weigh(u, v, row, count, cu, cv, weight)
    for k in range(count):
        name[k] = corner_feature(face_a, face_b, label[row, k - 1 if k > 0 else count - 1], label[row, k])
    count = merge(u, v, name, row, count, weight, MERGED * sqrt(total))
    factor = max(1.0, min(full, minimum_area) / total)
    for k in range(count):
        low, high = heights(plane, u[row, k], v[row, k])
        point[k, 0], point[k, 1], point[k, 2] = point_of(plane, u[row, k], v[row, k], 0.5 * (low + high))
        gap[k], area[k], feature[k] = high - low, factor * weight[k], name[k]
    return count


@inner
def crossing_point(
    vertex, edge, first_a, first_b, ea, eb, dx, dy, dz, nx, ny, nz, apart, minimum_area, point, gap, area, feature
):  # fmt: skip
    """The point midway between two crossed edges, of area `minimum_area`; returns 1, or 0 where they do not cross."""
    p, q, r, s = edge[ea, 0], edge[ea, 1], edge[eb, 0], edge[eb, 1]
    ax, ay, az = vertex[q, 0] - vertex[p, 0], vertex[q, 1] - vertex[p, 1], vertex[q, 2] - vertex[p, 2]
    bx, by, bz = vertex[s, 0] - vertex[r, 0], vertex[s, 1] - vertex[r, 1], vertex[s, 2] - vertex[r, 2]
    x, y, z = vertex[r, 0] + dx - vertex[p, 0], vertex[r, 1] + dy - vertex[p, 1], vertex[r, 2] + dz - vertex[p, 2]
    cx, cy, cz = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
    square = cx * cx + cy * cy + cz * cz
    on_a = (cx * (y * bz - z * by) + cy * (z * bx - x * bz) + cz * (x * by - y * bx)) / square
    on_b = (cx * (y * az - z * ay) + cy * (z * ax - x * az) + cz * (x * ay - y * ax)) / square
    if not (0.0 <= on_a <= 1.0 and 0.0 <= on_b <= 1.0):
        return 0
    point[0, 0] = vertex[p, 0] + on_a * ax + 0.5 * apart * nx
    point[0, 1] = vertex[p, 1] + on_a * ay + 0.5 * apart * ny
    point[0, 2] = vertex[p, 2] + on_a * az + 0.5 * apart * nz
    gap[0], area[0], feature[0] = apart, minimum_area, crossing_feature(ea - first_a, eb - first_b)
    return 1


@inner
def corner_point(
    vertex, first, last, dx, dy, dz, nx, ny, nz, side, apart, minimum_area, face, point, gap, area, feature
):  # fmt: skip
    """The corner first..last of a piece that is deepest in the other one, of area `minimum_area`, where their two
    faces do not overlap: a corner of another face. side: 1 for the second piece, -1 for the first; face: of the other
    piece."""
    deepest, lowest = first, inf
    for k in range(first, last):
        height = side * (nx * vertex[k, 0] + ny * vertex[k, 1] + nz * vertex[k, 2])
        if height < lowest:
            deepest, lowest = k, height
    offset = -0.5 * side * apart
    point[0, 0] = vertex[deepest, 0] + dx + offset * nx
    point[0, 1] = vertex[deepest, 1] + dy + offset * ny
    point[0, 2] = vertex[deepest, 2] + dz + offset * nz
    gap[0], area[0], feature[0] = apart, minimum_area, lone_feature(face, deepest - first, side)
