"""Bars between two points: the force of each along itself, elastic, slack or yielding.

A part of its own, so that a scene without any compiles and calls nothing of this file. To the blocks a bar is one more
contact, behind those of the joints: they move its ends and add up its force as they do of any contact.
"""

from math import sqrt
from typing import NamedTuple

import numpy as np

from masonry.jit.compiled_parts import Call, CompiledPart
from masonry.jit.records import unpack
from masonry.kinematics.shared import FACTOR


class Bars(NamedTuple):
    """K bars. A tension is above 0.

    sides       (K, 2) rows of u of both ends
    apart       (K, 3) m, from the first end to the second one, as at the start
    length      (K,) m, of that
    stiffness   (K,) N/m
    minimum, maximum (K,) N, at which it yields; a bar whose minimum is 0 goes slack there, and stays as long as it is
    slack       (K,) m, by which the ends may part before it bears
    shortening  (K,) m, by which it is tightened while dead loads come on: pretension over stiffness
    first       row of `force` at which those of bars begin
    force       (C + K, 3) N on the first end, behind the forces of the contacts
    What steps change:
    tension     (K,) N
    elongation  (K,) m, of the distance of the ends
    plastic     (K,) m, by which it has become longer
    tightened   (K,) m, so far
    plastic_work, tightening  (K,) J, what yielding took, and what tightening gave
    peak        (K,) N, the largest tension so far, and trough (K,) the least
    """

    sides: np.ndarray
    apart: np.ndarray
    length: np.ndarray
    stiffness: np.ndarray
    minimum: np.ndarray
    maximum: np.ndarray
    slack: np.ndarray
    shortening: np.ndarray
    first: int
    force: np.ndarray
    tension: np.ndarray
    elongation: np.ndarray
    plastic: np.ndarray
    tightened: np.ndarray
    plastic_work: np.ndarray
    tightening: np.ndarray
    peak: np.ndarray
    trough: np.ndarray


def pulling(bars: Bars, turns: bool, u: np.ndarray, shared: np.ndarray) -> Call:
    """The forces of all bars once their ends have moved; turns: whether they turn with these, in large displacement."""
    return _pull.of(*bars, int(turns), u, shared)


@CompiledPart
def _pull(record):
    (
        sides, apart, length, stiffness, minimum, maximum, slack, shortening, first, force, tension, elongation,
        plastic, tightened, plastic_work, tightening, peak, trough, turns, u, shared,
    ) = unpack(record)  # fmt: skip
    once = min(shared[FACTOR], 1.0)
    for k in range(len(length)):
        a, b = sides[k, 0], sides[k, 1]
        x, y, z = apart[k, 0], apart[k, 1], apart[k, 2]
        p, q, r = u[b, 0] - u[a, 0], u[b, 1] - u[a, 1], u[b, 2] - u[a, 2]
        along, now = x * p + y * q + z * r, length[k]
        if turns == 0:
            longer = along / now
        else:
            square = 2.0 * along + p * p + q * q + r * r
            now = sqrt(max(length[k] * length[k] + square, 0.0))
            longer = square / (now + length[k])
            x, y, z = x + p, y + q, z + r
        before, shorter = tension[k], once * shortening[k]
        pull = stiffness[k] * (longer - slack[k] - plastic[k] + shorter)
        bound = min(max(pull, minimum[k]), maximum[k])
        if bound != pull and (bound > 0.0 or minimum[k] < 0.0):
            yielded = (pull - bound) / stiffness[k]
            plastic[k] += yielded
            plastic_work[k] += bound * yielded
        tightening[k] += 0.5 * (before + bound) * (shorter - tightened[k])
        tension[k], elongation[k], tightened[k] = bound, longer, shorter
        peak[k], trough[k] = max(peak[k], bound), min(trough[k], bound)
        over = bound / now if now > 0.0 else 0.0
        force[first + k, 0], force[first + k, 1], force[first + k, 2] = over * x, over * y, over * z
