"""When contacts are looked for again: which pairs are near, and which of them a step may change.

A block's travel bounds how far any of its points has moved. A pair is looked at again when the travel of its two blocks
exceeds a limit: 1 % of the patch, or what keeps them apart; unless they moved together. All pairs are found anew when
the two largest travels since the last search exceed the skin, which is as wide as two blocks travel in a step. Where
nothing is near its limit, as in a wall that stands, no pair is asked for many steps.
"""

from math import sqrt

import numpy as np

from masonry.detection.narrow import FACE
from masonry.jit.compiled_parts import Call, CompiledPart
from masonry.jit.compiler import inlined, inner, jit
from masonry.jit.records import unpack
from masonry.kinematics.matrices import dot, vector_at
from masonry.kinematics.shared import SHARED, SPARE, TRAVEL
from masonry.patches.arrays import Near
from masonry.patches.pair_search import find_pairs, searching_for
from masonry.patches.redetection import look, looking_at
from masonry.patches.relative_motion import stays
from masonry.patches.slack import settle
from masonry.simd import EIGHT, eight, eight_rows, filled, maximum, total

ALMOST = 0.999
"""Of the travel that is left: sums of many steps are rounded."""


def refresh(near: Near, step: float = 0.0) -> float:
    """Look at all pairs that the travel so far may have changed; step (m): what two blocks travel at most in this step.

    Returns how far (m) any two blocks may travel, together, until that is to be asked again; below 0 where the step
    cannot be taken.
    """
    shared = np.zeros(SHARED)
    shared[TRAVEL] = step
    looking(near, shared)()
    return float(shared[SPARE])


def looking(near: Near, shared: np.ndarray) -> Call:
    """The call of what `refresh` does, with the travel of this step in `shared`; leaves there what it returns."""
    return _refresh.of(near, *searching_for(near), *looking_at(near), shared)


@CompiledPart
def _refresh(record):
    near, find, answer, look_at, touch, shared = unpack(record)
    shared[SPARE] = spare_after(near, (find, answer), (look_at, touch), shared[TRAVEL])


@inner
def spare_after(near, searching, looking, step):
    """Answer of `refresh`; `searching` and `looking` as of pair_search.py and redetection.py."""
    search, pairs, travel = near.search, near.pairs, near.motion.travel
    widened, search.listed[0] = widen(search, step), False
    spare, looked = search.skin[0] - farthest(travel, search.built), False
    if widened or spare < 0.0:
        if not find_pairs(searching):
            return -1.0
        spare = search.skin[0]
    body, mark, limit = pairs.body, pairs.mark, pairs.limit
    for p in range(pairs.number[0]):
        moved = travel[body[p, 0]] + travel[body[p, 1]] - mark[p]
        if moved > limit[p] and not stays(near, p):
            looked = True
            if not look(looking, p):
                return -1.0
            call_others(near, p)
        spare = min(spare, limit[p] - moved)
    if not looked:
        return ALMOST * spare
    if not look_together(near, looking):
        return -1.0
    settle(near)
    return 0.0


@inner
def widen(search, step):
    """Make the skin as wide as two blocks travel in one step, as what is farther is not looked for; whether it grew.
    It is no wider than the largest block, at whose size a run is stopped."""
    if step <= search.skin[0]:
        return False
    before = widest = search.skin[0]
    for b in range(len(search.deep)):
        widest = max(widest, 10.0 * search.deep[b])
    search.skin[0] = min(step, widest)
    return search.skin[0] > before


@inner
def call_others(near, p):
    """Marks on faces and blocks for a look, in the same step, at others that share one with pair p, or may soon."""
    pairs, search = near.pairs, near.search
    for side in range(2):
        block = pairs.body[p, side]
        if search.moves[block]:
            search.stale_block[near.pieces.block[block]] = True
            if pairs.slot[p] >= 0 and pairs.witness[p, 0] == FACE:
                search.stale[pairs.witness[p, 1 + side]] = True
            elif pairs.face[p, side] >= 0:  # what it leaves goes to others
                search.stale[pairs.face[p, side]] = True


@inner
def look_together(near, looking):
    """Look at the patches of stale faces, and at pairs of stale blocks that nearly touch; False without room.

    A block that slides over a seam stands on one patch before and one behind it. Cut in the same step, they make up the
    whole face again; one after the other, they would leave a part of it out or count it twice, which is felt as a
    change of stiffness.
    """
    pairs, search, motion = near.pairs, near.search, near.motion
    again = True
    while again:
        again = False
        for p in range(pairs.number[0]):
            if pairs.mark[p] == motion.travel[pairs.body[p, 0]] + motion.travel[pairs.body[p, 1]]:
                continue
            apart = pairs.slot[p] < 0
            if not (nearly_touches(pairs, near.pieces.block, search, p) if apart else on_stale_face(pairs, search, p)):
                continue
            if not look(looking, p):
                return False
            if apart and pairs.slot[p] >= 0:
                call_others(near, p)
                again = True
    search.stale[:] = False
    search.stale_block[:] = False
    return True


@inner
def nearly_touches(pairs, block, search, p):
    """Whether the pair, which was apart, may touch after a small part of the skin, and one of its blocks is stale."""
    stale = search.stale_block[block[pairs.body[p, 0]]] or search.stale_block[block[pairs.body[p, 1]]]
    return stale and pairs.reach[p] <= 0.25 * search.skin[0]


@inner
def on_stale_face(pairs, search, p):
    """Whether a patch lies on a stale face."""
    if pairs.witness[p, 0] != FACE:
        return False
    return search.stale[pairs.witness[p, 1]] or search.stale[pairs.witness[p, 2]]


@jit
def count_travel(motion, dt, strain=None):
    """Add to each block's travel what this step can add to it at most; strain as in BlockMotion. Returns a bound (m) of
    what it adds to any of them: up to eight times the most."""
    together, bound, last = len(motion.travel) // EIGHT * EIGHT, filled(0.0, eight()), 0.0
    for b in range(0, together, EIGHT):
        bound = maximum(bound, travel_on(motion, eight_rows(b), dt, strain))
    for b in range(together, len(motion.travel)):
        last = max(last, travel_on(motion, b, dt, strain))
    return max(total(bound), last)


@inlined
def travel_on(motion, b, dt, strain):
    """The same of block b, or of eight."""
    velocity, spin = vector_at(motion.v, b, 0), vector_at(motion.v, b, 3)
    rate = sqrt(dot(spin, spin))
    if strain is not None:
        rate += strain[b]
    step = (sqrt(dot(velocity, velocity)) + rate * motion.radius[b]) * dt
    motion.travel[b] += step
    return step


@jit
def farthest(travel, built):
    """How much nearer (m) any two blocks may have come to each other since the last search."""
    first = second = 0.0
    for b in range(len(travel)):
        moved = travel[b] - built[b]
        if moved > first:
            first, second = moved, first
        elif moved > second:
            second = moved
    return first + second
