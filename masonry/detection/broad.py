"""Which boxes are near each other: uniform cells filled by a counting sort, large boxes in a list of their own.

Boxes beyond the window of cells count as being in its outermost ones: neighbours stay neighbours. The pairs come out
sorted, so that they are the same whatever the order of the work.
"""

from math import sqrt
from typing import NamedTuple

import numpy as np

from masonry.detection.pieces import ConvexPieces
from masonry.jit.compiler import inner, jit

LARGE = 4.0
"""Times the mean extent along an axis: such boxes are tested against all others."""
WINDOW = 3.0
"""Standard deviations of the places on both sides of the mean that cells cover."""


class BoxGrid(NamedTuple):
    """Room for M boxes: low, high (M, 3) m; owner (M,): boxes of one owner are no pair; the rest is scratch."""

    low: np.ndarray
    high: np.ndarray
    owner: np.ndarray
    cell: np.ndarray
    start: np.ndarray
    order: np.ndarray
    large: np.ndarray
    grid: np.ndarray
    first: np.ndarray
    sorted: np.ndarray


def cells_of(owner: np.ndarray, most_pairs: int) -> BoxGrid:
    """Room for one box for each entry of owner (M,), and for so many pairs."""
    m = len(owner)
    return BoxGrid(
        np.zeros((m, 3)), np.zeros((m, 3)), owner.astype(np.int64), np.zeros((m, 3), dtype=np.int64),
        np.zeros(8 * m + 66, dtype=np.int64), np.zeros(m, dtype=np.int64), np.zeros(m, dtype=np.int64),
        np.zeros((3, 3)), np.zeros(m + 1, dtype=np.int64), np.zeros(most_pairs, dtype=np.int64),
    )  # fmt: skip


def cells_for(pieces: ConvexPieces, most_pairs: int) -> BoxGrid:
    """Room for the boxes of some pieces; pieces of one block are no pair."""
    return cells_of(pieces.block[pieces.body], most_pairs)


@jit
def write_boxes(pieces, turned, position, skin, cells):
    """Boxes round all pieces as they are placed, wider by half the skin (m) on every side."""
    low, high, vertex, vertex_start, body = cells.low, cells.high, turned.vertex, pieces.vertex_start, pieces.body
    half = 0.5 * skin
    for p in range(len(body)):
        b = body[p]
        for axis in range(3):
            minimum = maximum = vertex[vertex_start[p], axis]
            for v in range(vertex_start[p] + 1, vertex_start[p + 1]):
                minimum, maximum = min(minimum, vertex[v, axis]), max(maximum, vertex[v, axis])
            low[p, axis], high[p, axis] = position[b, axis] + minimum - half, position[b, axis] + maximum + half


@jit
def near_pairs(cells, pairs):
    """Write the pairs i < j of boxes that overlap or touch into pairs (C, 2), sorted; returns their number.

    A number above C, or above the room in `cells`, says how many there are; then not all of them are there.
    """
    low, high, owner, cell, large, order = cells.low, cells.high, cells.owner, cells.cell, cells.large, cells.order
    start, grid = cells.start, cells.grid
    _mark_large(low, high, large)
    nx, ny, nz = _lay_out(low, high, large, grid, len(start) - 2)
    _sort_in(low, large, grid, nx, ny, nz, cell, start, order)
    room = min(len(pairs), len(cells.sorted))
    count = _pairs_in_cells(low, high, owner, cell, start, order, nx, ny, nz, pairs, room)
    count = _pairs_of_large(low, high, owner, large, pairs, room, count)
    if count <= room:
        _sort_pairs(pairs, count, cells.first, cells.sorted)
    return count


@inner
def _mark_large(low, high, large):
    """large[i] = 1 for boxes that are longer along an axis than LARGE times the mean box."""
    for i in range(len(low)):
        large[i] = 0
    for axis in range(3):
        mean = 0.0
        for i in range(len(low)):
            mean += high[i, axis] - low[i, axis]
        mean /= len(low)
        for i in range(len(low)):
            if high[i, axis] - low[i, axis] > LARGE * mean:
                large[i] = 1


@inner
def _lay_out(low, high, large, grid, maximum):
    """Origin and size of the cells into grid (3, 3), no smaller than any box in them; their number along x, y, z."""
    for axis in range(3):
        mean, square, small, longest = 0.0, 0.0, 0, 0.0
        minimum, last = low[0, axis], low[0, axis]
        for i in range(len(low)):
            minimum, last = min(minimum, low[i, axis]), max(last, low[i, axis])
        for i in range(len(low)):
            if not large[i]:
                place = low[i, axis] - minimum
                mean, square, small = mean + place, square + place * place, small + 1
                longest = max(longest, high[i, axis] - low[i, axis])
        mean, square = mean / max(small, 1), square / max(small, 1)
        spread = WINDOW * sqrt(max(square - mean * mean, 0.0))
        grid[0, axis] = max(minimum, minimum + mean - spread)
        grid[2, axis] = min(last, minimum + mean + spread) - grid[0, axis]
        grid[1, axis] = max(longest, grid[2, axis] / maximum, 1e-300)
    while True:
        nx, ny = int(grid[2, 0] / grid[1, 0]) + 1, int(grid[2, 1] / grid[1, 1]) + 1
        nz = int(grid[2, 2] / grid[1, 2]) + 1
        if nx * ny * nz <= maximum:
            return nx, ny, nz
        for axis in range(3):
            grid[1, axis] *= 1.25


@inner
def _sort_in(low, large, grid, nx, ny, nz, cell, start, order):
    """Cell (M, 3) of the low corner of each box that is not large, and these in order of cells.

    Afterwards cell c holds order[start[c + 1]] to order[start[c + 2]].
    """
    m, count = len(low), nx * ny * nz
    for c in range(count + 2):
        start[c] = 0
    for i in range(m):
        if not large[i]:
            x = int(max(min((low[i, 0] - grid[0, 0]) / grid[1, 0], nx - 1.0), 0.0))
            y = int(max(min((low[i, 1] - grid[0, 1]) / grid[1, 1], ny - 1.0), 0.0))
            z = int(max(min((low[i, 2] - grid[0, 2]) / grid[1, 2], nz - 1.0), 0.0))
            cell[i, 0], cell[i, 1], cell[i, 2] = x, y, z
            start[(z * ny + y) * nx + x + 1] += 1
    for c in range(count + 1):
        start[c + 1] += start[c]
    for i in range(m - 1, -1, -1):
        if not large[i]:
            c = (cell[i, 2] * ny + cell[i, 1]) * nx + cell[i, 0] + 1
            start[c] -= 1
            order[start[c]] = i


@inner
def _pairs_in_cells(low, high, owner, cell, start, order, nx, ny, nz, pairs, room):
    """Pairs within a cell and with half of its neighbours, so that each comes once; returns their number."""
    count = 0
    for k in range(start[nx * ny * nz + 1]):
        i = order[k]
        x, y, z = cell[i, 0], cell[i, 1], cell[i, 2]
        before, after = max(x - 1, 0), min(x + 1, nx - 1)
        for row in range(5):
            if row == 0:
                begin, end = k + 1, start[(z * ny + y) * nx + after + 2]
            else:
                yy, zz = (y + 1, z) if row == 1 else (y + row - 3, z + 1)
                if yy < 0 or yy >= ny or zz >= nz:
                    continue
                begin, end = start[(zz * ny + yy) * nx + before + 1], start[(zz * ny + yy) * nx + after + 2]
            for m in range(begin, end):
                count = _test(low, high, owner, i, order[m], pairs, room, count)
    return count


@inner
def _pairs_of_large(low, high, owner, large, pairs, room, count):
    """Pairs of the large boxes with all others; returns the number of all pairs."""
    for i in range(len(low)):
        if large[i]:
            for j in range(len(low)):
                if not large[j] or i < j:
                    count = _test(low, high, owner, i, j, pairs, room, count)
    return count


@inner
def _test(low, high, owner, i, j, pairs, room, count):
    """One more where the boxes i and j overlap; it is written where there is room."""
    if (
        low[i, 0] <= high[j, 0] and low[j, 0] <= high[i, 0]
        and low[i, 2] <= high[j, 2] and low[j, 2] <= high[i, 2]
        and low[i, 1] <= high[j, 1] and low[j, 1] <= high[i, 1]
        and owner[i] != owner[j]
    ):  # fmt: skip
        if count < room:
            pairs[count, 0], pairs[count, 1] = min(i, j), max(i, j)
        return count + 1
    return count


@inner
def _sort_pairs(pairs, count, first, behind):
    """Pairs in the order of their first, then of their second: counted by the first, the few seconds by insertion."""
    m = len(first) - 1
    for i in range(m + 1):
        first[i] = 0
    for k in range(count):
        first[pairs[k, 0]] += 1
    total = 0
    for i in range(m + 1):
        total += first[i]
        first[i] = total
    for k in range(count - 1, -1, -1):
        first[pairs[k, 0]] -= 1
        behind[first[pairs[k, 0]]] = pairs[k, 1]
    for i in range(m):
        for k in range(first[i], first[i + 1]):
            j, at = behind[k], k
            while at > first[i] and behind[at - 1] > j:
                behind[at] = behind[at - 1]
                at -= 1
            behind[at] = j
        for k in range(first[i], first[i + 1]):
            pairs[k, 0], pairs[k, 1] = i, behind[k]
