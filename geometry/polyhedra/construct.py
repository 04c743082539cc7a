"""Building Blocks: from boxes and grids of them, from lists of faces, from plane polygons, from other Blocks."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from geometry.blocks import Blocks
from geometry.polyhedra.indexing import ranges

# Corner i + 2 j + 4 k of a box lies at the low (0) or high (1) end along x, y, z.
BOX_FACES = np.array([[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]])


def from_boxes(low: np.ndarray, high: np.ndarray, unit: np.ndarray, group: np.ndarray, groups: Sequence[str]) -> Blocks:
    """One box between each low and high corner (B, 3); faces in the order x-, x+, y-, y+, z-, z+."""
    low, high = np.atleast_2d(low), np.atleast_2d(high)
    count = len(low)
    upper = np.array([[(c >> axis) & 1 for axis in range(3)] for c in range(8)], dtype=bool)
    points = np.where(upper[None], high[:, None], low[:, None]).reshape(-1, 3)
    face_points = (np.arange(count)[:, None, None] * 8 + BOX_FACES).ravel()
    return Blocks(
        points=points,
        face_start=np.arange(6 * count + 1) * 4,
        face_points=face_points,
        block_face_start=np.arange(count + 1) * 6,
        unit=np.asarray(unit, dtype=np.int64),
        group=np.asarray(group, dtype=np.int64),
        groups=tuple(groups),
    )


def from_faces(
    polyhedra: Sequence[Sequence[np.ndarray]], unit: Sequence[int], group: Sequence[int], groups: Sequence[str]
) -> Blocks:
    """One block for each list of faces (n, 3), counter-clockwise seen from outside."""
    faces = [np.asarray(face, dtype=float) for polyhedron in polyhedra for face in polyhedron]
    points = np.concatenate(faces) if faces else np.zeros((0, 3))
    return Blocks(
        points=points,
        face_start=np.concatenate([[0], np.cumsum([len(face) for face in faces])]).astype(np.int64),
        face_points=np.arange(len(points)),
        block_face_start=np.concatenate([[0], np.cumsum([len(p) for p in polyhedra])]).astype(np.int64),
        unit=np.asarray(unit, dtype=np.int64),
        group=np.asarray(group, dtype=np.int64),
        groups=tuple(groups),
    )


def concatenate(parts: Sequence[Blocks]) -> Blocks:
    """All blocks of all parts in that order; groups of the same name become one, unit numbers stay."""
    groups = tuple(dict.fromkeys(name for part in parts for name in part.groups))
    points = np.cumsum([0, *(len(part.points) for part in parts)])
    corners = np.cumsum([0, *(len(part.face_points) for part in parts)])
    faces = np.cumsum([0, *(len(part.face_start) - 1 for part in parts)])
    return Blocks(
        points=np.concatenate([part.points for part in parts]),
        face_start=np.concatenate(
            [part.face_start[:-1] + n for part, n in zip(parts, corners, strict=False)] + [corners[-1:]]
        ),
        face_points=np.concatenate([part.face_points + n for part, n in zip(parts, points, strict=False)]),
        block_face_start=np.concatenate(
            [part.block_face_start[:-1] + n for part, n in zip(parts, faces, strict=False)] + [faces[-1:]]
        ),
        unit=np.concatenate([part.unit for part in parts]),
        group=np.concatenate(
            [np.array([groups.index(g) for g in part.groups], dtype=np.int64)[part.group] for part in parts]
        ),
        groups=groups,
    )


def selected(blocks: Blocks, which: np.ndarray) -> Blocks:
    """The blocks numbered which, in that order, with the points that they stand on."""
    counts = np.diff(blocks.block_face_start)[which]
    _, faces = ranges(blocks.block_face_start[which], counts)
    sizes = np.diff(blocks.face_start)[faces]
    _, corners = ranges(blocks.face_start[faces], sizes)
    points, number = np.unique(blocks.face_points[corners], return_inverse=True)
    return replace(
        blocks,
        points=blocks.points[points],
        face_start=np.concatenate([[0], np.cumsum(sizes)]),
        face_points=number.reshape(-1),
        block_face_start=np.concatenate([[0], np.cumsum(counts)]),
        unit=blocks.unit[which],
        group=blocks.group[which],
    )


def with_own_points(blocks: Blocks) -> Blocks:
    """The same blocks, each with its own copy of the points that it stands on; points of no block are left out."""
    owner = np.repeat(blocks.face_block(), np.diff(blocks.face_start))
    key = owner * max(len(blocks.points), 1) + blocks.face_points
    unique, number = np.unique(key, return_inverse=True)
    return replace(
        blocks, points=blocks.points[unique % max(len(blocks.points), 1)], face_points=number.astype(np.int64)
    )


def extrude(
    loops: Sequence[np.ndarray], low: np.ndarray, high: np.ndarray, unit: np.ndarray, groups: Sequence[str]
) -> Blocks:
    """One block for each loop (k, 2) m, convex, x to z counter-clockwise, between y = low and high (B,); group 0.

    Faces in the order y-, y+, then one over each edge.
    """
    count = np.array([len(loop) for loop in loops])
    flat = np.concatenate(loops)
    owner, k = ranges(np.zeros(len(loops), dtype=np.int64), count)
    corners = len(flat)
    points = np.concatenate([np.insert(flat, 1, y[owner], axis=1) for y in (low, high)])
    start = np.cumsum(count) - count
    here, after = np.arange(corners), start[owner] + (k + 1) % count[owner]
    backwards = start[owner] + count[owner] - 1 - k + corners
    sides = np.stack([after, here, here + corners, after + corners], axis=1)
    size = np.ones(int(count.sum()) + 2 * len(loops), dtype=np.int64) * 4
    first = start + 2 * np.arange(len(loops))  # number of each block's face y-
    size[first], size[first + 1] = count, count
    face_start = np.concatenate([[0], np.cumsum(size)])
    face_points = np.empty(face_start[-1], dtype=np.int64)
    face_points[face_start[first][owner] + k] = here
    face_points[face_start[first + 1][owner] + k] = backwards
    face_points[face_start[first[owner] + 2 + k][:, None] + np.arange(4)] = sides
    return Blocks(
        points=points,
        face_start=face_start,
        face_points=face_points,
        block_face_start=np.concatenate([[0], np.cumsum(count + 2)]),
        unit=np.asarray(unit, dtype=np.int64),
        group=np.zeros(len(loops), dtype=np.int64),
        groups=tuple(groups),
    )


def divide(low: Sequence[float], high: Sequence[float], divisions: Sequence[int]) -> tuple[np.ndarray, np.ndarray]:
    """Low and high corners (n, 3) of the nx x ny x nz cells of the box low..high, x running fastest.

    Neighbours get exactly the same coordinates on their common face.
    """
    cuts = [np.linspace(a, b, n + 1) for a, b, n in zip(low, high, divisions, strict=True)]
    k, j, i = (index.ravel() for index in np.indices(tuple(divisions)[::-1]))
    lows = np.stack([cuts[0][i], cuts[1][j], cuts[2][k]], axis=1)
    highs = np.stack([cuts[0][i + 1], cuts[1][j + 1], cuts[2][k + 1]], axis=1)
    return lows, highs
