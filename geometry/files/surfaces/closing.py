"""Surfaces of a file made closed: doubled faces left out, corners welded, small holes covered; and their parts."""

from collections import Counter
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from geometry.blocks import GeometryError
from geometry.files.surfaces.surface import Surface
from geometry.files.surfaces.t_junctions import with_corners_on_edges
from geometry.polyhedra.weld import weld

SAME = 1e-6
"""Of the longest side of a surface: corners that lie closer together are one."""
ROUNDING = 2.0**-22
"""Of the largest coordinate: what single precision, or a number of seven digits, may be off."""
Loops = list[np.ndarray]


class ClosedBody(NamedTuple):
    """A closed body: what a message calls it, its points (P, 3) in the unit of the file, its faces as numbers of
    points, and how far the corners of a face may stand off a plane."""

    called: str
    points: np.ndarray
    loops: Loops
    flat: float


@dataclass
class Changes:
    """Changes on the way, added up over all surfaces; lengths in the unit of the file.

    doubled       faces left out because they are there twice
    collapsed     faces left out because their corners are fewer than three
    bent          faces that are not flat, of `faces`; `highest`: how far a corner stands off the mean plane of its face
    holes         holes that were closed, the widest `widest` wide
    junctions     corners that lay on an edge of a neighbour and were put into it
    turned        bodies with faces that looked inwards, which were turned
    moved         how far a corner moved so that faces which are flat but for noise are flat
    volume        of all bodies, and `other_volume` if each bent face were a fan of triangles round its middle
    """

    doubled: int = 0
    collapsed: int = 0
    faces: int = 0
    bent: int = 0
    highest: float = 0.0
    holes: int = 0
    widest: float = 0.0
    junctions: int = 0
    turned: int = 0
    moved: float = 0.0
    volume: float = 0.0
    other_volume: float = 0.0


def parts_of(surface: Surface, called: str, changes: Changes, holes: float, flat: float) -> list[ClosedBody]:
    """Each closed body of a surface.

    holes  how wide a hole may be that is closed
    flat   how far the corners of a face may stand off a plane that is made flat; rounding in single precision always
    Bodies are told apart by their corners. Where they are not closed so, corners that lie on each other are one first.
    Raises GeometryError, which calls the surface `called`, where it is open.
    """
    used, place = np.unique(np.concatenate(surface.faces), return_inverse=True)
    points = surface.points[used]
    loops = np.split(place.ravel(), np.cumsum([len(face) for face in surface.faces])[:-1])
    if not np.isfinite(points).all():
        raise GeometryError(f"{called}: a corner is no finite number")
    size = float(np.ptp(points, axis=0).max())
    flat = max(flat, ROUNDING * float(np.abs(points).max()))
    if not size > 0:
        raise GeometryError(f"{called}: all its corners lie in one point")
    tried = Changes()
    clean = _cleaned(loops, tried)
    if not _is_closed(clean):
        first, number = weld(points, SAME * size)
        points, tried = points[first], Changes()
        clean = _cleaned([number[loop] for loop in loops], tried)
        if not _is_closed(clean):
            mended, tried.junctions = with_corners_on_edges(points, clean, max(flat, SAME * size))
            clean = mended if tried.junctions else clean
        clean += _lids(points, clean, holes, tried)
        _require_closed(points, clean, called)
    changes.doubled += tried.doubled
    changes.collapsed += tried.collapsed
    changes.holes += tried.holes
    changes.junctions += tried.junctions
    changes.widest = max(changes.widest, tried.widest)
    parts = _parts(clean, len(points))
    return [
        ClosedBody(f"{called}, body {n}" if len(parts) > 1 else called, *_own_points(points, part), flat)
        for n, part in enumerate(parts, 1)
    ]


def _own_points(points: np.ndarray, loops: Loops) -> tuple[np.ndarray, Loops]:
    """The points that some faces stand on, and the faces as numbers of these."""
    used, place = np.unique(np.concatenate(loops), return_inverse=True)
    return points[used], np.split(place.ravel(), np.cumsum([len(loop) for loop in loops])[:-1])


def _cleaned(loops: Loops, changes: Changes) -> Loops:
    """The faces without corners that follow themselves, each face once."""
    seen, clean = set(), []
    for loop in loops:
        loop = loop[loop != np.roll(loop, 1)]
        if len(loop) < 3:
            changes.collapsed += 1
            continue
        key = tuple(sorted(loop.tolist()))
        if key in seen:
            changes.doubled += 1
            continue
        seen.add(key)
        clean.append(loop)
    return clean


def _edges(loops: Loops) -> Counter:
    return Counter(
        (min(edge), max(edge))
        for loop in (loop.tolist() for loop in loops)
        for edge in zip(loop, [*loop[1:], loop[0]], strict=True)
    )


def _is_closed(loops: Loops) -> bool:
    return bool(loops) and all(times == 2 for times in _edges(loops).values())


def _lids(points: np.ndarray, loops: Loops, widest: float, changes: Changes) -> Loops:
    """A polygon for each hole that is no wider than widest."""
    beside: dict[int, list[int]] = {}
    for (a, b), times in _edges(loops).items():
        if times == 1:
            beside.setdefault(a, []).append(b)
            beside.setdefault(b, []).append(a)
    directed = {edge for loop in loops for edge in zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True)}
    lids = []
    while beside:
        first = next(iter(beside))
        ring, at = [], first
        while at in beside and len(beside[at]) == 2:
            ring.append(at)
            at = next((other for other in beside.pop(at) if other in beside), first)
        if at != first or len(ring) < 3:
            beside.pop(at, None)  # an edge that ends, or corners at which several holes meet: told as open
            continue
        width = float(np.linalg.norm(points[ring] - points[ring].mean(axis=0), axis=1).max() * 2)
        if width <= widest:
            lids.append(np.array(ring[::-1] if (ring[0], ring[1]) in directed else ring))
            changes.holes += 1
            changes.widest = max(changes.widest, width)
    return lids


def _require_closed(points: np.ndarray, loops: Loops, called: str) -> None:
    if not loops:
        raise GeometryError(f"{called}: it has no faces with three corners that differ")
    edges = _edges(loops)
    free = [edge for edge, times in edges.items() if times == 1]
    many = [edge for edge, times in edges.items() if times > 2]
    if free:
        raise GeometryError(
            f"{called} is not closed: {len(free)} of {len(edges)} edges belong to one face only, the first at "
            f"{place_words(points[list(free[0])].mean(axis=0))}; {_way_out(points, loops)}"
        )
    if many:
        place = place_words(points[list(many[0])].mean(axis=0))
        raise GeometryError(
            f"{called}: {edges[many[0]]} faces meet at the edge at {place}; bodies that touch must be "
            "groups or files of their own"
        )


def _way_out(points: np.ndarray, loops: Loops) -> str:
    """Advice that closes an open surface: it was tried."""
    tried = Changes()
    if _is_closed(loops + _lids(points, loops, np.inf, tried)):
        return f"close it where it was made, or by --holes: the widest of its holes is {tried.widest:.4g} wide"
    return "close it where it was made"


def _parts(loops: Loops, count: int) -> list[Loops]:
    """The faces of each body: those that hang together over corners."""
    ends = np.concatenate([np.stack([np.full(len(loop) - 1, loop[0]), loop[1:]]) for loop in loops], axis=1)
    link = coo_array((np.ones(ends.shape[1]), tuple(ends)), shape=(count, count))
    label = connected_components(link, directed=False)[1]
    bodies: dict[int, Loops] = {}
    for loop in loops:
        bodies.setdefault(int(label[loop[0]]), []).append(loop)
    return list(bodies.values())


def place_words(place: np.ndarray) -> str:
    """A place (3,) in words."""
    return "({:.4g}, {:.4g}, {:.4g})".format(*place)
