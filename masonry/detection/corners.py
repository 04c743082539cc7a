"""The corners of an overlap polygon as contact points: the area that each stands for.

The two triangles between the centroid c and the edges at a corner give it half of their area each: a_k = (t_(k-1) +
t_k)/2. That reproduces area A and centroid of any convex polygon, and no a_k is below 0: triangle t_k = (c, x_k,
x_(k+1)) has its centroid at (c + x_k + x_(k+1))/3, so that sum t_k (x_k + x_(k+1))/2 = (3 A c - A c)/2 = A c.
"""

from masonry.detection.clip import area_and_centroid, clip
from masonry.jit.compiler import inlined, inner

MERGED = 1e-4
"""Of the root of the area: corners that are nearer to each other become one, at their middle weighted by area."""


@inlined
def weigh(u, v, row, count, cu, cv, weight):
    """Areas (m2) of the corners of a polygon with centroid c into weight; they add up to its area."""
    last = count - 1
    before = (u[row, last] - cu) * (v[row, 0] - cv) - (v[row, last] - cv) * (u[row, 0] - cu)
    for k in range(count):
        j = k + 1 if k + 1 < count else 0
        after = (u[row, k] - cu) * (v[row, j] - cv) - (v[row, k] - cv) * (u[row, j] - cu)
        weight[k] = 0.25 * (max(before, 0.0) + max(after, 0.0))
        before = after


@inner
def merge(u, v, name, row, count, weight, near):
    """Corners of a polygon within `near` (m) of each other made one; area and first moment stay. Returns their number.

    u, v, weight and the names (count,) are written over; the least name stays.
    """
    first, close = -1, False
    for k in range(count):
        j = k - 1 if k > 0 else count - 1
        du, dv = u[row, k] - u[row, j], v[row, k] - v[row, j]
        if du * du + dv * dv <= near * near:
            close = True
        elif first < 0:
            first = k
    if not close:
        return count
    if first < 0:
        return _one(u, v, name, row, 0, count, weight, 0)
    other, number, begun = 1 - row, 0, 0
    for k in range(count):  # round from `first`, into the other row
        i = (first + k) % count
        u[other, k], v[other, k] = u[row, i], v[row, i]
    _rotate(name, first, count)
    _rotate(weight, first, count)
    for k in range(1, count + 1):
        if k < count:
            du, dv = u[other, k] - u[other, begun], v[other, k] - v[other, begun]
        if k == count or du * du + dv * dv > near * near:
            _one(u, v, name, other, begun, k, weight, number)
            u[row, number], v[row, number] = u[other, number], v[other, number]
            number, begun = number + 1, k
    return number


@inner
def _rotate(values, first, count):
    """The first `count` values begin with number `first`: reversed thrice."""
    _reverse(values, 0, first)
    _reverse(values, first, count)
    _reverse(values, 0, count)


@inner
def _reverse(values, a, b):
    while b - a > 1:
        b -= 1
        values[a], values[b] = values[b], values[a]
        a += 1


@inner
def _one(u, v, name, row, begin, end, weight, place):
    """Corners begin..end put together at `place` <= begin; returns 1."""
    total, mu, mv, lowest_name = 0.0, 0.0, 0.0, name[begin]
    for k in range(begin, end):
        total += weight[k]
        mu += weight[k] * (u[row, k] - u[row, begin])
        mv += weight[k] * (v[row, k] - v[row, begin])
        lowest_name = min(lowest_name, name[k])
    u0, v0 = u[row, begin], v[row, begin]
    u[row, place] = u0 + mu / total if total > 0.0 else u0
    v[row, place] = v0 + mv / total if total > 0.0 else v0
    weight[place], name[place] = total, lowest_name
    return 1


@inner
def region(eu, ev, row, count, cu, cv, k):
    """Region that corner k of a patch stands for, counter-clockwise: corner, middle of the edge after it, centroid,
    middle of the edge before it. It is convex, as patches are. They are rows of eu, ev."""
    after, before = (k + 1 if k + 1 < count else 0), (k - 1 if k > 0 else count - 1)
    ku, kv = eu[row, k], ev[row, k]
    au, av = 0.5 * (ku + eu[row, after]), 0.5 * (kv + ev[row, after])
    bu, bv = 0.5 * (ku + eu[row, before]), 0.5 * (kv + ev[row, before])
    return ku, kv, au, av, cu, cv, bu, bv


@inner
def region_area(q):
    """m2; 0 where it is turned inside out."""
    return max(0.5 * ((q[4] - q[0]) * (q[7] - q[3]) - (q[5] - q[1]) * (q[6] - q[2])), 0.0)


@inner
def shared_area(a, b, u, v, label, height, wu, wv):
    """Area (m2) that a region of the old patch shares with one of the new patch."""
    if (
        max(a[0], a[2], a[4], a[6]) <= min(b[0], b[2], b[4], b[6])
        or max(b[0], b[2], b[4], b[6]) <= min(a[0], a[2], a[4], a[6])
        or max(a[1], a[3], a[5], a[7]) <= min(b[1], b[3], b[5], b[7])
        or max(b[1], b[3], b[5], b[7]) <= min(a[1], a[3], a[5], a[7])
    ):
        return 0.0
    u[0, 0], v[0, 0], u[0, 1], v[0, 1], u[0, 2], v[0, 2], u[0, 3], v[0, 3] = a
    wu[0], wv[0], wu[3], wv[3], wu[2], wv[2], wu[1], wv[1] = b
    row, count = clip(u, v, label, height, 4, wu, wv, 4, 0, 0.0)
    return area_and_centroid(u, v, row, count)[0] if count >= 3 else 0.0
