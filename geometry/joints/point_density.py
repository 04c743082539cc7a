"""How many contact points a joint polygon gets: so many along its edges, so many in all, or a spacing."""

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from geometry.blocks import GeometryError

RULES = ("gauss", "vertex")
FINEST = 200
"""Longest edge over spacing, beyond which the spacing is taken for a slip of a unit."""
NEWTON = 12
"""Rounds, of which each doubles the digits: more than are needed."""


@dataclass(frozen=True)
class Fan:
    """Points of polygons that are no parallelograms; each is cut into triangles round its centroid.

    sectors  (N,) points, each in the middle of its share of the fan; 0 where parts counts
    parts    (N,) steps into which every edge of a triangle is cut, which gives parts^2 small triangles
    inside   (N,) points in each small triangle: 1 or 3 (exact to degree 2) of "gauss"; of "vertex" 1 besides those at
             its corners (exact to degree 2), 0 where the polygon has points at its own corners alone
    """

    sectors: np.ndarray
    parts: np.ndarray
    inside: np.ndarray


@dataclass(frozen=True)
class Density:
    """per_edge: a number of points along each edge, or one for edges along x, y and z; per_face, a number for the
    whole polygon, or spacing (m) take its place where they are given."""

    rule: str = "gauss"
    per_edge: int | Sequence[int] = 2
    per_face: int | None = None
    spacing: float | None = None

    def __post_init__(self) -> None:
        """Raises GeometryError for an unknown rule and for numbers that give no points."""
        if self.rule not in RULES:
            raise GeometryError(f"contact points: rule {self.rule!r} is unknown; allowed: 'gauss', 'vertex'")
        if self.per_face is not None and self.spacing is not None:
            raise GeometryError("contact points: points_per_face and a spacing exclude each other; keep one of them")
        if self.spacing is not None and not 0 < self.spacing < np.inf:
            raise GeometryError(f"contact points: the spacing is {self.spacing:g} m, it must be above 0 m")
        if self.per_face is not None:
            self._require("points_per_face", self.per_face, 1 if self.rule == "gauss" else 4)
        if np.shape(self.per_edge) not in ((), (3,)):
            raise GeometryError(f"contact points: points_per_edge is {self.per_edge}; allowed: one number, or three")
        for number in np.ravel(self.per_edge).tolist():
            self._require("points_per_edge", number, self.least)

    @property
    def least(self) -> int:
        """The fewest points along an edge."""
        return 1 if self.rule == "gauss" else 2

    def _require(self, name: str, number: float, least: int) -> None:
        if number != int(number) or number < least:
            raise GeometryError(
                f"contact points: {name} is {number:g}, rule {self.rule!r} needs a whole number of at least "
                f"{least}; nearest: {max(least, round(number))}"
            )

    def of_parallelograms(self, corners: np.ndarray) -> np.ndarray:
        """(N, 2) points along the first and along the last edge of each parallelogram (N, 4, 3)."""
        edge = np.stack([corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 0]], axis=1)
        length = np.linalg.norm(edge, axis=2)
        if self.spacing is not None:
            return self._by_spacing(length)
        if self.per_face is not None:
            return _shared_out(length, self.per_face)
        per_axis = np.broadcast_to(np.array(self.per_edge, dtype=np.int64), 3)
        return per_axis[np.argmax(np.abs(edge), axis=2)]

    def of_fans(self, count: np.ndarray, normal: np.ndarray, longest: np.ndarray) -> Fan:
        """For polygons with count (N,) corners, unit normals (N, 3), and the longest edge (N,) m of their fans."""
        none, gauss = np.zeros(len(count), dtype=np.int64), self.rule == "gauss"
        if self.spacing is not None:
            self._require_coarse(longest)
            step = 2 if gauss else 1  # three points in a triangle are half an edge apart
            parts = np.maximum(np.ceil(longest / (step * self.spacing)), 1).astype(np.int64)
            return Fan(none, parts, np.where(gauss, 3, parts > 1))
        if self.per_face is not None:
            return _fans_of(count, self.per_face, self.rule)
        per_axis = np.broadcast_to(np.array(self.per_edge, dtype=np.int64), 3)
        along = np.argsort(np.abs(normal), axis=1, kind="stable")[:, :2]
        number = per_axis[along].min(axis=1)
        if gauss:
            return Fan(none, (number + 1) // 2, np.full(len(count), 3))
        return Fan(none, np.maximum(2 * (number - 1) // 3, 1), np.minimum(number - 2, 1))

    def _by_spacing(self, length: np.ndarray) -> np.ndarray:
        """The fewest points along edges (N, 2) m whose neighbours are no further apart than the spacing."""
        self._require_coarse(length)
        assert self.spacing is not None
        most = int(np.ceil(1.6 * length.max(initial=0.0) / self.spacing)) + 2
        numbers = range(self.least, most + 1)
        different, place = np.unique(length, return_inverse=True)
        counts = [bisect_left(numbers, -self.spacing / x, key=lambda n: -widest_gap(self.rule, n)) for x in different]
        return self.least + np.array(counts, dtype=np.int64)[place.reshape(length.shape)]

    def _require_coarse(self, length: np.ndarray) -> None:
        longest = float(length.max(initial=0.0))
        assert self.spacing is not None
        if longest > FINEST * self.spacing:
            raise GeometryError(
                f"contact points: a spacing of {self.spacing:g} m is too fine for an edge of {longest:.4g} m; "
                f"nearest: {longest / FINEST:.3g} m"
            )


def edge_rule(rule: str, number: int) -> tuple[np.ndarray, np.ndarray]:
    """Places in [0, 1] along an edge and their weights, which add up to 1: of Gauss and Legendre ("gauss"), or of Gauss
    and Lobatto ("vertex"), which begin and end at the ends of the edge."""
    place, weight = np.polynomial.legendre.leggauss(number) if rule == "gauss" else lobatto(number)
    return (place + 1) / 2, weight / 2


@lru_cache(maxsize=256)
def lobatto(number: int) -> tuple[np.ndarray, np.ndarray]:
    """Places in [-1, 1], rising, and weights, which add up to 2 (Abramowitz and Stegun 25.4.32): exact to the power
    2 number - 3. By Newton, from the places of Chebyshev on: where the Legendre polynomial of degree n = number - 1 has
    its extremes, x P_n = P_(n-1)."""
    n = number - 1
    place = -np.cos(np.pi * np.arange(number) / n)
    for _ in range(NEWTON):
        before, now = np.ones(number), place.copy()
        for k in range(2, number):
            before, now = now, ((2 * k - 1) * place * now - (k - 1) * before) / k
        place = place - (place * now - before) / (number * now)
    place = 0.5 * (place - place[::-1])
    weight = 2.0 / (n * number * now**2)
    return place, weight * (2.0 / weight.sum())


@lru_cache(maxsize=4096)
def widest_gap(rule: str, number: int) -> float:
    """Between neighbours along an edge of length 1; a point by the end counts as next to its mirror image."""
    place = edge_rule(rule, number)[0]
    return float(max(np.diff(place).max(initial=0.0), 2 * place[0]))


def _shared_out(length: np.ndarray, wanted: int) -> np.ndarray:
    """(N, 2) numbers with about the wanted product, in the ratio of the edges; from 4 on, 2 each way at least."""
    least = 2 if wanted >= 4 else 1
    first = np.clip(np.round(np.sqrt(wanted * length[:, 0] / length[:, 1])), least, wanted // least)
    second = np.maximum(np.round(wanted / first), least)
    return np.stack([first, second], axis=1).astype(np.int64)


def _fans_of(count: np.ndarray, wanted: int, rule: str) -> Fan:
    """The fans whose number of points is nearest (as a ratio) to the wanted one."""
    parts = np.arange(1, int(np.sqrt(wanted)) + 2)
    if rule == "vertex":
        lattices = 1 + count[:, None] * parts * (3 * parts + 1) // 2
        points = np.column_stack([count, lattices])
        nearest = np.argmin(np.abs(np.log(points / wanted)), axis=1)
        return Fan(np.zeros_like(count), np.maximum(nearest, 1), np.minimum(nearest, 1))
    off = np.abs(np.log(count[:, None, None] * parts[:, None] ** 2 * np.array([1, 3]) / wanted))
    nearest = np.argmin(off.reshape(len(count), -1), axis=1)
    return Fan(np.where(count >= wanted, wanted, 0), parts[nearest // 2], np.array([1, 3])[nearest % 2])
