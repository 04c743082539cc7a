"""Convex polyhedra as corners and loops: from the faces of a block, or cut out of a block that is not convex."""

from typing import NamedTuple

import numpy as np

from geometry.blocks import Blocks, GeometryError
from geometry.polyhedra.intersect import is_inside, solid
from geometry.polyhedra.measures import extent, face_areas_normals_centroids
from geometry.polyhedra.polygons import areas_normals_centroids

NEAR = 1e-9
"""Of the longest side of a block: corners that are nearer to a plane lie in it."""
MOST = 4000
"""Convex parts of one block."""


class Convex(NamedTuple):
    """corners (n, 3) m, and faces as loops of corner numbers, counter-clockwise seen from outside."""

    corners: np.ndarray
    loops: list[list[int]]


class Welded(NamedTuple):
    """Corners of all faces of some blocks, the same number where they are one corner of one block.

    points  (n, 3) m;  number  (., ) for each entry of face_points;  normal  (F, 3)
    """

    points: np.ndarray
    number: np.ndarray
    normal: np.ndarray


def welded(blocks: Blocks) -> Welded:
    """The corners of each block put together where they are nearer than NEAR; those of two blocks never are."""
    from geometry.polyhedra.weld import weld

    every, size = blocks.points[blocks.face_points], extent(blocks)
    block = np.repeat(blocks.face_block(), np.diff(blocks.face_start))
    first, number = weld(np.c_[every, 10.0 * size * block], NEAR * size)
    return Welded(every[first], number, face_areas_normals_centroids(blocks)[1])


def convex_block(blocks: Blocks, block: int, weld: Welded) -> Convex:
    """A convex block with each plane as one face; its own faces where these have a plane each and share their edges."""
    faces = blocks.faces_of(block)
    normal = weld.normal[faces.start : faces.stop]
    if np.count_nonzero(normal @ normal.T > 0.999) == len(faces):
        loops = [weld.number[blocks.face_start[f] : blocks.face_start[f + 1]].tolist() for f in faces]
        edges = {edge for loop in loops for edge in zip(loop, [*loop[1:], loop[0]], strict=True)}
        if all((b, a) in edges and a != b for a, b in edges):
            return _tidy(weld.points, loops)
    return merged_block(blocks, block)


def merged_block(blocks: Blocks, block: int) -> Convex:
    """A convex block with each plane as one face: faces that were cut in two, or into triangles, are one again."""
    from geometry.polyhedra.merged_faces import merged_faces
    from geometry.polyhedra.weld import weld

    faces = [blocks.face(f) for f in blocks.faces_of(block)]
    every = np.concatenate(faces)
    first, number = weld(every, NEAR * float(np.ptp(every, axis=0).max()))
    start = np.cumsum([0, *map(len, faces)])
    fans = [
        (number[a], number[a + k], number[a + k + 1])
        for a, b in zip(start[:-1], start[1:], strict=True)
        for k in range(1, b - a - 1)
    ]
    triangle = np.array([fan for fan in fans if len(set(fan)) == 3], dtype=np.int64)
    loops, _ = merged_faces(every[first], triangle, np.zeros(len(triangle), dtype=np.int64))
    return _tidy(every[first], [loop.tolist() for loop in loops])


def convex_parts(blocks: Blocks, block: int) -> list[Convex]:
    """A block that is not convex, cut along planes of its own faces into convex parts that fill it.

    The cell round the block is divided again and again: first by planes that have all faces in it on one side, then by
    those that cut fewest faces. Raises GeometryError where that gives more than MOST parts.
    """
    body = solid(blocks, block)
    low, high = (f(np.concatenate(body.faces), axis=0) for f in (np.min, np.max))
    size = float((high - low).max())
    waiting = [(_box(low - 0.5 * size, high + 0.5 * size), list(range(len(body.faces))), body.faces)]
    parts = []
    while waiting:
        cell, owner, faces = waiting.pop()
        plane = _best_plane(body.normals, owner, faces, NEAR * size)
        if plane is None:
            if is_inside(body, cell.corners.mean(axis=0)):
                parts.append(cell)
            continue
        normal, level = plane
        for sign in (1.0, -1.0):
            half = _half(cell, sign * normal, sign * level, NEAR * size)
            if half is not None:
                pieces = [_cut_face(face, sign * normal, sign * level, NEAR * size) for face in faces]
                inside = [(o, piece) for o, piece in zip(owner, pieces, strict=True) if len(piece) >= 3]
                waiting.append((half, [o for o, _ in inside], [piece for _, piece in inside]))
        if len(parts) + len(waiting) > MOST:
            raise GeometryError(f"block {block} (unit {blocks.unit[block]}) needs more than {MOST} convex parts")
    return parts


def _best_plane(
    normals: np.ndarray, owner: list[int], faces: list[np.ndarray], width: float
) -> tuple[np.ndarray, float] | None:
    """The plane of a face in the cell that cuts fewest other faces; those on the hull of what is left come first."""
    best, plane = None, None
    for o, face in zip(owner, faces, strict=True):
        level = float(normals[o] @ face[0])
        above = cut = 0
        for other in faces:
            height = other @ normals[o] - level
            above += height.max() > width
            cut += height.max() > width and height.min() < -width
        if best is None or (above > 0, cut) < best:
            best, plane = (above > 0, cut), (normals[o], level)
    return plane


def _cut_face(face: np.ndarray, normal: np.ndarray, level: float, width: float) -> np.ndarray:
    """Part of a face below a plane; empty where it lies in it."""
    height = face @ normal - level
    height[np.abs(height) <= width] = 0.0
    if not np.any(height < 0):
        return face[:0]
    corners = []
    for k in range(len(face)):
        j = (k + 1) % len(face)
        if height[k] <= 0:
            corners.append(face[k])
        if height[k] * height[j] < 0:
            corners.append(face[k] + height[k] / (height[k] - height[j]) * (face[j] - face[k]))
    return np.array(corners)


def _half(cell: Convex, normal: np.ndarray, level: float, width: float) -> Convex | None:
    """Part of a convex cell below a plane; None where there is none. New corners are shared by their faces."""
    height = cell.corners @ normal - level
    height[np.abs(height) <= width] = 0.0
    if not np.any(height < 0):
        return None
    if not np.any(height > 0):
        return cell
    corners, loops, after = list(cell.corners), [], {}
    new: dict[tuple[int, int], int] = {}
    for loop in cell.loops:
        below = []
        for i, j in zip(loop, [*loop[1:], loop[0]], strict=True):
            if height[i] <= 0:
                below.append(i)
            if height[i] * height[j] < 0:
                a, b = min(i, j), max(i, j)
                if (a, b) not in new:
                    new[a, b] = len(corners)
                    corners.append(corners[a] + height[a] / (height[a] - height[b]) * (corners[b] - corners[a]))
                below.append(new[a, b])
        on = [k >= len(height) or height[k] == 0 for k in below]
        if len(below) >= 3 and not all(on):
            loops.append(below)
            for k in range(len(below)):
                if on[k] and on[(k + 1) % len(below)]:
                    after[below[(k + 1) % len(below)]] = below[k]
    first = next(iter(after))
    cap, at = [first], after[first]
    while at != first:
        cap.append(at)
        at = after[at]
    return _tidy(np.array(corners), [*loops, cap])


def _box(low: np.ndarray, high: np.ndarray) -> Convex:
    corners = np.array([[(high if (c >> axis) & 1 else low)[axis] for axis in range(3)] for c in range(8)])
    return Convex(corners, [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]])


def _tidy(corners: np.ndarray, loops: list[list[int]]) -> Convex:
    """The same without corners that no face uses."""
    used = sorted({corner for loop in loops for corner in loop})
    number = {corner: k for k, corner in enumerate(used)}
    return Convex(corners[used], [[number[corner] for corner in loop] for loop in loops])


def covered(part: Convex, others: list[Convex], width: float) -> list[bool]:
    """Whether each face of a part is covered wholly by faces of other parts of its body."""
    answer = []
    for loop in part.loops:
        face = part.corners[loop]
        area, normal, _ = (x[0] for x in areas_normals_centroids(face[None]))
        remaining = area
        for other in others:
            if (other.corners @ normal - normal @ face[0]).min() < -width:
                continue
            for across in other.loops:
                facing = other.corners[across]
                if np.abs(facing @ normal - normal @ face[0]).max() <= width:
                    remaining -= _shared(face, facing, normal, width)
        answer.append(bool(remaining <= 1e-6 * area))
    return answer


def _shared(face: np.ndarray, other: np.ndarray, normal: np.ndarray, width: float) -> float:
    """Area (m2) that two convex polygons of one plane share."""
    part = face
    for k in range(len(other)):  # `other` runs clockwise about the normal, so that its outside is on the left
        edge = other[(k + 1) % len(other)] - other[k]
        outward = np.cross(normal, edge) / np.linalg.norm(edge)
        part = _cut_face(part, outward, float(outward @ other[k]), width) if len(part) >= 3 else part
    return float(areas_normals_centroids(part[None])[0][0]) if len(part) >= 3 else 0.0
