"""How far faces are crushed, kept where it happened: in cells that are fixed on the faces of blocks.

The plastic closing of a contact belongs half to each of its two faces, at the place where it happened. Points of a
patch remember it while the patch stays as it is; before a look, what it grew goes to the cells, each of which belongs
to one point, and points that come new read it from the cells that they lie in. So it is there again where a toe lifts
and comes back, and moves along with a block that slides. The cells are only ever added to: a look smears nothing.

Patches of two faces crush. Edges and corners do not: their area is a number of the model (Search.minimum_area).
"""

from typing import NamedTuple

import numpy as np

from masonry.detection.narrow import FACE
from masonry.detection.pieces import ConvexPieces
from masonry.detection.spread import layers
from masonry.jit.compiler import inner
from masonry.kinematics.planes import into, turned
from masonry.patches.arrays import AREA, PLACE, between, number_of, vector_of
from masonry.patches.crushed_points import CELL, CLOSING, HARDENING, KEPT, crushed_of, put_crushed_of
from masonry.simd import FOUR

CELLS, FEWEST, MOST = 20, 8, 256
"""Along an edge as long as the size of most blocks; along any side of a face."""
OF_TETS = 4
"""Along the sides of a triangle of a mesh."""


class CrushedFaces(NamedTuple):
    """Crushing of F faces, in cells over a rectangle that has a side along the longest edge of the face.

    corner    (F, 3) m, where the cells begin, from the centroid of the body, in its frame
    along, across   (F, 3) 1/m: the place from that corner times them is how many cells it is away
    number    (F, 2) of cells along and across; first (F + 1,) those of face f begin there, one row along after another
    closing, hardening   (G,) m of all cells, the half of their face; begun (F,) whether any is not 0
    """

    corner: np.ndarray
    along: np.ndarray
    across: np.ndarray
    number: np.ndarray
    first: np.ndarray
    closing: np.ndarray
    hardening: np.ndarray
    begun: np.ndarray


def crushed_faces(pieces: ConvexPieces, size: np.ndarray) -> CrushedFaces:
    """All faces of some pieces, of which nothing is crushed; size (B,) m of the blocks, behind which come bodies that
    are tets of a mesh."""
    count, cell = len(pieces.normal), float(np.median(size)) / CELLS
    meshed = np.repeat(pieces.body, np.diff(pieces.face_start)) >= len(size)
    corner, along, across = (np.zeros((count, 3)) for _ in range(3))
    number = np.full((count, 2), OF_TETS, dtype=np.int64)
    for f in range(count):
        loop = pieces.vertex[pieces.loop[pieces.loop_start[f] : pieces.loop_start[f + 1]]]
        edge = np.roll(loop, -1, axis=0) - loop
        length = np.linalg.norm(edge, axis=1)
        u_axis = edge[np.argmax(length >= (1.0 - 1e-9) * length.max())] / length.max()
        v_axis = np.cross(pieces.normal[f], u_axis)
        u, v = loop @ u_axis, loop @ v_axis
        corner[f] = u.min() * u_axis + v.min() * v_axis + (loop[0] @ pieces.normal[f]) * pieces.normal[f]
        extent = np.array([np.ptp(u), np.ptp(v)])
        if not meshed[f]:
            number[f] = np.clip(np.ceil(extent / cell), FEWEST, MOST)
        along[f], across[f] = u_axis * number[f, 0] / extent[0], v_axis * number[f, 1] / extent[1]
    first = np.append(0, np.cumsum(number.prod(axis=1)))
    return CrushedFaces(
        corner, along, across, number, first, np.zeros(first[-1]), np.zeros(first[-1]), np.zeros(count, dtype=bool)
    )


@inner
def place_on_face(near, pairs, p, side, k):
    """m, from the centroid of the block on a side of pair p, in its frame: where point k of the pair is."""
    motion, owner = near.motion, pairs.points_of[p]
    place = vector_of(near.points, pairs.slot[p], k, PLACE)
    if side == owner:
        return place
    ref, other = pairs.body[p, side], pairs.body[p, owner]
    a, o = turned(motion.frame, other, *place), between(motion.centre, motion.moved, ref, other)
    return into(motion.frame, motion.dual, ref, a[0] + o[0], a[1] + o[1], a[2] + o[2])


@inner
def in_cells(crushed, f, place):
    """Where a place (m, in the frame of its body) is on face f, in cells along and across."""
    u = v = 0.0
    for i in range(3):
        u += (place[i] - crushed.corner[f, i]) * crushed.along[f, i]
        v += (place[i] - crushed.corner[f, i]) * crushed.across[f, i]
    return u, v


@inner
def row_at(place, rows):
    """The row of cells at a place in cells."""
    return min(max(int(place), 0), rows - 1)


@inner
def keep_crushing(crushed, near, pairs, p):
    """Transfer to the faces of the crushing of pair p's points since they last told; before a look, or their end."""
    if crushed is not None:
        s = pairs.slot[p]
        if s >= 0 and has_grown(near.points, s):
            for side in range(2):
                write_face(crushed, near, pairs, p, side)
            for k in range(near.points.number[s]):
                for row in (CLOSING, HARDENING):
                    put_crushed_of(near.points.crushed, s, k, KEPT + row, crushed_of(near.points.crushed, s, k, row))


@inner
def has_grown(points, s):
    """Whether a point of slot s was crushed further since it last told."""
    maximum = 0.0
    for k in range(points.number[s]):
        maximum = max(maximum, grown(points.crushed, s, k, HARDENING))
    return maximum > 0.0


@inner
def grown(crushed, s, k, row):
    """By how much a number of point k of slot s grew since it last told."""
    return crushed_of(crushed, s, k, row) - crushed_of(crushed, s, k, KEPT + row)


@inner
def write_face(crushed, near, pairs, p, side):
    """Add half of what the points grew to the cells of the face on a side, each within the region of one point."""
    points, s, f = near.points, pairs.slot[p], pairs.witness[p, 1 + side]
    middle, window = outline(crushed, near, pairs, p, side)
    crushed.begun[f] = True
    for i in range(window[0], window[1]):
        for j in range(window[2], window[3]):
            k = point_around(near, s, middle, i + 0.5, j + 0.5)
            if k >= 0:
                cell = crushed.first[f] + i * crushed.number[f, 1] + j
                crushed.closing[cell] += 0.5 * grown(points.crushed, s, k, CLOSING)
                crushed.hardening[cell] += 0.5 * grown(points.crushed, s, k, HARDENING)


@inner
def read_face(crushed, near, p, side):
    """Add to footprint.shear, row k: closing and hardening (m) of the face on a side in the region of point k, as the
    mean of its cells; where it has none, of the cell that it lies in."""
    pairs, numbers = near.pairs, near.footprint.shear
    s, f = pairs.slot[p], pairs.witness[p, 1 + side]
    if not crushed.begun[f]:
        return
    middle, window = outline(crushed, near, pairs, p, side)
    cells = near.former.area
    for k in range(near.points.number[s]):
        cells[k] = 0.0
    for turn in range(2):  # first how many cells a point has, then their mean
        for i in range(window[0], window[1]):
            for j in range(window[2], window[3]):
                k = point_around(near, s, middle, i + 0.5, j + 0.5)
                if k >= 0:
                    cell = crushed.first[f] + i * crushed.number[f, 1] + j
                    if turn == 0:
                        cells[k] += 1.0
                    else:
                        numbers[k, 0] += crushed.closing[cell] / cells[k]
                        numbers[k, 1] += crushed.hardening[cell] / cells[k]
    for k in range(near.points.number[s]):
        if cells[k] == 0.0:
            cell = cell_of(crushed, near, pairs, p, side, k)
            numbers[k, 0] += crushed.closing[cell]
            numbers[k, 1] += crushed.hardening[cell]


@inner
def cell_of(crushed, near, pairs, p, side, k):
    """The number of the cell of the face on a side in which point k of pair p lies."""
    f = pairs.witness[p, 1 + side]
    u, v = in_cells(crushed, f, place_on_face(near, pairs, p, side, k))
    return crushed.first[f] + row_at(u, crushed.number[f, 0]) * crushed.number[f, 1] + row_at(v, crushed.number[f, 1])


@inner
def outline(crushed, near, pairs, p, side):
    """Write the corners of a patch, in cells of the face on a side, to scratch.edge_u and edge_v; returns how many they
    are and its middle, and the rows of cells along and across between which it lies."""
    points, s, f, u, v = (
        near.points,
        pairs.slot[p],
        pairs.witness[p, 1 + side],
        near.scratch.edge_u,
        near.scratch.edge_v,
    )
    along, across = crushed.number[f, 0], crushed.number[f, 1]
    count = points.number[s] // layers(points.feature[s], points.number[s])
    whole = middle_u = middle_v = 0.0
    first_u, last_u, first_v, last_v = along, 0, across, 0
    for k in range(count):
        u[0, k], v[0, k] = in_cells(crushed, f, place_on_face(near, pairs, p, side, k))
        area = number_of(points, s, k, AREA)
        whole, middle_u, middle_v = whole + area, middle_u + area * u[0, k], middle_v + area * v[0, k]
        i, j = row_at(u[0, k], along), row_at(v[0, k], across)
        first_u, last_u, first_v, last_v = min(first_u, i), max(last_u, i + 1), min(first_v, j), max(last_v, j + 1)
    scale = 1.0 / whole if whole > 0.0 else 0.0
    return (count, scale * middle_u, scale * middle_v), (first_u, last_u, first_v, last_v)


@inner
def point_around(near, s, middle, x, y):
    """The point of slot s in whose region a place in cells is, -1 outside of the patch; `middle` as of `outline`.

    Corner by corner (spread.py): from the middle to the corner the regions are as wide as the areas of their points.
    """
    u, v, (count, middle_u, middle_v) = near.scratch.edge_u, near.scratch.edge_v, middle
    x, y = x - middle_u, y - middle_v
    for k in range(count):
        j = k + 1 if k + 1 < count else 0
        ax, ay, bx, by = u[0, k] - middle_u, v[0, k] - middle_v, u[0, j] - middle_u, v[0, j] - middle_v
        across = ax * by - ay * bx
        if across == 0.0:
            continue
        of_one, of_other = (x * by - y * bx) / across, (ax * y - ay * x) / across
        if of_one < 0.0 or of_other < 0.0:
            continue
        corner, inwards = k if of_one >= of_other else j, 1.0 - of_one - of_other
        if inwards < 0.0:
            return -1
        whole, rounds = 0.0, near.points.number[s] // count
        for r in range(rounds):
            whole += number_of(near.points, s, r * count + corner, AREA)
        for r in range(rounds):
            inwards -= number_of(near.points, s, r * count + corner, AREA) / whole
            if inwards < 0.0:
                return r * count + corner
        return (rounds - 1) * count + corner
    return -1


@inner
def recall_crushing(crushed, near, p, count, former_count):
    """The new points of pair p remember what its faces do around them; those that stay in their cells have their own
    memory. Returns the most plastic closing (m)."""
    if crushed is None:
        return 0.0
    points, pairs, numbers, maximum = near.points, near.pairs, near.footprint.shear, 0.0
    s, touches = pairs.slot[p], pairs.witness[p, 0] == FACE and count >= 3
    for k in range(count):
        numbers[k, 0] = numbers[k, 1] = 0.0
    all_stay = touches and count == former_count
    for k in range(count):
        stays = touches and k < former_count and near.former.feature[k] == points.feature[s, k]
        for side in range(2):
            cell = float(cell_of(crushed, near, pairs, p, side, k)) if touches else -1.0
            stays = stays and crushed_of(points.crushed, s, k, CELL + side) == cell
            put_crushed_of(points.crushed, s, k, CELL + side, cell)
        numbers[k, 2] = 1.0 if stays else 0.0
        all_stay = all_stay and stays
    if touches and not all_stay:
        for side in range(2):
            read_face(crushed, near, p, side)
    for k in range(-(-count // FOUR) * FOUR):
        if k >= count or numbers[k, 2] == 0.0:
            for row in range(2):
                number = numbers[k, row] if k < count else 0.0
                put_crushed_of(points.crushed, s, k, row, number)
                put_crushed_of(points.crushed, s, k, KEPT + row, number)
        maximum = max(maximum, crushed_of(points.crushed, s, k, CLOSING))
    return maximum
