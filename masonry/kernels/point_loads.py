"""Forces at points of rigid blocks that turn: how their moments change as blocks move, in large displacement.

A part of its own, so that a scene without any compiles and calls nothing of this file.
"""

from typing import Any, NamedTuple

import numpy as np

from masonry.jit.compiled_parts import Call, CompiledPart
from masonry.jit.records import unpack
from masonry.kinematics.shared import FACTOR


class PointLoads(NamedTuple):
    """Forces at points. The moments about the centroids as at the start are part of the loads of the blocks.

    row     (K,) of the block
    arm     (K, 3) m, from its centroid to the point, as at the start
    fixed   (K,) 1 where the line of action stays where it is in space, 0 where the point is one of the block's
    load    (K, 3) N, at a factor of the dead loads of 1
    change  (K, 3) N, what the force grows by as that factor grows from 1 to 2: see motion.dead_load
    """

    row: np.ndarray
    arm: np.ndarray
    fixed: np.ndarray
    load: np.ndarray
    change: np.ndarray


def shifting(points: PointLoads, body: Any, shared: np.ndarray) -> Call:
    """What the points do to the moments on their blocks, once these have moved."""
    return _shift.of(*points, body.q, body.frame, body.shifted, shared)


@CompiledPart
def _shift(record):
    """Moments of this step, M = (arm now - arm at the start) x F, behind which those of the step before are kept."""
    row, arm, fixed, load, change, q, frame, shifted, shared = unpack(record)
    once, excess = min(shared[FACTOR], 1.0), max(shared[FACTOR] - 1.0, 0.0)
    for k in range(len(row)):
        for i in range(3):
            shifted[row[k], 3 + i] = shifted[row[k], i]
    for k in range(len(row)):
        for i in range(3):
            shifted[row[k], i] = 0.0
    for k in range(len(row)):
        b = row[k]
        if fixed[k]:
            x, y, z = -q[b, 0], -q[b, 1], -q[b, 2]
        else:
            x = (frame[b, 0, 0] - 1.0) * arm[k, 0] + frame[b, 0, 1] * arm[k, 1] + frame[b, 0, 2] * arm[k, 2]
            y = frame[b, 1, 0] * arm[k, 0] + (frame[b, 1, 1] - 1.0) * arm[k, 1] + frame[b, 1, 2] * arm[k, 2]
            z = frame[b, 2, 0] * arm[k, 0] + frame[b, 2, 1] * arm[k, 1] + (frame[b, 2, 2] - 1.0) * arm[k, 2]
        fx = once * load[k, 0] + excess * change[k, 0]
        fy = once * load[k, 1] + excess * change[k, 1]
        fz = once * load[k, 2] + excess * change[k, 2]
        shifted[b, 0] += y * fz - z * fy
        shifted[b, 1] += z * fx - x * fz
        shifted[b, 2] += x * fy - y * fx
