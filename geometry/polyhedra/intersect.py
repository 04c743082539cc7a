"""Blocks that need not be convex: whether they are, and what of one lies inside another."""

from dataclasses import dataclass

import numpy as np

from geometry.blocks import Blocks
from geometry.polyhedra.indexing import following, ranges
from geometry.polyhedra.measures import face_areas_normals_centroids
from geometry.polyhedra.polygons import areas_normals_centroids, pad

TABLE = 4_000_000
"""Numbers that are looked at in one go."""


@dataclass(frozen=True)
class ConvexSolid:
    """One block by itself: convex faces, their outward normals, and all their triangles (T, 3, 3)."""

    faces: list[np.ndarray]
    normals: np.ndarray
    triangles: np.ndarray


def solid(blocks: Blocks, block: int) -> ConvexSolid:
    """The block with this number."""
    first, last = blocks.block_face_start[block : block + 2]
    start = blocks.face_start[first : last + 1]
    corners, count = pad(blocks.points, start, blocks.face_points)
    _, second = ranges(np.zeros(len(count), dtype=np.int64), count - 2)
    face = np.repeat(np.arange(len(count)), count - 2)
    triangles = corners[face[:, None], np.stack([np.zeros_like(second), second + 1, second + 2], axis=1)]
    faces = [polygon[:n] for polygon, n in zip(corners, count.tolist(), strict=True)]
    return ConvexSolid(faces, areas_normals_centroids(corners)[1], triangles)


def are_convex(blocks: Blocks, width: float) -> np.ndarray:
    """(B,) whether no corner of the block stands out of the plane of any of its faces by more than width (m)."""
    _, normal, centroid = face_areas_normals_centroids(blocks)
    start = blocks.face_start[blocks.block_face_start]
    convex = np.ones(blocks.count, dtype=bool)
    for b in range(blocks.count):
        faces = slice(blocks.block_face_start[b], blocks.block_face_start[b + 1])
        used = np.unique(blocks.face_points[start[b] : start[b + 1]])
        offset = np.einsum("fi,fi->f", normal[faces], centroid[faces])
        if len(used) * (faces.stop - faces.start) <= TABLE:
            convex[b] = (blocks.points[used] @ normal[faces].T - offset).max() <= width
        else:
            convex[b] = _turns_outwards(blocks, b, normal, offset)
    return convex


def _turns_outwards(blocks: Blocks, b: int, normal: np.ndarray, offset: np.ndarray) -> bool:
    """Whether a block of many faces bends outwards, or not at all, along each edge: then it is convex.

    Only edges that two faces share as a whole are understood: a block with others counts as not convex.
    """
    begin, end = (blocks.face_start[blocks.block_face_start[k]] for k in (b, b + 1))
    corners = blocks.points[blocks.face_points[begin:end]]
    starts = blocks.face_start[blocks.block_face_start[b] : blocks.block_face_start[b + 1] + 1] - begin
    place, number = np.unique(corners, axis=0, return_inverse=True)
    number = number.reshape(-1)
    face, after = np.repeat(np.arange(len(starts) - 1), np.diff(starts)), number[following(starts)]
    low, high = np.minimum(number, after), np.maximum(number, after)
    order = np.lexsort((high, low))
    pair = order.reshape(-1, 2) if len(order) % 2 == 0 else order[:0].reshape(-1, 2)
    matched = len(pair) and np.all(low[pair[:, 0]] == low[pair[:, 1]]) and np.all(high[pair[:, 0]] == high[pair[:, 1]])
    if not matched or not np.all(number[pair[:, 0]] == after[pair[:, 1]]):
        return False
    width = 1e-9 * float(np.ptp(place, axis=0).max())
    mine, size = normal[blocks.block_face_start[b] :], np.diff(starts)
    for one, two in ((face[pair[:, 0]], face[pair[:, 1]]), (face[pair[:, 1]], face[pair[:, 0]])):
        owner, corner = ranges(starts[two], size[two])
        height = np.einsum("ni,ni->n", corners[corner], mine[one][owner]) - offset[one][owner]
        if height.max() > width:
            return False
    return True


def shared_place(one: ConvexSolid, two: ConvexSolid, depth: float) -> np.ndarray | None:
    """A place (3,) m where two solids share space, None if they have no more in common than faces, edges and corners
    that touch within depth (m).

    Every face of each is cut along the planes of the other's faces. A piece is then wholly inside the other solid,
    outside or on its surface, and so is the middle of it. Two faces on each other that look the same way have matter
    of both solids behind them.
    """
    place = _entry(one, two, depth)
    return _entry(two, one, depth) if place is None else place


def _entry(one: ConvexSolid, two: ConvexSolid, depth: float) -> np.ndarray | None:
    boxes, others = _boxes(one.faces), _boxes(two.faces)
    near = _meet(boxes, (others[0].min(axis=0), others[1].max(axis=0)))
    for f in near:
        face, normal = one.faces[f], one.normals[f]
        pieces = [face]
        for g in _meet(others, (boxes[0][f], boxes[1][f])):
            pieces = [part for piece in pieces for part in _cut(piece, two.normals[g], two.faces[g][0], depth)]
        for piece in pieces:
            middle = areas_normals_centroids(piece[None])[2][0]
            touching = _faces_at(two, _meet(others, (middle - depth, middle + depth)), middle, depth)
            if len(touching) == 0 and is_inside(two, middle):
                return np.asarray(middle)
            if len(touching) and np.any(two.normals[touching] @ normal > 0.999):
                return np.asarray(middle)
    return None


def moved(block: ConvexSolid, step: np.ndarray) -> ConvexSolid:
    """The solid, moved by a step (3,) m."""
    return ConvexSolid([face + step for face in block.faces], block.normals, block.triangles + step)


def _boxes(faces: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Lowest and highest corner of each face, (F, 3) both."""
    return np.array([face.min(axis=0) for face in faces]), np.array([face.max(axis=0) for face in faces])


def _meet(boxes: tuple[np.ndarray, np.ndarray], box: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """Numbers of the boxes that meet a box."""
    return np.flatnonzero(np.all((boxes[0] <= box[1]) & (box[0] <= boxes[1]), axis=1))


def _cut(polygon: np.ndarray, normal: np.ndarray, origin: np.ndarray, depth: float) -> list[np.ndarray]:
    """The two parts of a convex polygon on both sides of a plane; one, if the other is thinner than depth."""
    height = (polygon - origin) @ normal
    if height.max() <= depth or height.min() >= -depth:
        return [polygon]
    following, next_height = np.roll(polygon, -1, axis=0), np.roll(height, -1)
    parts = []
    for sign in (1.0, -1.0):
        corners = []
        for k in range(len(polygon)):
            if sign * height[k] >= 0:
                corners.append(polygon[k])
            if height[k] * next_height[k] < 0:
                corners.append(polygon[k] + height[k] / (height[k] - next_height[k]) * (following[k] - polygon[k]))
        parts.append(np.array(corners))
    return parts


def _faces_at(block: ConvexSolid, among: np.ndarray, point: np.ndarray, depth: float) -> np.ndarray:
    """Those of some faces that pass the point within depth, by their numbers."""
    faces = []
    for f in among.tolist():
        face, normal = block.faces[f], block.normals[f]
        arm = point - face
        if abs(float(arm[0] @ normal)) <= depth:
            edge = np.roll(face, -1, axis=0) - face
            inward = np.cross(normal, edge)
            if np.all(np.einsum("ki,ki->k", arm, inward) >= -depth * np.linalg.norm(edge, axis=1)):
                faces.append(f)
    return np.array(faces, dtype=np.int64)


def holds(blocks: Blocks, block: int, point: np.ndarray, width: float) -> bool:
    """Whether a point (3,) is in a block, or off its surface by no more than width (m)."""
    one = solid(blocks, block)
    corners = np.concatenate(one.faces)
    if ((point < corners.min(axis=0) - width) | (point > corners.max(axis=0) + width)).any():
        return False
    return bool(len(_faces_at(one, np.arange(len(one.faces)), point, width))) or is_inside(one, point)


def is_inside(block: ConvexSolid, point: np.ndarray) -> bool:
    """Whether the point is inside the block: the solid angles of all its triangles add up to 4 pi (Van Oosterom)."""
    a, b, c = (block.triangles[:, k] - point for k in range(3))
    la, lb, lc = (np.linalg.norm(v, axis=1) for v in (a, b, c))
    top = np.einsum("ti,ti->t", a, np.cross(b, c))
    dot = (np.einsum("ti,ti->t", *pair) for pair in ((a, b), (b, c), (c, a)))
    ab, bc, ca = dot
    angle = 2 * np.arctan2(top, la * lb * lc + ab * lc + bc * la + ca * lb)
    return bool(abs(angle.sum()) > 2 * np.pi)
