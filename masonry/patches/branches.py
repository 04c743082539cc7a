"""Dashpots in closed contacts: branches beside their springs, whose stress fades.

A branch bears m <- keep m + gain k e over a step in which the sides of a contact move by e (m) against each other, with
k (Pa/m) the stiffness of the spring beside it. So e over the step is the velocity of leapfrog, half a step old.
- Dashpot of Kelvin, a1 k times that velocity: keep = 0, gain = a1 / dt.
- Maxwell's spring r k and dashpot behind each other, of relaxation time T: keep = exp(-dt / T), gain = r T (1 - keep) /
  dt, exact where the velocity stays during the step.
An open contact bears nothing and forgets all; one that slides bears nothing in shear. No contact is pulled by more than
`room`: 0 in all where there is no strength.
"""

from math import inf
from typing import Any, NamedTuple

import numpy as np

from masonry.jit.compiler import inlined
from masonry.jit.extending import register_jitable
from masonry.simd import FOUR, filled, four, minimum, put, put_where, take, where
from masonry.simd.rows import aligned

STUCK = 1.0 - 1e-9
"""Of the square of the shear strength: a point that bears less does not slide."""


class Dashpots(NamedTuple):
    """Dashpots of C contacts in J branches; all of it None without any.

    keep, gain  (J,) share of the stress that a step leaves, and 1/m, of the spring's stiffness that a motion adds
    before      (C, 3) m, of side b against side a at the last step
    stress      (C, 3 J) Pa, of side b on side a: x, y, z of each branch
    taken       (C,) J/m2, work that they took
    """

    keep: Any = None
    gain: Any = None
    before: Any = None
    stress: Any = None
    taken: Any = None


NO_DASHPOTS = Dashpots()


def dashpots_of(keep: np.ndarray, gain: np.ndarray, contacts: int) -> Dashpots:
    """Dashpots (J,) that have borne nothing yet."""
    before, stress = (aligned(np.zeros((contacts, columns))) for columns in (3, 3 * len(keep)))
    return Dashpots(keep, gain, before, stress, aligned(np.zeros(contacts)))


@register_jitable
def stiffness_now(kn, sigma, opening):
    """Pa/m of the spring of a contact: what it is in compression, its secant in tension, 0 where it is open."""
    pulled = where(sigma > 0.0, minimum(sigma / opening, kn), 0.0)
    return where((sigma < 0.0) | (opening <= 0.0), kn, pulled)


@register_jitable
def pull_left(tensile_strength, intact, sigma):
    """Pa, by how much more than sigma a contact may be pulled: up to the strength that is left; without end where
    nothing tears, and by nothing where there is no strength."""
    if tensile_strength is None:
        return filled(inf, sigma)
    return tensile_strength * intact - sigma


@register_jitable
def faded(keep, gain, m, n, along, e, kn, ks, room):
    """Stress (Pa, x, y, z) of a branch that bore m, after a motion e (m) with the part `along` the normal n; kn, ks
    (Pa/m) of the spring now, 0 where it bears nothing; and its part along n."""
    was = m[0] * n[0] + m[1] * n[1] + m[2] * n[2]
    normal = where(kn > 0.0, minimum(keep * was + gain * kn * along, room), 0.0)
    stays, stiff = where(ks > 0.0, keep, 0.0), gain * ks
    rise = normal - stays * was - stiff * along
    return (
        stays * m[0] + stiff * e[0] + rise * n[0],
        stays * m[1] + stiff * e[1] + rise * n[1],
        stays * m[2] + stiff * e[2] + rise * n[2],
    ), normal


@inlined
def of_bond(lanes, keep, gain, before, stress, c, parted, n, kn, ks, room):
    """Stress of the dashpots of the contacts from c on, (3) Pa on side a, and the energy that they took (J/m2).

    lanes  which of them there are    parted  (3) m, of side b against side a    kn, ks, room  as of `faded`
    """
    e = (
        parted[0] - take(before, (c, 0), kn),
        parted[1] - take(before, (c, 1), kn),
        parted[2] - take(before, (c, 2), kn),
    )
    along = e[0] * n[0] + e[1] * n[1] + e[2] * n[2]
    x = y = z = was_x = was_y = was_z = filled(0.0, along)
    for j in range(len(keep)):
        at = 3 * j
        m = take(stress, (c, at), kn), take(stress, (c, at + 1), kn), take(stress, (c, at + 2), kn)
        was_x, was_y, was_z = was_x + m[0], was_y + m[1], was_z + m[2]
        m, normal = faded(keep[j], gain[j], m, n, along, e, kn, ks, room)
        room = room - normal
        put_vector(lanes, stress, c, at, m)
        x, y, z = x + m[0], y + m[1], z + m[2]
    put_vector(lanes, before, c, 0, parted)
    return (x, y, z), 0.5 * ((x + was_x) * e[0] + (y + was_y) * e[1] + (z + was_z) * e[2])


@inlined
def put_vector(lanes, array, c, column, vector):
    """Write three columns of the contacts from c on."""
    put_where(lanes, array, (c, column), vector[0])
    put_where(lanes, array, (c, column + 1), vector[1])
    put_where(lanes, array, (c, column + 2), vector[2])


@inlined
def beside(branches, keep, gain, s, k, joint, dt, touches, t, shear_limit, sigma, d, along, n, rotation):
    """Stress of the dashpots of four points of a patch, (3) Pa, and the energy that they took (J/m2).

    t, shear_limit  Pa, shear of the springs and the most that they bear; sigma  Pa, the normal stress
    d, along  m/s, of the other block against the reference, and its part along n; rotation  rad, of both in this step
    """
    x = y = z = before_x = before_y = before_z = filled(0.0, four())
    kn = where(touches, filled(joint[0], four()), 0.0)
    sticks = touches & (t[0] * t[0] + t[1] * t[1] + t[2] * t[2] < STUCK * shear_limit * shear_limit)
    ks, room = where(sticks, filled(joint[1], four()), 0.0), -sigma
    e, along = (dt * d[0], dt * d[1], dt * d[2]), dt * along
    for j in range(len(keep)):
        at = s, k // FOUR
        mx = take(branches, (*at, 3 * j, 0), four())
        my = take(branches, (*at, 3 * j + 1, 0), four())
        mz = take(branches, (*at, 3 * j + 2, 0), four())
        before_x, before_y, before_z = before_x + mx, before_y + my, before_z + mz
        m = (
            mx + rotation[1] * mz - rotation[2] * my,
            my + rotation[2] * mx - rotation[0] * mz,
            mz + rotation[0] * my - rotation[1] * mx,
        )
        (mx, my, mz), normal = faded(keep[j], gain[j], m, n, along, e, kn, ks, room)
        room = room - normal
        put(branches, (*at, 3 * j, 0), mx)
        put(branches, (*at, 3 * j + 1, 0), my)
        put(branches, (*at, 3 * j + 2, 0), mz)
        x, y, z = x + mx, y + my, z + mz
    work = 0.5 * ((x + before_x) * e[0] + (y + before_y) * e[1] + (z + before_z) * e[2])
    return (x, y, z), work


@inlined
def forget(branches, s, k):
    """The dashpots of point k of slot s bear nothing."""
    if branches is not None:
        for row in range(branches.shape[2]):
            branches[s, k // FOUR, row, k % FOUR] = 0.0


@inlined
def with_branches(branches, s, k, shear):
    """A stress (3) Pa and what the dashpots of point k of slot s bear besides."""
    if branches is None:
        return shear
    x, y, z = shear
    for row in range(0, branches.shape[2], 3):
        x += branches[s, k // FOUR, row, k % FOUR]
        y += branches[s, k // FOUR, row + 1, k % FOUR]
        z += branches[s, k // FOUR, row + 2, k % FOUR]
    return x, y, z
