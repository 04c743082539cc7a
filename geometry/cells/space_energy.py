"""Power cells in space cut one by one, and how far they are from what is asked: one number with its gradient.

Qhull (power.py) has the last word on a diagram; here the same cells are found ten times faster, cell by cell from lists
of neighbours, for the many diagrams that are looked at on the way to a good one. A cell is kept as its dual: each
vertex is a triple of faces, and a table says which vertex lies on the left of each edge between two faces.

The energy of a cell is (volume / target - 1)^2 and its share of (1 - length / threshold)^2 of each edge that is shorter
than a threshold; an edge belongs in equal parts to the cells that meet in it. A vertex is the solution of three linear
equations in its generators (cells or walls), so what the energy wants of a vertex is handed on to the generators by one
adjoint solve; the division stays a power diagram, with planar faces, throughout.
"""

from typing import NamedTuple

import numpy as np

from geometry.jit_cache import compiled

MOST_FACES = 128
"""Planes that may cut one cell, those that later cuts remove among them."""
MOST_CORNERS = 256
FAR = -10_000_000
"""Label of a side of the box round the domain that is no wall."""


class Cut(NamedTuple):
    """Room for one cell: faces with label, normal and level (inside: normal . u <= level, u from the site), corners.

    used  faces, corners, and how often all sites had to be gone through
    """

    label: np.ndarray
    normal: np.ndarray
    level: np.ndarray
    corner: np.ndarray
    place: np.ndarray
    edge_corner: np.ndarray
    outside: np.ndarray
    rim: np.ndarray
    used: np.ndarray


class Diagram(NamedTuple):
    """Sites and weights, lists of neighbours, and walls of the domain.

    site, weight    (n, 3), (n,)
    near            (n, k) the sites nearest to each, in the order of their distance when the lists were made
    horizon         (n,) no site that is not in the list can cut off what is closer to site i than this
    box             (6,) low x, high x, low y, ... of the box round the domain, that cutting starts from
    box_label       (6,) the label of each of its sides: a wall, or FAR
    normal, offset  (m, 3), (m,) inside: normal . x <= offset
    wall            (m,) labels of the walls
    """

    site: np.ndarray
    weight: np.ndarray
    near: np.ndarray
    horizon: np.ndarray
    box: np.ndarray
    box_label: np.ndarray
    normal: np.ndarray
    offset: np.ndarray
    wall: np.ndarray


class SpaceTargets(NamedTuple):
    """Targets of a division.

    target        (n,) volumes
    scale         (n,) of the threshold about each cell
    edge          threshold of edges
    of_size       weight of the sizes against that of the edges
    of_triangles  how much the edges of its own triangles count for a cell, 0 to 1
    """

    target: np.ndarray
    scale: np.ndarray
    edge: float
    of_size: float
    of_triangles: float


def room() -> Cut:
    """Room for one cell of any diagram."""
    return Cut(
        label=np.zeros(MOST_FACES, dtype=np.int64),
        normal=np.zeros((MOST_FACES, 3)),
        level=np.zeros(MOST_FACES),
        corner=np.zeros((MOST_CORNERS, 3), dtype=np.int64),
        place=np.zeros((MOST_CORNERS, 3)),
        edge_corner=np.zeros((MOST_FACES, MOST_FACES), dtype=np.int32),
        outside=np.zeros(MOST_CORNERS, dtype=np.bool_),
        rim=np.zeros((MOST_CORNERS, 2), dtype=np.int64),
        used=np.zeros(3, dtype=np.int64),
    )


@compiled
def _crosses(cut, p, q, r):
    """Cross products of the normals of faces p, q and r, two by two, and the product of all three."""
    ax, ay, az = cut.normal[p]
    bx, by, bz = cut.normal[q]
    cx, cy, cz = cut.normal[r]
    ux, uy, uz = by * cz - bz * cy, bz * cx - bx * cz, bx * cy - by * cx
    vx, vy, vz = cy * az - cz * ay, cz * ax - cx * az, cx * ay - cy * ax
    wx, wy, wz = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
    det = ax * ux + ay * uy + az * uz
    return ux, uy, uz, vx, vy, vz, wx, wy, wz, det


@compiled
def _add_corner(cut, p, q, r):
    """A corner where faces p, q, r meet, counter-clockwise seen from outside; its place is solved for."""
    t = cut.used[1]
    cut.used[1] = t + 1
    cut.corner[t, 0], cut.corner[t, 1], cut.corner[t, 2] = p, q, r
    cut.edge_corner[p, q] = cut.edge_corner[q, r] = cut.edge_corner[r, p] = t
    ux, uy, uz, vx, vy, vz, wx, wy, wz, det = _crosses(cut, p, q, r)
    if det == 0.0:
        det = 1e-300
    f, g, h = cut.level[p] / det, cut.level[q] / det, cut.level[r] / det
    cut.place[t, 0] = f * ux + g * vx + h * wx
    cut.place[t, 1] = f * uy + g * vy + h * wy
    cut.place[t, 2] = f * uz + g * vz + h * wz


@compiled
def _begin(cut, site, box, box_label):
    """The box round the domain."""
    cut.used[0], cut.used[1] = 6, 0
    for k in range(6):
        outward = 1.0 if k % 2 else -1.0
        cut.label[k] = box_label[k]
        cut.normal[k] = 0.0
        cut.normal[k, k // 2] = outward
        cut.level[k] = outward * (box[k] - site[k // 2])
    for x in range(2):
        for y in range(2):
            for z in range(2):
                if (x + y + z) % 2 == 1:
                    _add_corner(cut, x, 2 + y, 4 + z)
                else:
                    _add_corner(cut, x, 4 + z, 2 + y)


@compiled
def _clip(cut, label, ax, ay, az, level):
    """Cut off what lies beyond a plane. Returns 1 if something is left, 0 if nothing, -1 where there is no room."""
    corners, gone = cut.used[1], 0
    for t in range(corners):
        cut.outside[t] = ax * cut.place[t, 0] + ay * cut.place[t, 1] + az * cut.place[t, 2] > level
        gone += cut.outside[t]
    if gone == 0:
        return 1
    if gone == corners:
        cut.used[1] = 0
        return 0
    f, rim = cut.used[0], 0
    if f >= MOST_FACES:
        return -1
    for t in range(corners):
        if cut.outside[t]:
            for k in range(3):
                p, q = cut.corner[t, k], cut.corner[t, (k + 1) % 3]
                if not cut.outside[cut.edge_corner[q, p]]:
                    cut.rim[rim, 0], cut.rim[rim, 1] = p, q
                    rim += 1
    if corners - gone + rim > MOST_CORNERS:
        return -1
    cut.used[0] = f + 1
    cut.label[f], cut.level[f] = label, level
    cut.normal[f, 0], cut.normal[f, 1], cut.normal[f, 2] = ax, ay, az
    stay = 0
    for t in range(corners):
        if not cut.outside[t]:
            if stay != t:
                p, q, r = cut.corner[t]
                cut.corner[stay, 0], cut.corner[stay, 1], cut.corner[stay, 2] = p, q, r
                cut.place[stay, 0], cut.place[stay, 1], cut.place[stay, 2] = cut.place[t]
                cut.edge_corner[p, q] = cut.edge_corner[q, r] = cut.edge_corner[r, p] = stay
            stay += 1
    cut.used[1] = stay
    for k in range(rim):
        _add_corner(cut, cut.rim[k, 0], cut.rim[k, 1], f)
    return 1


@compiled
def _reach(cut):
    """Distance of the farthest corner from the site."""
    maximum = 0.0
    for t in range(cut.used[1]):
        x, y, z = cut.place[t]
        maximum = max(maximum, x * x + y * y + z * z)
    return np.sqrt(maximum)


@compiled
def _cut_by(i, j, diagram, cut, reach):
    """Cut cell i by site j if that is close enough. Returns the reach of what is left; 0 if empty, -1 without room."""
    ax = diagram.site[j, 0] - diagram.site[i, 0]
    ay = diagram.site[j, 1] - diagram.site[i, 1]
    az = diagram.site[j, 2] - diagram.site[i, 2]
    square = ax * ax + ay * ay + az * az
    level = 0.5 * (square + diagram.weight[i] - diagram.weight[j])
    if level * abs(level) >= reach * reach * square:
        return reach
    status = _clip(cut, j, ax, ay, az, level)
    return _reach(cut) if status == 1 else float(status)


@compiled
def cut_cell(i, diagram, cut):
    """Cell i in cut. Returns the distance of its farthest corner from its site; 0 if empty, -1 without room."""
    _begin(cut, diagram.site[i], diagram.box, diagram.box_label)
    reach = _reach(cut)
    for j in diagram.near[i]:
        reach = _cut_by(i, j, diagram, cut, reach)
        if reach <= 0:
            return reach
    for w in range(len(diagram.offset)):
        ax, ay, az = diagram.normal[w]
        x, y, z = diagram.site[i]
        level = diagram.offset[w] - ax * x - ay * y - az * z
        if level < reach:
            status = _clip(cut, diagram.wall[w], ax, ay, az, level)
            if status < 1:
                return float(status)
            reach = _reach(cut)
    if reach > diagram.horizon[i]:
        cut.used[2] += 1
        for j in range(len(diagram.site)):
            if j != i and not _has_met(cut, j):
                reach = _cut_by(i, j, diagram, cut, reach)
                if reach <= 0:
                    return reach
    return reach


@compiled
def find_horizons(site, weight, near, horizon):
    """Fill in the horizons of a Diagram whose lists are made for these very sites and weights."""
    listed = np.zeros(len(site), dtype=np.bool_)
    for i in range(len(site)):
        listed[near[i]] = True
        listed[i] = True
        minimum = np.inf
        for j in range(len(site)):
            if not listed[j]:
                x, y, z = site[j, 0] - site[i, 0], site[j, 1] - site[i, 1], site[j, 2] - site[i, 2]
                square = x * x + y * y + z * z
                minimum = min(minimum, 0.5 * (square + weight[i] - weight[j]) / np.sqrt(square))
        horizon[i] = minimum
        listed[near[i]] = False
        listed[i] = False


@compiled
def _has_met(cut, j):
    for p in range(cut.used[0]):  # noqa: SIM110 - compiled
        if cut.label[p] == j:
            return True
    return False


@compiled
def _face(cut, p, start):
    """Area and first moments (about the site) of face p, whose loop goes through corner start."""
    area, mx, my, mz = 0.0, 0.0, 0.0, 0.0
    ox, oy, oz = cut.place[start]
    length = np.sqrt(cut.normal[p, 0] ** 2 + cut.normal[p, 1] ** 2 + cut.normal[p, 2] ** 2)
    nx, ny, nz = cut.normal[p, 0] / length, cut.normal[p, 1] / length, cut.normal[p, 2] / length
    t = _next(cut, p, start)
    ax, ay, az = cut.place[t, 0] - ox, cut.place[t, 1] - oy, cut.place[t, 2] - oz
    for _ in range(MOST_CORNERS):
        t = _next(cut, p, t)
        if t == start:
            break
        bx, by, bz = cut.place[t, 0] - ox, cut.place[t, 1] - oy, cut.place[t, 2] - oz
        part = 0.5 * (nx * (ay * bz - az * by) + ny * (az * bx - ax * bz) + nz * (ax * by - ay * bx))
        area += part
        mx += part * (ox + (ax + bx) / 3)
        my += part * (oy + (ay + by) / 3)
        mz += part * (oz + (az + bz) / 3)
        ax, ay, az = bx, by, bz
    return area, mx, my, mz, length


@compiled
def _next(cut, p, t):
    """The corner after t round face p, counter-clockwise."""
    for k in range(3):
        if cut.corner[t, k] == p:
            return cut.edge_corner[p, cut.corner[t, (k + 2) % 3]]
    return t


@compiled
def _some_corner(cut, start, sides):
    """start[p] becomes a corner of face p, or -1 where nothing is left of the face; sides[p] the number of them."""
    start[: cut.used[0]] = -1
    sides[: cut.used[0]] = 0
    for t in range(cut.used[1]):
        for k in range(3):
            start[cut.corner[t, k]] = t
            sides[cut.corner[t, k]] += 1


@compiled
def _push(cut, i, t, gx, gy, gz, site, to_site, to_weight):
    """Hand what is wanted of corner t (gx, gy, gz) on to its generators."""
    p, q, r = cut.corner[t]
    ux, uy, uz, vx, vy, vz, wx, wy, wz, det = _crosses(cut, p, q, r)
    if det == 0.0:
        return
    for k in range(3):
        if k == 0:
            lever = (gx * ux + gy * uy + gz * uz) / det
        elif k == 1:
            lever = (gx * vx + gy * vy + gz * vz) / det
        else:
            lever = (gx * wx + gy * wy + gz * wz) / det
        j = cut.label[cut.corner[t, k]]
        if j < 0:
            continue
        for d in range(3):
            x = site[i, d] + cut.place[t, d]
            to_site[j, d] -= lever * (x - site[j, d])
            to_site[i, d] += lever * (x - site[i, d])
        to_weight[j] -= 0.5 * lever
        to_weight[i] += 0.5 * lever


@compiled
def _edges(cut, i, wishes, site, to_site, to_weight, pulls, sides):
    """The cell's share of the energy of its short edges."""
    total = 0.0
    pulls[: cut.used[1]] = 0.0
    for t in range(cut.used[1]):
        for k in range(3):
            p, q = cut.corner[t, k], cut.corner[t, (k + 1) % 3]
            s = cut.edge_corner[q, p]
            if s <= t:
                continue
            x = cut.place[t, 0] - cut.place[s, 0]
            y = cut.place[t, 1] - cut.place[s, 1]
            z = cut.place[t, 2] - cut.place[s, 2]
            square = x * x + y * y + z * z
            cells, scale = 1, wishes.scale[i]
            if cut.label[p] >= 0:
                cells += 1
                scale += wishes.scale[cut.label[p]]
            if cut.label[q] >= 0:
                cells += 1
                scale += wishes.scale[cut.label[q]]
            threshold = wishes.edge * scale / cells
            if square < threshold * threshold:
                length = max(np.sqrt(square), 1e-12)
                short = 1 - length / threshold
                weight = 1 / 3
                if sides[p] == 3 or sides[q] == 3:
                    weight *= wishes.of_triangles
                total += short * short * weight
                pull = -2 * short / threshold / length * weight
                pulls[t, 0] += pull * x
                pulls[t, 1] += pull * y
                pulls[t, 2] += pull * z
                pulls[s, 0] -= pull * x
                pulls[s, 1] -= pull * y
                pulls[s, 2] -= pull * z
    if total > 0:
        for t in range(cut.used[1]):
            if pulls[t, 0] != 0.0 or pulls[t, 1] != 0.0 or pulls[t, 2] != 0.0:
                _push(cut, i, t, pulls[t, 0], pulls[t, 1], pulls[t, 2], site, to_site, to_weight)
    return total


@compiled
def _size(cut, i, wishes, site, to_site, to_weight, start, face):
    """The cell's energy of size; face (., 5) is room for area, moments and length of normal by face."""
    volume = 0.0
    for p in range(cut.used[0]):
        if start[p] >= 0:
            face[p, 0], face[p, 1], face[p, 2], face[p, 3], face[p, 4] = _face(cut, p, start[p])
            volume += face[p, 0] * cut.level[p] / face[p, 4] / 3
    lack = volume / wishes.target[i] - 1
    push = 2 * lack / wishes.target[i] * wishes.of_size
    for p in range(cut.used[0]):
        j = cut.label[p]
        if start[p] >= 0 and j >= 0:
            area, by_length = face[p, 0], push / face[p, 4]
            for d in range(3):
                moment = face[p, 1 + d]
                to_site[i, d] += by_length * moment
                to_site[j, d] -= by_length * (moment - area * (site[j, d] - site[i, d]))
            to_weight[i] += 0.5 * by_length * area
            to_weight[j] -= 0.5 * by_length * area
    return lack * lack * wishes.of_size


@compiled
def energy(cells, diagram, wishes, cut, of_cell, to_site, to_weight):
    """Energy of the cells listed, and its gradient to_site (n, 3), to_weight (n,); inf where one of them is empty.

    of_cell  (n,) becomes the energy of each cell listed
    """
    total = 0.0
    to_site[:] = 0.0
    to_weight[:] = 0.0
    start, sides = np.empty(MOST_FACES, dtype=np.int64), np.empty(MOST_FACES, dtype=np.int64)
    face, pulls = np.empty((MOST_FACES, 5)), np.empty((MOST_CORNERS, 3))
    for i in cells:
        if cut_cell(i, diagram, cut) <= 0:
            return np.inf
        _some_corner(cut, start, sides)
        of_cell[i] = _size(cut, i, wishes, diagram.site, to_site, to_weight, start, face)
        of_cell[i] += _edges(cut, i, wishes, diagram.site, to_site, to_weight, pulls, sides)
        total += of_cell[i]
    return total


@compiled
def measure(diagram, cut, volume, centroid, faces, neighbours, area):
    """Volume (n,) and centroid (n, 3) of all cells; their faces (n,), cells beyond (n, MOST_FACES) and areas."""
    start, sides = np.empty(MOST_FACES, dtype=np.int64), np.empty(MOST_FACES, dtype=np.int64)
    for i in range(len(diagram.site)):
        volume[i], faces[i] = 0.0, 0
        centroid[i] = diagram.site[i]
        if cut_cell(i, diagram, cut) <= 0:
            continue
        _some_corner(cut, start, sides)
        x, y, z = 0.0, 0.0, 0.0
        for p in range(cut.used[0]):
            if start[p] >= 0:
                a, mx, my, mz, length = _face(cut, p, start[p])
                part = cut.level[p] / length / 3
                volume[i] += part * a
                x += part * mx
                y += part * my
                z += part * mz
                if cut.label[p] >= 0:
                    neighbours[i, faces[i]], area[i, faces[i]] = cut.label[p], a
                    faces[i] += 1
        if volume[i] > 0:
            centroid[i, 0] += 0.75 * x / volume[i]
            centroid[i, 1] += 0.75 * y / volume[i]
            centroid[i, 2] += 0.75 * z / volume[i]
