"""Blocks that need not be convex: whether they are, and what of one lies inside another."""

from dataclasses import dataclass

import numpy as np

from geometry.blocks import Blocks
from geometry.polyhedra.indexing import following, ranges
from geometry.polyhedra.measures import face_areas_normals_centroids
from geometry.polyhedra.polygons import areas_normals_centroids, pad

TABLE = 4_000_000
"""Numbers that are looked at in one go."""
FACES = 32
"""Faces that are looked at in one go."""


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
    for first, second in ((face[pair[:, 0]], face[pair[:, 1]]), (face[pair[:, 1]], face[pair[:, 0]])):
        owner, corner = ranges(starts[second], size[second])
        height = np.einsum("ni,ni->n", corners[corner], mine[first][owner]) - offset[first][owner]
        if height.max() > width:
            return False
    return True


def shared_place(first: ConvexSolid, second: ConvexSolid, depth: float) -> np.ndarray | None:
    """A place (3,) m where two solids share space, None if they have no more in common than faces, edges and corners
    that touch within depth (m).

    Every face of each is cut along the planes of the other's faces. A piece is then wholly inside the other solid,
    outside or on its surface, and so is the middle of it. Two faces on each other that look the same way have matter
    of both solids behind them.
    """
    place = _entry(first, second, depth)
    return _entry(second, first, depth) if place is None else place


def _entry(first: ConvexSolid, second: ConvexSolid, depth: float) -> np.ndarray | None:
    boxes, others = _boxes(first.faces), _boxes(second.faces)
    near = _meet(boxes, (others[0].min(axis=0), others[1].max(axis=0)))
    origin = np.array([face[0] for face in second.faces])
    for begin in range(0, len(near), FACES):
        pieces, normals = [], []
        for f in near[begin : begin + FACES].tolist():
            among = _meet(others, (boxes[0][f], boxes[1][f]))
            height = np.einsum("kgi,gi->kg", first.faces[f][:, None] - origin[among], second.normals[among])
            parts = [first.faces[f]]
            for g in among[(height.max(axis=0) > depth) & (height.min(axis=0) < -depth)]:
                parts = [part for piece in parts for part in _cut(piece, second.normals[g], origin[g], depth)]
            pieces += parts
            normals += [first.normals[f]] * len(parts)
        start = np.cumsum([0, *map(len, pieces)])
        middle = areas_normals_centroids(pad(np.concatenate(pieces), start, np.arange(start[-1]))[0])[2]
        if len(shared := np.flatnonzero(_are_shared(second, others, middle, np.array(normals), depth))):
            return np.asarray(middle[shared[0]])
    return None


def _are_shared(
    two: ConvexSolid, boxes: tuple[np.ndarray, np.ndarray], middle: np.ndarray, normal: np.ndarray, depth: float
) -> np.ndarray:
    """(M,) whether points of the surface of another solid, which looks along `normal` (M, 3) there, lie in a solid, or
    on a face of it that looks the same way."""
    free, shared = np.ones(len(middle), dtype=bool), np.zeros(len(middle), dtype=bool)
    near = np.all((boxes[0] <= middle[:, None] + depth) & (middle[:, None] - depth <= boxes[1]), axis=2)
    for m in np.flatnonzero(near.any(axis=1)).tolist():
        touching = _faces_at(two, np.flatnonzero(near[m]), middle[m], depth)
        free[m] = len(touching) == 0
        shared[m] = bool(np.any(two.normals[touching] @ normal[m] > 0.999))
    shared[free] = are_inside(two, middle[free])
    return shared


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
    body = solid(blocks, block)
    corners = np.concatenate(body.faces)
    if ((point < corners.min(axis=0) - width) | (point > corners.max(axis=0) + width)).any():
        return False
    return bool(len(_faces_at(body, np.arange(len(body.faces)), point, width))) or is_inside(body, point)


def is_inside(block: ConvexSolid, point: np.ndarray) -> bool:
    """Whether the point is inside the block."""
    return bool(are_inside(block, point[None])[0])


def are_inside(block: ConvexSolid, points: np.ndarray) -> np.ndarray:
    """(M,) whether points (M, 3) are inside the block: the solid angles of all its triangles add up to 4 pi (Van
    Oosterom)."""
    inside, chunk = np.zeros(len(points), dtype=bool), max(1, TABLE // (9 * len(block.triangles)))
    for begin in range(0, len(points), chunk):
        a, b, c = (block.triangles[:, k] - points[begin : begin + chunk, None] for k in range(3))
        la, lb, lc = (np.sqrt(np.einsum("mti,mti->mt", v, v)) for v in (a, b, c))
        ab, bc, ca = (np.einsum("mti,mti->mt", *pair) for pair in ((a, b), (b, c), (c, a)))
        top = np.einsum("mti,mti->mt", a, np.cross(b, c))
        angle = 2 * np.arctan2(top, la * lb * lc + ab * lc + bc * la + ca * lb)
        inside[begin : begin + chunk] = np.abs(angle.sum(axis=1)) > 2 * np.pi
    return inside
