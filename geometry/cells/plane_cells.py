"""Convex polygons of a plane divided into cells, all together."""

import time
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from geometry.blocks import CellReport, GeometryError
from geometry.cells.plane import RELAXATIONS, PlaneDiagram, hold_sizes, plane_diagram, regularise, relax
from geometry.cells.plane_domains import plane_domains
from geometry.cells.plane_measures import loops_in_metres, report

SETTLED = 0.01
"""Energy below which nothing is worth another attempt: no edge or segment lacks more than a tenth of its threshold."""
LATEST = 16
"""Divisions that a process remembers: runs of one specimen, as in a sweep, ask for the same one again."""
Division = tuple[list[np.ndarray], CellReport]
_divisions: dict[tuple[Any, ...], Division] = {}


def divide_plane(
    polygons: Sequence[np.ndarray],
    counts: np.ndarray,
    target: np.ndarray,
    sites: Sequence[np.ndarray],
    laguerre: bool = True,
    regular: bool = True,
) -> Division:
    """Corners (k, 2) m of every cell, counter-clockwise, polygon by polygon, and what the division came to.

    polygons   (k, 2) m each, convex and counter-clockwise; where two lie on one line they meet in a joint
    counts     (U,) cells of each        target  (n,) m2, areas that add up to each polygon's
    sites      (n, 2) m, one set of seeds for each attempt; later ones are tried where an earlier one gets stuck
    laguerre   hold the targets by weights; False: a Voronoi division, whose sizes fall out as they may
    regular    lengthen short edges and short joint segments
    Raises GeometryError where a site is left without a cell. Of the LATEST divisions none is made twice.
    """
    arrays = [*polygons, counts, target, *sites]
    numbers = tuple((np.shape(array), np.asarray(array).tobytes()) for array in arrays)
    key = (numbers, len(polygons), laguerre, regular)
    if key not in _divisions:
        _divisions[key] = _divided(polygons, counts, target, sites, laguerre, regular)
        if len(_divisions) > LATEST:
            _divisions.pop(next(iter(_divisions)))
    loops, outcome = _divisions[key]
    return [loop.copy() for loop in loops], outcome


def _divided(
    polygons: Sequence[np.ndarray],
    counts: np.ndarray,
    target: np.ndarray,
    sites: Sequence[np.ndarray],
    laguerre: bool,
    regular: bool,
) -> Division:
    begin = time.perf_counter()
    h = float(np.sqrt(target.sum() / len(target)))
    domains = plane_domains(polygons, counts, h)
    best, minimum = None, np.inf
    for seeds in sites:
        with threadpool_limits(1):  # threads of BLAS make the many small products ten times slower
            diagram, residual = _attempt(plane_diagram(domains, seeds / h), target / h**2, laguerre, regular)
        if best is None or residual < minimum:
            best, minimum = diagram, residual
        if minimum <= SETTLED or not regular:
            break
    assert best is not None
    if np.any(best.count < 3):
        x, z = best.site[np.argmin(best.count)] * h
        raise GeometryError(f"cells: the site at x = {x:g}, z = {z:g} m has no cell; move it away from its neighbours")
    outcome = report(best, target / h**2, h, 0.0)
    loops = loops_in_metres(best, polygons, h)
    return loops, replace(outcome, seconds=time.perf_counter() - begin)


def _attempt(diagram: PlaneDiagram, target: np.ndarray, laguerre: bool, regular: bool) -> tuple[PlaneDiagram, float]:
    residual = 0.0
    if regular:
        relax(diagram, RELAXATIONS)
        if laguerre:
            hold_sizes(diagram, target, tolerance=0.05)
        residual = regularise(diagram, target, laguerre)
    if not diagram.update():
        residual = np.inf
    elif laguerre and not hold_sizes(diagram, target):
        residual += 1.0
    return diagram, residual
