"""By how much the faces of patches are pressed: where they press, which is not where joints were."""

import numpy as np

from masonry.detection.narrow import FACE
from masonry.jit.compiler import jit
from masonry.patches.arrays import LEVEL, PLACE, Near
from masonry.patches.crushed_points import CLOSING, ROWS
from masonry.simd import FOUR


def patch_compressions(near: Near) -> np.ndarray:
    """(R,) Pa, the largest compression of a point of patches of two faces now, by row of the rules.

    Edges and corners stand on an area that is made up, so their stress tells nothing. What dashpots add is no stress of
    a joint either.
    """
    pairs, points, motion = near.pairs, near.points, near.motion
    pressed = np.zeros(len(near.rules.normal_stiffness))
    _raise_to(
        pressed,
        near.rules.normal_stiffness,
        int(pairs.number[0]),
        (pairs.slot, pairs.points_of, pairs.body, pairs.normal, pairs.slack, pairs.law, pairs.witness),
        (points.number, points.quads, np.zeros((0, 0, ROWS, FOUR)) if points.crushed is None else points.crushed),
        (motion.centre, motion.moved, motion.frame, motion.frame if motion.dual is None else motion.dual),
    )
    return pressed


@jit
def _raise_to(pressed, stiffness, count, pairs, points, motion):
    """Raise pressed (R,) Pa to what points of patches press by. The rest as in Rules, PatchPairs, PatchPoints and
    BlockMotion; where nothing crushes there are no closings, and where blocks are rigid their frames carry normals."""
    slot, points_of, body, normal, slack, law, witness = pairs
    number, quads, crushed = points
    centre, moved, frame, dual = motion
    for p in range(count):
        s, own = slot[p], points_of[p]
        if s < 0 or witness[p, 0] != FACE:
            continue
        ref, other, r = body[p, 1 - own], body[p, own], law[p]
        x, y, z = normal[p, 0], normal[p, 1], normal[p, 2]
        x, y, z = (
            dual[ref, 0, 0] * x + dual[ref, 0, 1] * y + dual[ref, 0, 2] * z,
            dual[ref, 1, 0] * x + dual[ref, 1, 1] * y + dual[ref, 1, 2] * z,
            dual[ref, 2, 0] * x + dual[ref, 2, 1] * y + dual[ref, 2, 2] * z,
        )
        scale = 1.0 / (x * x + y * y + z * z) ** 0.5
        x, y, z = scale * x, scale * y, scale * z
        along = 0.0
        for i, n in enumerate((x, y, z)):
            along += n * ((centre[other, i] - centre[ref, i]) + (moved[other, i] - moved[ref, i]))
        turned = frame[other]
        across = (
            turned[0, 0] * x + turned[1, 0] * y + turned[2, 0] * z,
            turned[0, 1] * x + turned[1, 1] * y + turned[2, 1] * z,
            turned[0, 2] * x + turned[1, 2] * y + turned[2, 2] * z,
        )
        for k in range(number[s]):
            q, lane = k // FOUR, k % FOUR
            gap = along + slack[p] - scale * quads[s, q, LEVEL, lane]
            for i in range(3):
                gap += across[i] * quads[s, q, PLACE + i, lane]
            if len(crushed):
                gap += crushed[s, q, CLOSING, lane]
            pressed[r] = max(pressed[r], -stiffness[r] * gap)
