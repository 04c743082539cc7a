"""Convex polyhedra to be divided into cells, as half-spaces."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.optimize import linprog
from scipy.spatial import ConvexHull, HalfspaceIntersection, QhullError

from geometry.blocks import GeometryError


@dataclass(frozen=True)
class Domain:
    """All x with normal @ x <= offset.

    normal  (m, 3) unit vectors that point outwards
    offset  (m,) m
    """

    normal: np.ndarray
    offset: np.ndarray

    @cached_property
    def corners(self) -> np.ndarray:
        """(k, 3) m; where more than three walls meet a corner comes several times."""
        middle, room = _inner_point(self.normal, self.offset)
        walls = np.column_stack([self.normal, (self.normal @ middle - self.offset) / room])
        try:
            corners = HalfspaceIntersection(walls, np.zeros(3)).intersections
        except QhullError:
            corners = np.full((1, 3), np.inf)
        if not np.all(np.isfinite(corners)) or np.abs(corners).max() > 1e9:
            raise GeometryError("cells: the domain is not bounded; it needs walls on all sides")
        return middle + room * corners

    @cached_property
    def volume(self) -> float:
        """m3."""
        return float(ConvexHull(self.corners).volume)

    @cached_property
    def centre(self) -> np.ndarray:
        """(3,) m, the mean of the corners."""
        return np.asarray(self.corners.mean(axis=0))

    def contains(self, points: np.ndarray) -> np.ndarray:
        """(n,) whether each of the points (n, 3) m lies inside, walls included."""
        return np.asarray(np.all(points @ self.normal.T <= self.offset, axis=1))

    def scaled(self, h: float) -> "Domain":
        """The same domain about its centre, in units of h (m)."""
        return Domain(self.normal, (self.offset - self.normal @ self.centre) / h)


def box_domain(low: np.ndarray, high: np.ndarray) -> Domain:
    """The box between two corners (3,) m; walls in the order x-, y-, z-, x+, y+, z+."""
    low, high = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
    if not np.all(high > low):
        raise GeometryError(f"cells: the box from {low.tolist()} to {high.tolist()} m has no volume")
    return Domain(np.concatenate([-np.eye(3), np.eye(3)]), np.concatenate([-low, high]))


def _inner_point(normal: np.ndarray, offset: np.ndarray) -> tuple[np.ndarray, float]:
    """Centre (3,) and radius of the largest ball inside."""
    walls = np.column_stack([normal, np.linalg.norm(normal, axis=1)])
    optimum = linprog([0, 0, 0, -1], A_ub=walls, b_ub=offset, bounds=[(None, None)] * 3 + [(0, None)])
    if optimum.status == 3:
        raise GeometryError("cells: the domain is not bounded; it needs walls on all sides")
    if not optimum.success or optimum.x[3] <= 0:
        raise GeometryError("cells: the half-spaces of the domain leave no volume between them")
    return optimum.x[:3], float(optimum.x[3])
