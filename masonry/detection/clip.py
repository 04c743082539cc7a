"""Convex polygons of a plane clipped by half planes (Sutherland and Hodgman 1974); every edge keeps its name.

Polygons lie in the rows of u, v (2, K) m and label (2, K): label[k] is the name of the edge from corner k to k + 1.
"""

from math import inf

from masonry.jit.compiler import inlined


@inlined
def cut_by(u, v, label, height, row, count, pu, pv, du, dv, level, name, snap):
    """Keep what lies where (x - p) . d <= level of polygon `row`; the new edge gets `name`.

    d may have any length, which level and snap are multiplied by: corners where (x - p) . d is within snap of the level
    lie on the line. height (K,) is scratch. Returns the row and the number of corners of what is left.
    """
    base, maximum, minimum = pu * du + pv * dv + level, -inf, inf
    for k in range(count):
        h = u[row, k] * du + v[row, k] * dv - base
        height[k] = h
        maximum, minimum = max(maximum, h), min(minimum, h)
    if maximum <= snap:
        return row, count
    if minimum > snap:
        return row, 0
    other, number, last = 1 - row, 0, count - 1
    before = height[last]
    if abs(before) <= snap:
        before = 0.0
    for k in range(count):
        here = height[k]
        if abs(here) <= snap:
            here = 0.0
        if before * here < 0.0:
            fraction = before / (before - here)
            u[other, number] = u[row, last] + fraction * (u[row, k] - u[row, last])
            v[other, number] = v[row, last] + fraction * (v[row, k] - v[row, last])
            label[other, number] = name if here > 0.0 else label[row, last]
            number += 1
        if here <= 0.0:
            u[other, number], v[other, number], label[other, number] = u[row, k], v[row, k], label[row, k]
            if here == 0.0 and height[k + 1 if k + 1 < count else 0] > snap:
                label[other, number] = name
            number += 1
        before, last = here, k
    return other, number


@inlined
def clip(u, v, label, height, count, wu, wv, window, name, snap):
    """Part of polygon 0 within a convex window (corners wu, wv, clockwise) with edges called name, name + 1, ...

    Returns the row and the number of corners of what is left.
    """
    row = 0
    for k in range(window):
        j = k + 1 if k + 1 < window else 0
        eu, ev = wu[j] - wu[k], wv[j] - wv[k]
        near = snap * (abs(eu) + abs(ev))
        row, count = cut_by(u, v, label, height, row, count, wu[k], wv[k], -ev, eu, 0.0, name + k, near)
        if count < 3:
            return row, 0
    return row, count


@inlined
def area_and_centroid(u, v, row, count):
    """Area (m2) and centroid of a convex polygon; the first corner where it has no area."""
    u0, v0 = u[row, 0], v[row, 0]
    twice, mu, mv = 0.0, 0.0, 0.0
    for k in range(1, count - 1):
        au, av = u[row, k] - u0, v[row, k] - v0
        bu, bv = u[row, k + 1] - u0, v[row, k + 1] - v0
        part = au * bv - av * bu
        twice += part
        mu += part * (au + bu)
        mv += part * (av + bv)
    if twice <= 0.0:
        return 0.0, u0, v0
    return 0.5 * twice, u0 + mu / (3.0 * twice), v0 + mv / (3.0 * twice)
