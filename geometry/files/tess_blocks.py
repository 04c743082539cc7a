"""From the faces of a tessellation to blocks: bent faces and faces that are not convex are cut into triangles."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from geometry.blocks import Blocks, GeometryError
from geometry.polyhedra.convexity import reflex, triangles
from geometry.polyhedra.indexing import ranges
from geometry.polyhedra.measures import volumes
from geometry.polyhedra.polygons import areas_normals_centroids, pad

FLAT = 1e-9
"""Of the tessellation's longest side: corners that stand further off their face make it bent."""
SLIVER = 1e-6
"""Of a face's area: the least triangle of a fan from a corner; below, the fan starts from the middle."""


@dataclass(frozen=True)
class TessFaces:
    """Faces as the file has them: start (F + 1,), corners (.,), and the point of each that a fan starts from.

    fan (F,): 0 for the point `middle` (F, 3), k for the face's corner k, -1 where the file has none.
    """

    start: np.ndarray
    corner: np.ndarray
    fan: np.ndarray
    middle: np.ndarray


def solid(
    path: Path, vertices: np.ndarray, faces: TessFaces, cell_start: np.ndarray, signed: np.ndarray
) -> tuple[Blocks, list[str]]:
    """Blocks of a tessellation in space; a face that two cells share is cut up once, for both."""
    points, piece_start, start, corner, notes = _flat_pieces(path, vertices, faces)
    _, piece = ranges(piece_start[np.abs(signed) - 1], np.diff(piece_start)[np.abs(signed) - 1])
    pieces = np.diff(piece_start)[np.abs(signed) - 1]
    inward = np.repeat(signed < 0, pieces)
    size = np.diff(start)[piece]
    owner, k = ranges(np.zeros(len(piece), dtype=np.int64), size)
    k = np.where(inward[owner], size[owner] - 1 - k, k)
    count = len(cell_start) - 1
    blocks = Blocks(
        points=points,
        face_start=np.concatenate([[0], np.cumsum(size)]),
        face_points=corner[start[piece][owner] + k],
        block_face_start=np.concatenate([[0], np.cumsum(pieces)])[cell_start],
        unit=np.zeros(count, dtype=np.int64),
        group=np.zeros(count, dtype=np.int64),
        groups=("units",),
    )
    return _outward(blocks), notes


def _outward(blocks: Blocks) -> Blocks:
    """The same blocks; where all faces of one look inward, they are turned."""
    wrong = volumes(blocks) < 0
    if not wrong.any():
        return blocks
    size = np.diff(blocks.face_start)
    face, k = ranges(np.zeros(len(size), dtype=np.int64), size)
    turned = np.where(wrong[blocks.face_block()][face], size[face] - 1 - k, k)
    return replace(blocks, face_points=blocks.face_points[blocks.face_start[face] + turned])


def _flat_pieces(
    path: Path, vertices: np.ndarray, faces: TessFaces
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, list[str]]:
    """Points, and the flat convex pieces of each face: piece_start (F + 1,), start and corners of the pieces."""
    polygon, count = pad(vertices, faces.start, faces.corner)
    _, normal, centroid = areas_normals_centroids(polygon)
    height = np.abs(np.einsum("nki,ni->nk", polygon - centroid[:, None], normal)).max(axis=1)
    limit = FLAT * float(np.ptp(vertices[faces.corner], axis=0).max())
    bent = height > limit
    notched = ~bent & reflex(polygon, count)
    points, pieces = [vertices], []
    last = len(vertices)
    for f in range(len(count)):
        loop = faces.corner[faces.start[f] : faces.start[f + 1]]
        if bent[f]:
            fan = _corner_fan(vertices, loop, int(faces.fan[f]))
            if not fan:
                middle = faces.middle[f] if faces.fan[f] == 0 else vertices[loop].mean(axis=0)
                fan = [np.array([last, a, b]) for a, b in zip(loop, np.roll(loop, -1), strict=True)]
                points.append(middle[None])
                last += 1
            pieces.append(fan)
        elif notched[f]:
            pieces.append(list(loop[_cut(path, f, vertices[loop])]))
        else:
            pieces.append([loop])
    whole = [piece for part in pieces for piece in part]
    notes = []
    if bent.any():
        worst = np.degrees(np.arctan2(height, np.linalg.norm(polygon - centroid[:, None], axis=2).max(axis=1))).max()
        notes.append(
            f"{bent.sum()} of {len(bent)} faces are bent, by up to {height.max():.3g} m or {worst:.2g} degrees: "
            "they are cut into triangles, the same for both cells"
        )
    if notched.any():
        notes.append(f"{notched.sum()} of {len(bent)} faces are not convex: they are cut into triangles")
    return (
        np.concatenate(points),
        np.concatenate([[0], np.cumsum([len(part) for part in pieces])]),
        np.concatenate([[0], np.cumsum([len(piece) for piece in whole])]),
        np.concatenate(whole),
        notes,
    )


def _corner_fan(vertices: np.ndarray, loop: np.ndarray, corner: int) -> list[np.ndarray]:
    """Triangles from a face's corner (1 to n) to its edges, or none if there is no such corner or one is a sliver."""
    if corner <= 0:
        return []
    turned = np.roll(loop, 1 - corner)
    fan = [turned[[0, i, i + 1]] for i in range(1, len(turned) - 1)]
    area = areas_normals_centroids(vertices[np.array(fan)])[0]
    return fan if area.min() > SLIVER * area.sum() else []


def _cut(path: Path, face: int, corners: np.ndarray) -> np.ndarray:
    try:
        return triangles(corners)
    except GeometryError as error:
        raise GeometryError(f"'{path}', face {face + 1}: {error}") from None


def drawn_out(path: Path, vertices: np.ndarray, faces: TessFaces, thickness: float) -> tuple[Blocks, list[str]]:
    """Blocks of a plane tessellation: every face is a cell, seen from y-, and goes through to y = thickness."""
    if np.ptp(vertices[:, 2]) > FLAT * np.ptp(vertices[:, :2]):
        raise GeometryError(f"'{path}' is a plane tessellation, but its z coordinates differ")
    flat = np.column_stack([vertices[:, 0], np.zeros(len(vertices)), vertices[:, 1]])
    points = np.concatenate([flat, flat + [0.0, thickness, 0.0]])
    fronts = TessFaces(faces.start, faces.corner, np.full(len(faces.fan), -1), faces.middle)
    _, piece_start, start, corner, notes = _flat_pieces(path, flat, fronts)
    loops, number = [], []
    for f in range(len(faces.start) - 1):
        loop = faces.corner[faces.start[f] : faces.start[f + 1]]
        front = [corner[start[p] : start[p + 1]] for p in range(piece_start[f], piece_start[f + 1])]
        after = np.roll(loop, -1)
        sides = np.stack([after, loop, loop + len(flat), after + len(flat)], axis=1)
        loops += [*front, *(piece[::-1] + len(flat) for piece in front), *sides]
        number.append(2 * len(front) + len(sides))
    count = len(number)
    blocks = Blocks(
        points=points,
        face_start=np.concatenate([[0], np.cumsum([len(loop) for loop in loops])]),
        face_points=np.concatenate(loops),
        block_face_start=np.concatenate([[0], np.cumsum(number)]),
        unit=np.zeros(count, dtype=np.int64),
        group=np.zeros(count, dtype=np.int64),
        groups=("units",),
    )
    return _outward(blocks), notes
