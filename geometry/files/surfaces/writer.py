"""Blocks as closed surfaces in words: an object of an OBJ file, or a solid of an STL file, for each block."""

from collections.abc import Iterator, Sequence

import numpy as np

from geometry.blocks import Blocks
from geometry.polyhedra.polygons import areas_normals_centroids
from geometry.polyhedra.weld import weld

ON_EDGE = 1e-9
"""Of the longest side of a block: a corner that is nearer to an edge lies on it."""


def surface_text(blocks: Blocks, names: Sequence[str], suffix: str) -> Iterator[str]:
    """Lines of a file of this suffix, .obj or .stl, in metres with all digits; names (B,) of the blocks."""
    count = 0
    for b, name in enumerate(names):
        points, faces = _closed(blocks, b)
        if suffix == ".stl":
            yield f"solid {name}\n"
            for face in faces:
                yield from (_facet(points[part]) for part in _fan(face))
            yield f"endsolid {name}\n"
            continue
        yield f"o {name}\n"
        yield from ("v {!r} {!r} {!r}\n".format(*point) for point in points.tolist())
        yield from ("f " + " ".join(str(v + count + 1) for v in face) + "\n" for face in faces)
        count += len(points)


def _closed(blocks: Blocks, b: int) -> tuple[np.ndarray, list[list[int]]]:
    """Corners of a block, each once, and its faces, so that every edge has two of them.

    A face on whose edges corners of others lie becomes triangles round its middle.
    """
    loops = [blocks.face_points[blocks.face_start[f] : blocks.face_start[f + 1]] for f in blocks.faces_of(b)]
    corners = blocks.points[np.concatenate(loops)]
    width = ON_EDGE * float(np.ptp(corners, axis=0).max())
    first, number = weld(corners, width)
    points, faces, middles = corners[first], [], []
    for loop in np.split(number, np.cumsum([len(loop) for loop in loops])[:-1]):
        ring = [v for i, j in zip(loop, np.roll(loop, -1), strict=True) for v in (i, *_between(points, i, j, width))]
        if len(ring) == len(loop):
            faces.append([int(v) for v in loop])
            continue
        middles.append(areas_normals_centroids(points[loop][None])[2][0])
        centre = len(points) + len(middles) - 1
        faces += [[int(i), int(j), centre] for i, j in zip(ring, [*ring[1:], ring[0]], strict=True)]
    return np.concatenate([points, np.array(middles).reshape(-1, 3)]), faces


def _between(points: np.ndarray, i: int, j: int, width: float) -> list[int]:
    """Corners on the edge from i to j, in order."""
    edge = points[j] - points[i]
    length = float(np.linalg.norm(edge))
    along = (points - points[i]) @ edge / length
    distance = np.linalg.norm(points - points[i] - along[:, None] * edge / length, axis=1)
    corners = np.flatnonzero((distance <= width) & (along > width) & (along < length - width))
    return [int(v) for v in corners[np.argsort(along[corners])]]


def _fan(face: list[int]) -> list[list[int]]:
    return [[face[0], face[k], face[k + 1]] for k in range(1, len(face) - 1)]


def _facet(corner: np.ndarray) -> str:
    normal = areas_normals_centroids(corner[None])[1][0]
    lines = ["facet normal {!r} {!r} {!r}".format(*normal.tolist()), "outer loop"]
    lines += ["vertex {!r} {!r} {!r}".format(*point) for point in corner.tolist()]
    return "\n".join([*lines, "endloop", "endfacet", ""])
