"""Closed bodies of surfaces: bent faces cut, all turned outwards, what is flat but for noise made flat."""

from collections.abc import Sequence

import numpy as np

from geometry.blocks import GeometryError
from geometry.files.surfaces.bent_faces import bent_triangles, height_of
from geometry.files.surfaces.closed import closed_parts
from geometry.files.surfaces.closing import Changes, ClosedBody, Loops, parts_of, place_words
from geometry.files.surfaces.crossings import crossing
from geometry.files.surfaces.flat_convex import DEEP, flat_convex
from geometry.files.surfaces.surface import Surface
from geometry.polyhedra.convexity import triangles
from geometry.polyhedra.flat.flatten import flattened
from geometry.polyhedra.flat.regions import BENT, Mesh
from geometry.polyhedra.polygons import areas_normals_centroids
from geometry.polyhedra.shells import outward
from geometry.polyhedra.validate import FLAT
from geometry.specimens.from_arrays import Shell, joined

MOST = 20_000
"""Bodies of a file or a folder."""
TRIANGLE = np.array([[0, 1, 2]])


def bodies_of(
    surfaces: Sequence[tuple[str, Surface]], file: str, changes: Changes, holes: float = 0.0, flat: float = 0.0
) -> tuple[Mesh, list[int]]:
    """The closed bodies of all surfaces, in the unit of the file, and how many each surface has.

    surfaces  with what a message calls each
    holes     how wide a hole may be that is closed
    flat      how far the corners of a face may stand off a plane that is made flat; more where numbers are large
    Raises GeometryError for the first surface that is open, crosses itself or encloses nothing, and for too
    many bodies.
    """
    parts: list[ClosedBody] = []
    counts, refused = [], None
    try:
        for (called, surface), closed in zip(surfaces, closed_parts(surfaces, flat), strict=True):
            mine = parts_of(surface, called, changes, holes, flat) if closed is None else closed
            parts += mine
            counts.append(len(mine))
            if len(parts) > MOST:
                raise GeometryError(f"'{file}' holds more than {MOST} bodies")
    except GeometryError as error:
        refused = error  # a body before it may be wrong as well, and is told first
    shells = _shells(parts, changes)
    if refused is not None:
        raise refused
    mesh = joined(shells)
    even = flattened(mesh, np.array([part.flat for part in parts]))
    changes.moved = float(np.linalg.norm(even.points - mesh.points, axis=1).max())
    return even, counts


def _shells(parts: Sequence[ClosedBody], changes: Changes) -> list[Shell]:
    shells = []
    for part, outwards in zip(parts, flat_convex(parts), strict=True):
        if outwards is None:
            shells.append(_body(part, changes))
            continue
        shells.append(outwards.shell)
        changes.faces += len(part.loops)
        changes.turned += outwards.turned
        changes.volume += outwards.volume
        changes.other_volume += outwards.volume
    return shells


def _body(part: ClosedBody, changes: Changes) -> Shell:
    called, points, loops, flat = part
    size = float(np.ptp(points, axis=0).max())
    _require_areas(points, loops, FLAT * size, called)
    parts, fans, whole = [], [], []
    for f, loop in enumerate(loops):
        corners = points[loop]
        cut, bent = TRIANGLE, False
        if len(loop) > 3:
            cut, bent = _cut(corners, size, flat, f"{called}: face {f + 1}", changes)
        parts.append(loop[cut])
        fans.append(_fan(corners) if bent else corners[cut])
        whole += [(f, n if bent else 0) for n in range(len(cut))]
    shell = np.concatenate(parts)
    turned = outward(points, shell, called)
    flipped = (turned != shell).any(axis=1)
    sign = np.where(flipped, -1.0, 1.0)
    of_face = np.cumsum([0, *(len(part) for part in parts)])
    fan_sign = np.repeat(sign[of_face[:-1]], [len(fan) for fan in fans])
    middle = points.mean(axis=0)
    volume = _volume(points[turned] - middle)
    if not volume > FLAT * size**3:
        raise GeometryError(f"{called} encloses no volume: {volume:.3g} of a body {size:.3g} long")
    changes.faces += len(loops)
    changes.turned += bool(flipped.any())
    changes.volume += volume
    changes.other_volume += float((_volumes(np.concatenate(fans) - middle) * fan_sign).sum())
    if (where := crossing(points, turned, DEEP * size)) is not None:
        raise GeometryError(f"{called} goes through itself at {place_words(where)}; mend it where it was made")
    face = np.unique(whole, axis=0, return_inverse=True)[1].reshape(-1)
    return Shell(points, turned, face)


def _require_areas(points: np.ndarray, loops: Loops, side: float, called: str) -> None:
    """Raise GeometryError for a triangle that is smaller than a square with this side."""
    three = [f for f, loop in enumerate(loops) if len(loop) == 3]
    if not three:
        return
    corners = points[np.array([loops[f] for f in three])]
    small = ~(areas_normals_centroids(corners)[0] > side**2)
    if small.any():
        n = int(np.argmax(small))
        place = place_words(corners[n].mean(axis=0))
        raise GeometryError(f"{called}: face {three[n] + 1}, at {place}, has no area; mend it where it was made")


def _cut(corners: np.ndarray, size: float, flat: float, face: str, changes: Changes) -> tuple[np.ndarray, bool]:
    """Triangles of a polygon (n, 3), and whether it is bent by more than counts as flat."""
    height = height_of(corners)
    side = float(np.sqrt(areas_normals_centroids(corners[None])[0][0]))
    if height <= max(FLAT * size, min(flat, BENT * side)):
        try:
            return triangles(corners), False
        except GeometryError as error:
            raise GeometryError(f"{face}: {error}") from None
    cut = bent_triangles(corners, face)
    changes.bent += 1
    changes.highest = max(changes.highest, height)
    return cut, True


def _fan(corners: np.ndarray) -> np.ndarray:
    middle = np.broadcast_to(corners.mean(axis=0), corners.shape)
    return np.stack([middle, corners, np.roll(corners, -1, axis=0)], axis=1)


def _volumes(corner: np.ndarray) -> np.ndarray:
    return np.asarray(np.einsum("ti,ti->t", corner[:, 0], np.cross(corner[:, 1], corner[:, 2])) / 6)


def _volume(corner: np.ndarray) -> float:
    return float(_volumes(corner).sum())
