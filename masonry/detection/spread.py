"""Points inside a patch besides those at its corners, so that a closed patch is as stiff as a pressure spread over it.

At the corners alone a pressure that varies over a rectangle bends and twists it three times too stiffly. So most of the
area of each corner goes to a point on the line from the centroid to that corner, at a share s of the way:

    a (AT_CORNERS + (1 - AT_CORNERS) s^2) = polar moment of the polygon over that of its corners' areas a

Area, first moment and polar moment are exact; so are the moments about all axes of triangles and parallelograms. What
stays at the corners bears where the patch opens: a block still turns over its edge. In a square that slides about its
normal friction bears 1.007 of its moment, at the corners alone 1.85.

Where an edge crushes, the moment follows how the pressure ends along the patch, and there are more points on each of
these lines, in rounds: those of Gauss and Lobatto, which a rectangle then has along each of its edges. The outermost
ones lie at the corners.
"""

from math import sqrt

import numpy as np

from masonry.detection.features import INNER, LONE
from masonry.jit.compiler import inner, jit

AT_CORNERS = 0.15
"""Of the area of a corner: what stays there."""


def rounds_of(along: int) -> np.ndarray:
    """(m, 2) of 2 m points along an edge, from the corner inwards: share of the way from the centroid to the corner,
    and of the corner's area. m = 1: corners alone.

    Abramowitz and Stegun 25.4.32: exact to the power 2 along - 3.
    """
    legendre = np.polynomial.Legendre.basis(along - 1)
    inside = np.sort(legendre.deriv().roots().real)[::-1][: along // 2 - 1]
    place = np.concatenate([[1.0], inside])
    return np.column_stack([place, 2.0 / (along * (along - 1) * legendre(place) ** 2)])


@jit
def spread(point, gap, area, feature, count):
    """Write points inside of a patch behind its `count` corners; returns the number of points, twice as many.

    point, gap, area, feature  (K, 3) m, (K,) m, (K,) m2, (K,), as `touch` gives them, in order round the patch
    """
    x, y, z, depth, fraction = middle_of(point, gap, area, count)
    if fraction <= 0.0:
        return count
    inwards = min(sqrt(max(fraction - AT_CORNERS, 0.0) / (1.0 - AT_CORNERS)), 1.0)
    for k in range(count):
        other = count + k
        point[other, 0] = x + inwards * (point[k, 0] - x)
        point[other, 1] = y + inwards * (point[k, 1] - y)
        point[other, 2] = z + inwards * (point[k, 2] - z)
        gap[other] = depth + inwards * (gap[k] - depth)
        area[other] = (1.0 - AT_CORNERS) * area[k]
        area[k] *= AT_CORNERS
        feature[other] = INNER + feature[k]
    return 2 * count


@jit
def spread_in_rounds(point, gap, area, feature, count, rounds):
    """`spread` in the rounds (m, 2) of rounds_of; returns the number of points, m for each corner."""
    x, y, z, depth, fraction = middle_of(point, gap, area, count)
    if fraction <= 0.0:
        return count
    inside = 0.0
    for r in range(1, len(rounds)):
        inside += rounds[r, 1] * rounds[r, 0] * rounds[r, 0]
    narrower = min(sqrt(max(fraction - rounds[0, 1], 0.0) / inside), 1.0 / rounds[1, 0])
    for r in range(1, len(rounds)):
        inwards = narrower * rounds[r, 0]
        for k in range(count):
            other = r * count + k
            point[other, 0] = x + inwards * (point[k, 0] - x)
            point[other, 1] = y + inwards * (point[k, 1] - y)
            point[other, 2] = z + inwards * (point[k, 2] - z)
            gap[other] = depth + inwards * (gap[k] - depth)
            area[other] = rounds[r, 1] * area[k]
            feature[other] = r * INNER + feature[k]
    for k in range(count):
        area[k] *= rounds[0, 1]
    return len(rounds) * count


@inner
def middle_of(point, gap, area, count):
    """Centroid (m, x, y, z) of a patch with points at its corners, its gap there (m), and its polar moment over that of
    the areas of its corners, 0 where it has no area."""
    whole = x = y = z = depth = 0.0
    for k in range(count):
        whole += area[k]
        x += area[k] * point[k, 0]
        y += area[k] * point[k, 1]
        z += area[k] * point[k, 2]
        depth += area[k] * gap[k]
    if whole <= 0.0:
        return x, y, z, depth, 0.0
    x, y, z, depth = x / whole, y / whole, z / whole, depth / whole
    triangles = moment = of_corners = 0.0
    for k in range(count):
        j = k + 1 if k + 1 < count else 0
        ax, ay, az = point[k, 0] - x, point[k, 1] - y, point[k, 2] - z
        bx, by, bz = point[j, 0] - x, point[j, 1] - y, point[j, 2] - z
        cx, cy, cz = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
        triangle = 0.5 * sqrt(cx * cx + cy * cy + cz * cz)
        square = ax * ax + ay * ay + az * az
        triangles += triangle
        moment += triangle * (square + ax * bx + ay * by + az * bz + bx * bx + by * by + bz * bz) / 6.0
        of_corners += area[k] * square
    if triangles <= 0.0 or of_corners <= 0.0:
        return x, y, z, depth, 0.0
    return x, y, z, depth, moment * whole / (triangles * of_corners)


@inner
def layers(feature, count):
    """In how many rounds the points of a patch lie: 1 where it is not spread."""
    last = feature[count - 1] if count > 0 else 0
    return 1 + last // INNER if last < LONE else 1
