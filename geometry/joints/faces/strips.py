"""A joint face as a section across a direction: strips that stand for its area, or its contact points in rows."""

from typing import NamedTuple

import numpy as np

STRIPS = 32
"""That stand for a stress spread over the area."""
NARROW = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, STRIPS + 1))
"""Where strips begin and end, over the depth: narrow at the edges, where a section tears and presses first."""
NARROWER = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, 4 * STRIPS + 1))
"""The same of a section that bears on a strip beside its edge."""
ALIKE = 1e-6
"""Of the depth of a section: fibres nearer to each other are one."""


class Section(NamedTuple):
    """Fibres across a joint: place (n,) m from its middle, area (n,) m2."""

    place: np.ndarray
    area: np.ndarray

    @property
    def depth(self) -> float:
        """From edge to edge (m)."""
        return float(np.ptp(self.place))


def spread(
    polygons: list[np.ndarray], along: np.ndarray, across: np.ndarray, middle: np.ndarray, cuts: np.ndarray = NARROW
) -> Section:
    """Convex polygons (K, 3) m in strips across a direction; unit vectors `along` and `across` (3,) in their plane.

    cuts  (N + 1,) where strips begin and end, over the depth; polygons begin and end at cuts of their own
    """
    ends = [(corners - middle) @ along for corners in polygons]
    low, high = min(s.min() for s in ends), max(s.max() for s in ends)
    edges = low + cuts * (high - low)
    if len(polygons) > 1:
        edges = np.unique(np.concatenate([edges, *ends]))
    place = 0.5 * (edges[1:] + edges[:-1])
    width = sum(_widths(s, (corners - middle) @ across, place) for s, corners in zip(ends, polygons, strict=True))
    return Section(place, width * np.diff(edges))


def _widths(s: np.ndarray, t: np.ndarray, place: np.ndarray) -> np.ndarray:
    """(N,) m: the width at places (N,) along s of a convex polygon with corners s, t (K,) m."""
    low, high = np.full(len(place), np.inf), np.full(len(place), -np.inf)
    for a, b, ta, tb in zip(s, np.roll(s, -1), t, np.roll(t, -1), strict=True):
        if a != b:
            passes = (place - a) * (place - b) <= 0.0
            cut = np.where(passes, ta + (tb - ta) * (place - a) / (b - a), np.nan)
            low, high = np.fmin(low, cut), np.fmax(high, cut)
    return np.where(high > low, high - low, 0.0)


def depth_of(place: np.ndarray) -> float:
    """m, between the middles of the outermost strips of a section with corners at `place` (K,) m across."""
    return float(np.ptp(place)) * (1.0 - NARROW[1])


def of_points(place: np.ndarray, area: np.ndarray) -> Section:
    """Contact points at places (n,) m across a joint, with areas (n,) m2: those in one row are one fibre."""
    order = np.argsort(place)
    new = np.diff(place[order], prepend=-np.inf) > ALIKE * float(np.ptp(place))
    row = np.cumsum(new) - 1
    whole = np.bincount(row, area[order])
    return Section(np.bincount(row, (area * place)[order]) / whole, whole)
