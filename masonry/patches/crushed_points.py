"""Crushing of the points of patches: they press by k_n (gap + plastic closing), and close on where that exceeds the
strength that is left, by the equations of bonds (laws/compression_cap.py). Nothing heals; crushed_faces.py keeps it."""

from math import inf, sqrt

from masonry.detection.narrow import FACE
from masonry.jit.compiler import inlined, inner
from masonry.laws.compression_cap import is_within, return_to_cap, strength_left
from masonry.laws.state import ContactHistory, JointProperties
from masonry.simd import FOUR, any_lane, filled, four, minimum, put, take, unless, where

CLOSING, HARDENING, KEPT, CELL, ROWS = 0, 1, 2, 4, 6
"""Rows of PatchPoints.crushed: m, m; the same as the faces know them; the cells of both faces in which a point lies."""


@inner
def crushed_of(crushed, s, k, row):
    """A number of point k of slot s."""
    return crushed[s, k // FOUR, row, k % FOUR]


@inner
def put_crushed_of(crushed, s, k, row, value):
    """Write a number of point k of slot s."""
    crushed[s, k // FOUR, row, k % FOUR] = value


@inner
def with_closing(crushed, s, k, gap):
    """A gap (m) and the plastic closing of point k of slot s."""
    if crushed is None:
        return gap
    return gap + crushed_of(crushed, s, k, CLOSING)


@inlined
def four_with_closing(crushed, s, k, gap):
    """The same of four points, from point k on."""
    if crushed is None:
        return gap
    return gap + take(crushed, (s, k // FOUR, CLOSING, 0), four())


@inlined
def with_crushing(crushed, number, more):
    """The sum where anything crushes; else the number."""
    if crushed is None:
        return number
    return number + more


@inlined
def least(crushed, shear_limit, limit):
    """The most shear (Pa) that points bear, no more than a limit where anything crushes."""
    if crushed is None:
        return shear_limit
    return minimum(shear_limit, limit)


@inner
def row_that_crushes(crushed, pairs, p):
    """The row of rules of a patch of two faces; -1 of edges and corners, or where nothing crushes."""
    if crushed is None:
        return -1
    return pairs.law[p] if pairs.witness[p, 0] == FACE else -1


@inlined
def crush(crushed, cap, cut_off, row, s, k, joint, touches, gap, rate, shear, before, d, along, n, dt):
    """Four points close on where they press by more than what is left of their strength. Returns by how much (m), the
    most shear that they bear then (Pa), and what crushing took, by closing and by slip (J/m2).

    cap, cut_off, row  of Rules, or None; the row of the patch, -1 where it cannot crush     joint  as `joint_of`
    touches    which of the points press
    gap, rate  m, with the closing so far, and its rate (m/s)
    shear, before   Pa, x, y, z, and Pa2, of the last step
    d, along   m/s, of the other block against the reference, and its part along the normal n
    """
    if crushed is None:
        nothing = filled(0.0, gap)
        return nothing, nothing, nothing, nothing
    now, was = where(touches, gap, 0.0), where(touches, minimum(gap - dt * rate, 0.0), 0.0)
    stiff = dt * joint[1]
    x, y, z = (
        shear[0] + stiff * (d[0] - along * n[0]),
        shear[1] + stiff * (d[1] - along * n[1]),
        shear[2] + stiff * (d[2] - along * n[2]),
    )
    tau = where(touches, sqrt(x * x + y * y + z * z), 0.0)
    return squeeze(crushed, cap, cut_off, row, s, k, joint, now, was, tau, where(touches, sqrt(before), 0.0))


@inner
def squeeze(crushed, cap, cut_off, row, s, k, joint, e, was, tau, sheared):
    """The same from the gap now and a step before (m), 0 of points that do not press; from the shear stress if it were
    elastic, and that of the step before (Pa)."""
    if row >= 0:
        kn, ks, tan, c = joint[0], joint[1], joint[2], number_or_zero(joint[3])
        if cap is not None and cap[row, 0] > 0.0:
            fm, energy, peak, factor = cap[row, 0], cap[row, 1], cap[row, 2], cap[row, 3]
            by = JointProperties(kn, ks, 0.0, c, tan, c, tan, None, None, None, None, None, fm, energy, peak, factor)
            return crush_by(by, crushed, s, k, e, was, tau, sheared)
        if cut_off is not None and cut_off[row, 0] > 0.0:
            fm, energy = cut_off[row, 0], cut_off[row, 1]
            by = JointProperties(kn, ks, 0.0, c, tan, c, tan, None, None, None, None, None, fm, energy, None, None)
            return crush_by(by, crushed, s, k, e, was, tau, sheared)
    nothing = filled(0.0, four())
    return nothing, filled(inf, four()), nothing, nothing


@inlined
def number_or_zero(number):
    """0 in place of None."""
    if number is None:
        return 0.0
    return number


@inner
def crush_by(joint, crushed, s, k, e, was, tau, sheared):
    """The same by properties of a joint of which nothing but friction and residual cohesion is left."""
    closing = take(crushed, (s, k // FOUR, CLOSING, 0), four())
    hardening = take(crushed, (s, k // FOUR, HARDENING, 0), four())
    ones, nothing, kn = filled(1.0, four()), filled(0.0, four()), joint.normal_stiffness
    sigma, sigma_was = kn * e, kn * was
    bears = strength_left(joint, hardening)
    if not any_lane(unless(ones > 0.0, is_within(joint, bears, sigma, tau * tau))):
        return nothing, filled(inf, four()), nothing, nothing
    history = ContactHistory(ones, ones, nothing, nothing, None, None, None)
    after = return_to_cap(joint, history, closing, hardening, bears, e, sigma, tau, (sigma_was, sheared))
    crushes = after.hardening > hardening
    if not any_lane(crushes):
        return nothing, filled(inf, four()), nothing, nothing
    put(crushed, (s, k // FOUR, CLOSING, 0), after.closing)
    put(crushed, (s, k // FOUR, HARDENING, 0), after.hardening)
    closed = after.closing - closing
    by_closing = -0.5 * closed * (sigma_was + kn * minimum(e + closed, 0.0))
    return closed, where(crushes, after.tau, inf), by_closing, where(crushes, after.work - by_closing, 0.0)
