"""Joints of limited compressive strength: what normal forces at the corners of a polygon can a plastic stress carry?

A uniform stress fc on a part of the polygon, of which the resultant N is the centre. With D_e = sum N_k d_e(x_k) /
d_e(c), where d_e is the distance from edge e, x_k a corner and c the centroid, N is off each edge by D_e / N of what
the centroid does. In a parallelogram a smaller one of the same directions, with the resultant as its centre, reaches as
far as the nearer edge of each pair: N <= fc A (D_i / N) (D_j / N) for neighbouring edges i and j. In other polygons the
polygon itself made smaller about the resultant fits: N <= fc A (D_e / N)^2 for each edge. Both are states that the
joint can bear, so the factor is too small at most. For bending about one axis of a rectangle the first one is exact:
M = N t/2 (1 - N / (fc A)).
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy import sparse

from geometry.blocks import Joints
from geometry.polyhedra.polygons import areas_normals_centroids, pad, widen

SAME = 1e-9


@dataclass(frozen=True)
class Crushing:
    """N^3 <= P D_i D_j for M pairs of edges: rows (M, C) from normal forces to N, D_i and D_j, and P = fc A (M,) N."""

    total: sparse.csr_array
    first: sparse.csr_array
    second: sparse.csr_array
    strength: np.ndarray

    def times(self, by: float) -> "Crushing":
        """Of a strength multiplied by a number."""
        return replace(self, strength=by * self.strength)

    def merged(self, fractions: sparse.csr_array) -> "Crushing":
        """For other points, whose normal forces fractions (C, n) hand out to those here."""
        total, first, second = ((rows @ fractions).tocsr() for rows in (self.total, self.first, self.second))
        return Crushing(total, first, second, self.strength)


def crushing_of(joints: Joints, strength: float, limited: np.ndarray) -> Crushing:
    """Of joints with a compressive strength (Pa), as far as their points (C,) are limited, which lie at the corners."""
    corners, count = pad(joints.patch_points, joints.patch_start, np.arange(len(joints.patch_points)))
    area, normal, centroid = areas_normals_centroids(corners)
    corners = widen(corners, 4)
    gap = corners[:, 0] - corners[:, 1] + corners[:, 2] - corners[:, 3]
    even = (count == 4) & (np.linalg.norm(gap, axis=1) <= SAME * np.sqrt(area))
    part = np.flatnonzero(np.bincount(joints.patch, limited, len(area)) > 0)
    patch = np.repeat(part, count[part])
    edge = np.concatenate([np.arange(n) for n in count[part]]) if len(part) else np.zeros(0, dtype=np.int64)
    after = (edge + 1) % count[patch]
    other = np.where(even[patch], after, edge)
    first, second = (_distances(joints, corners, count, normal, centroid, patch, e) for e in (edge, other))
    member = sparse.csr_array(
        (np.ones(len(joints.patch)), (joints.patch, np.arange(len(joints.patch)))), shape=(len(area), len(joints.patch))
    )
    return Crushing(member[patch], first, second, strength * area[patch])


def _distances(
    joints: Joints, corners: np.ndarray, count: np.ndarray, normal: np.ndarray, centroid: np.ndarray,
    patch: np.ndarray, edge: np.ndarray,
) -> sparse.csr_array:  # fmt: skip
    """(M, C) how far each point of a polygon is from an edge, over how far the centroid is."""
    start = corners[patch, edge]
    inward = np.cross(normal[patch], corners[patch, (edge + 1) % count[patch]] - start)
    order = np.argsort(joints.patch, kind="stable")
    begin = np.searchsorted(joints.patch[order], np.arange(len(count) + 1))
    number = np.diff(begin)[patch]
    row = np.repeat(np.arange(len(patch)), number)
    place = np.arange(len(row)) - np.repeat(np.cumsum(number) - number, number)
    column = order[begin[patch][row] + place]
    away = np.einsum("ni,ni->n", joints.point[column] - start[row], inward[row])
    middle = np.einsum("ni,ni->n", centroid[patch] - start, inward)
    return sparse.csr_array((away / middle[row], (row, column)), shape=(len(patch), len(joints.patch)))


def crushing_cones(
    crush: Crushing, force: np.ndarray, unknowns: int
) -> list[tuple[sparse.csc_array, np.ndarray, list[Any]]]:
    """Rows, sides and cones of Clarabel: second-order ones where one of the two factors is N, else power cones.

    force  (C,) N, unit of each normal force, one for all points of a polygon
    """
    import clarabel

    strength = crush.strength / force[crush.total.indices[crush.total.indptr[:-1]]]
    alike = [_same_rows(rows, crush.total) for rows in (crush.first, crush.second)]
    whole, cones = alike[0] & alike[1], []
    square = np.flatnonzero((alike[0] | alike[1]) & ~whole)
    if len(square):
        total, pressed = crush.total[square], np.where(alike[0][square], 1.0, 0.0)[:, None]
        away = (crush.first[square].multiply(1 - pressed) + crush.second[square].multiply(pressed)).tocsr()
        rows, side = _interleaved(
            [-away, away, -2.0 * total], [strength[square], strength[square], 0 * square], unknowns
        )
        cones.append((rows, side, [clarabel.SecondOrderConeT(3)] * len(square)))
    if whole.any():
        which = np.flatnonzero(whole)
        rows, side = _interleaved([crush.total[which]], [strength[which]], unknowns)
        cones.append((rows, side, [clarabel.NonnegativeConeT(len(which))]))
    twice = ~(alike[0] | alike[1]) & _same_rows(crush.first, crush.second)
    if len(which := np.flatnonzero(twice)):
        parts = [-crush.first[which], 0.0 * crush.total[which], -crush.total[which]]
        rows, side = _interleaved(parts, [0.0 * which, strength[which], 0.0 * which], unknowns)
        cones.append((rows, side, [clarabel.PowerConeT(2 / 3)] * len(which)))
    if len(which := np.flatnonzero(~(alike[0] | alike[1] | twice))):
        parts = [0.0 * crush.total[which], -crush.first[which], -crush.second[which], -crush.total[which]]
        rows, side = _interleaved(parts, [strength[which], *3 * [0.0 * which]], unknowns)
        cones.append((rows, side, [clarabel.GenPowerConeT([1 / 3, 1 / 3, 1 / 3], 1)] * len(which)))
    return cones


def _same_rows(first: sparse.csr_array, second: sparse.csr_array) -> np.ndarray:
    """(M,) whether rows of two matrices agree."""
    return np.asarray(abs(first - second).max(axis=1).toarray()).ravel() <= SAME


def _interleaved(
    parts: list[sparse.csr_array], sides: list[np.ndarray], unknowns: int
) -> tuple[sparse.csc_array, np.ndarray]:
    """The first rows of all parts, then the second ones, ...; with columns for all unknowns."""
    number, many = parts[0].shape[0], len(parts)
    rows = sparse.vstack(parts, format="csr")[np.arange(number * many).reshape(many, number).T.ravel()]
    rest = sparse.csr_array((number * many, unknowns - rows.shape[1]))
    return sparse.hstack([rows, rest], format="csc"), np.stack(sides, axis=1).ravel().astype(float)
