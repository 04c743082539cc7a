"""Convex polygons of a plane clipped by half planes (Sutherland and Hodgman 1974); every edge keeps its name.

Polygons lie in the rows of u, v (2, K) m and label (2, K): label[k] is the name of the edge from corner k to k + 1.
"""

from math import sqrt

from masonry.detection.bare import bare


@bare
def cut_by(u, v, label, row, count, pu, pv, du, dv, level, name, snap):
    """Keep what lies where (x - p) . d <= level of polygon `row`, d a unit vector; the new edge gets `name`.

    Corners within snap (m) of the line lie on it. Returns the row and the number of corners of what is left.
    """
    beyond, inside = False, False
    for k in range(count):
        height = (u[row, k] - pu) * du + (v[row, k] - pv) * dv - level
        if height > snap:
            beyond = True
        else:
            inside = True
    if not beyond:
        return row, count
    if not inside:
        return row, 0
    other, kept = 1 - row, 0
    last = count - 1
    before = (u[row, last] - pu) * du + (v[row, last] - pv) * dv - level
    if abs(before) <= snap:
        before = 0.0
    for k in range(count):
        here = (u[row, k] - pu) * du + (v[row, k] - pv) * dv - level
        if abs(here) <= snap:
            here = 0.0
        if before * here < 0.0:
            share = before / (before - here)
            u[other, kept] = u[row, last] + share * (u[row, k] - u[row, last])
            v[other, kept] = v[row, last] + share * (v[row, k] - v[row, last])
            label[other, kept] = name if here > 0.0 else label[row, last]
            kept += 1
        if here <= 0.0:
            u[other, kept], v[other, kept] = u[row, k], v[row, k]
            label[other, kept] = label[row, k]
            kept += 1
            if here == 0.0:
                ahead = k + 1 if k + 1 < count else 0
                if (u[row, ahead] - pu) * du + (v[row, ahead] - pv) * dv - level > snap:
                    label[other, kept - 1] = name
        before, last = here, k
    return other, kept


@bare
def clip(u, v, label, count, wu, wv, window, name, snap):
    """What of polygon 0 lies within a convex window (corners wu, wv, clockwise) with edges called name, name + 1, ...

    Returns the row and the number of corners of what is left.
    """
    row = 0
    for k in range(window):
        j = k + 1 if k + 1 < window else 0
        eu, ev = wu[j] - wu[k], wv[j] - wv[k]
        square = eu * eu + ev * ev
        if square == 0.0:
            continue
        share = 1.0 / sqrt(square)
        row, count = cut_by(u, v, label, row, count, wu[k], wv[k], -share * ev, share * eu, 0.0, name + k, snap)
        if count < 3:
            return row, 0
    return row, count


@bare
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
