"""Points inside a patch besides those at its corners, so that a closed patch is as stiff as a pressure spread over it.

At the corners alone a pressure that varies over a rectangle bends and twists it three times too stiffly. So most of the
area of each corner goes to a point on the line from the centroid to that corner, at a share s of the way:

    a (AT_CORNERS + (1 - AT_CORNERS) s^2) = polar moment of the polygon over that of its corners' areas a

Area, first moment and polar moment are exact; so are the moments about all axes of triangles and parallelograms. What
stays at the corners bears where the patch opens: a block still turns over its edge. In a square that slides about its
normal friction bears 1.007 of its moment, at the corners alone 1.85.
"""

from math import sqrt

from masonry.detection.features import INNER
from masonry.jit.compiler import inner, jit

AT_CORNERS = 0.15
"""Of the area of a corner: what stays there."""


@jit
def spread(point, gap, area, feature, count):
    """Write points inside of a patch behind its `count` corners; returns the number of points, twice as many.

    point, gap, area, feature  (K, 3) m, (K,) m, (K,) m2, (K,), as `touch` gives them, in order round the patch
    """
    whole = x = y = z = depth = 0.0
    for k in range(count):
        whole += area[k]
        x += area[k] * point[k, 0]
        y += area[k] * point[k, 1]
        z += area[k] * point[k, 2]
        depth += area[k] * gap[k]
    if whole <= 0.0:
        return count
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
        return count
    share = moment * whole / (triangles * of_corners)
    inwards = min(sqrt(max(share - AT_CORNERS, 0.0) / (1.0 - AT_CORNERS)), 1.0)
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


@inner
def layers(feature, count):
    """In how many rounds the points of a patch lie: 2 where it is spread."""
    return 2 if count > 0 and INNER <= feature[count - 1] < 2 * INNER else 1
