"""A plane division as polygons in metres, and what it came to."""

from collections.abc import Sequence

import numpy as np

from geometry.blocks import CellReport
from geometry.cells.plane import PlaneDiagram, areas_and_centroids, edges
from geometry.cells.plane_energy import joint_points
from geometry.cells.request import report_of
from geometry.polyhedra.weld import weld

WELD = 1e-8
"""Corners closer than this share of h are one."""
SMALL = 0.125


def loops_in_metres(diagram: PlaneDiagram, polygons: Sequence[np.ndarray], h: float) -> list[np.ndarray]:
    """Corners (k, 2) m of every cell; what neighbours share is the same bit for bit, walls are met exactly."""
    inside = np.arange(diagram.corner.shape[1]) < diagram.count[:, None]
    leaving = diagram.label[inside]
    start = np.cumsum(diagram.count) - diagram.count
    before = np.arange(len(leaving)) - 1
    before[start] += diagram.count
    place, walls = _on_walls(diagram.corner[inside] * h, leaving, leaving[before], np.concatenate(polygons))
    first, number = weld(place, WELD * h, walls)  # where corners are one, the one that lies on most walls counts
    welded = place[first][number]
    distinct = number != number[before]
    return [loop[keep] for loop, keep in zip(np.split(welded, start[1:]), np.split(distinct, start[1:]), strict=True)]


def _on_walls(
    place: np.ndarray, leaving: np.ndarray, arriving: np.ndarray, corner: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Corners moved on to the walls they belong to, free of rounding, and the number of walls (m,) they lie on.

    leaving, arriving  (m,) labels of the edges that begin and end at each corner
    corner             (W, 2) m, where each wall begins
    """
    on_leaving, on_arriving = leaving < 0, arriving < 0
    for label, on in ((arriving, on_arriving), (leaving, on_leaving)):
        wall = -1 - label[on]
        begin = corner[wall]
        level = np.abs(place[on] - begin) <= 1e-12 * np.abs(corner).max()  # along which axis the wall keeps its place
        place[on] = np.where(level, begin, place[on])
    at_corner = on_leaving & on_arriving
    place[at_corner] = corner[-1 - leaving[at_corner]]
    return place, on_leaving.astype(np.int64) + on_arriving


def report(diagram: PlaneDiagram, target: np.ndarray, h: float, seconds: float) -> CellReport:
    """Quality of a division against the target areas (n,), in units of h squared."""
    length = edge_lengths(diagram)
    segment = joint_segments(diagram)
    area = areas_and_centroids(diagram)[0]
    shortest_joint = float(segment.min()) if len(segment) else None
    return report_of(length, SMALL, area / target, h, shortest_joint, seconds)


def edge_lengths(diagram: PlaneDiagram) -> np.ndarray:
    """(m,) lengths in h of all edges, those on walls too, each once."""
    cell, label, length = edges(diagram)
    return length[((label < 0) | (label > cell)) & (length > WELD)]


def joint_segments(diagram: PlaneDiagram) -> np.ndarray:
    """(m,) lengths in h between corners of cells, of either side, that follow each other along a joint."""
    line, place, _, _ = joint_points(diagram.domains, diagram.corner, diagram.label, diagram.count)
    order = np.lexsort((place, line))
    gap = np.diff(place[order])[np.diff(line[order]) == 0]
    return gap[gap > WELD]
