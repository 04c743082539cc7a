"""Blocks from arrays: each a closed polyhedron of vertices and faces, as trimesh, COMPAS or plain numpy hold them."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from geometry.blocks import Blocks, GeometryError
from geometry.polyhedra.construct import from_faces
from geometry.polyhedra.convexity import triangles
from geometry.polyhedra.flat.flatten import flattened
from geometry.polyhedra.flat.regions import Mesh
from geometry.polyhedra.merged_faces import merged_faces
from geometry.polyhedra.polygons import areas_normals_centroids
from geometry.polyhedra.shells import outward
from geometry.polyhedra.validate import FARTHEST, FLAT
from geometry.polyhedra.weld import weld

SAME = 1e-9
"""Of the longest side of a block: vertices that lie closer together are one."""


class Shell(NamedTuple):
    """A closed body: points (P, 3) m, each once, the triangles (T, 3) round it, looking outwards, and the flat face
    (T,) that each is part of."""

    points: np.ndarray
    triangle: np.ndarray
    face: np.ndarray


def polyhedra(
    solids: Sequence[tuple[Any, Any]],
    names: Sequence[str],
    unit: Sequence[int],
    group: Sequence[str],
    flat: float = 0.0,
) -> Blocks:
    """One block for each pair of vertices (V, 3) m and faces, which are lists of 3 or more vertex numbers.

    Faces are flat polygons, convex or not, or triangles (T, 3); triangles in one plane become one face. They may be
    numbered either way round: they are turned to look outwards. names (B,) says what to call a block in a message; unit
    and group (B,) are as in Blocks, groups by name. Faces whose corners stand off a plane by up to flat (m) are made
    flat. Raises GeometryError for what is no closed body with plane faces.
    """
    if not len(solids):
        raise GeometryError("there are no blocks")
    mesh = joined([_shell(*solid, name, flat) for solid, name in zip(solids, names, strict=True)])
    return from_mesh(flattened(mesh, np.full(len(solids), flat)) if flat > 0 else mesh, unit, group)


def joined(shells: Sequence[Shell]) -> Mesh:
    """The surfaces of all bodies in their order, faces numbered one body after the other."""
    points, count = ([len(part) for part in parts] for parts in zip(*((s.points, s.face) for s in shells), strict=True))
    body = np.repeat(np.arange(len(shells)), count)
    first, before = np.cumsum(points) - points, np.cumsum(count) - count
    return Mesh(
        np.concatenate([shell.points for shell in shells]),
        np.concatenate([shell.triangle for shell in shells]) + first[body][:, None],
        np.concatenate([shell.face for shell in shells]) + before[body],
        body,
    )


def from_mesh(mesh: Mesh, unit: Sequence[int], group: Sequence[str]) -> Blocks:
    """One block for each closed body, of the unit and the group (B,) by name."""
    loops, block = merged_faces(mesh.points, mesh.triangle, mesh.body, mesh.face)
    faces: list[list[np.ndarray]] = [[] for _ in unit]
    for loop, b in zip(loops, block.tolist(), strict=True):
        faces[b].append(mesh.points[loop])
    groups = tuple(dict.fromkeys(group))
    return from_faces(faces, unit, [groups.index(name) for name in group], groups)


def _shell(vertices: Any, faces: Any, name: str, flat: float) -> Shell:
    """The triangles round a body."""
    points = _points(vertices, name)
    size = float(np.ptp(points, axis=0).max())
    first, number = weld(points, SAME * size)
    points = points[first]
    parts = []
    for f, corners in enumerate(_corners(faces, len(number), name)):
        loop = number[corners]
        loop = loop[loop != np.roll(loop, 1)]
        if len(loop) < 3:
            raise GeometryError(f"{name}: face {f} has fewer than 3 corners that differ")
        parts.append(loop[_cut(points[loop], max(FLAT * size, flat), f"{name}: face {f}")])
    triangle = outward(points, np.concatenate(parts), name)
    _require_one_body(triangle, name)
    face = np.repeat(np.arange(len(parts)), [len(part) for part in parts])
    return Shell(points, triangle, face)


def _points(vertices: Any, name: str) -> np.ndarray:
    try:
        points = np.array(vertices, dtype=float)
    except (TypeError, ValueError):
        points = np.zeros(0)
    if points.ndim != 2 or points.shape[1] != 3 or len(points) < 4:
        raise GeometryError(f"{name}: vertices must be 4 or more points (V, 3) in m, not of the shape {points.shape}")
    if not np.all(np.abs(points) <= FARTHEST):
        row = int(np.argmin(np.all(np.abs(points) <= FARTHEST, axis=1)))
        raise GeometryError(f"{name}: vertex {row} is {points[row].tolist()}, allowed: up to {FARTHEST:.0e} m")
    return points


def _corners(faces: Any, count: int, name: str) -> list[np.ndarray]:
    """Every face as an array of vertex numbers."""
    try:
        loops = [np.asarray(face) for face in faces]
    except (TypeError, ValueError):
        loops = []
    if len(loops) < 4:
        raise GeometryError(f"{name}: faces must be 4 or more lists of vertex numbers, there are {len(loops)}")
    for f, corners in enumerate(loops):
        if corners.ndim != 1 or corners.dtype.kind not in "iu" or len(corners) < 3:
            raise GeometryError(f"{name}: face {f} must be a list of 3 or more vertex numbers")
        if corners.min() < 0 or corners.max() >= count:
            raise GeometryError(f"{name}: face {f} names vertices {corners.tolist()}, allowed: 0 to {count - 1}")
    return loops


def _cut(corners: np.ndarray, flat: float, face: str) -> np.ndarray:
    """(n - 2, 3) triangles of a polygon (n, 3), which must be flat within `flat` (m)."""
    if len(corners) == 3:
        return np.array([[0, 1, 2]])
    _, normal, centroid = areas_normals_centroids(corners[None])
    height = float(np.abs((corners - centroid[0]) @ normal[0]).max())
    if not height <= flat:
        raise GeometryError(
            f"{face} is not flat: a corner stands {height:.3g} m off it, allowed: {flat:.3g} m; give it in triangles"
        )
    try:
        return triangles(corners)
    except GeometryError as error:
        raise GeometryError(f"{face}: {error}") from None


def _require_one_body(triangle: np.ndarray, name: str) -> None:
    """All triangles must hang together over their vertices."""
    count = int(triangle.max()) + 1
    ends = triangle[:, [0, 0]].ravel(), triangle[:, 1:].ravel()
    link = coo_array((np.ones(2 * len(triangle)), ends), shape=(count,) * 2)
    bodies = len(np.unique(connected_components(link, directed=False)[1][triangle[:, 0]]))
    if bodies > 1:
        raise GeometryError(f"{name} consists of {bodies} bodies that do not touch; make a block of each")
