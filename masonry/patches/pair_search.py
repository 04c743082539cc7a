"""Which pairs of pieces are near each other: all that may meet, with what is known of those that were near before."""

import numpy as np

from masonry.detection import placing
from masonry.detection.broad import near_pairs, write_boxes
from masonry.jit.compiled_parts import Call, CompiledPart
from masonry.jit.compiler import inner
from masonry.jit.records import call, unpack
from masonry.patches.arrays import NEED_PAIRS, NORMAL_GAINED, REASON, ROOM, SEARCHES, SHEAR_LOST, Near, places_alone
from masonry.patches.crushed_faces import keep_crushing
from masonry.patches.pairs import begin_pair, copy_pair, copy_pairs
from masonry.patches.press import stored


def searching_for(near: Near) -> tuple[Call, np.ndarray]:
    """Call of `find_pairs`, and the place of its answer."""
    count, answer = np.zeros(1, dtype=np.int64), np.zeros(1, dtype=bool)
    return _find_pairs.of(near, _list_candidates.of(places_alone(near), count), count, answer), answer


@inner
def find_pairs(searching):
    """All pairs that may meet before the next search; what is known of those that were near before stays.

    Blocks that do not move are no pair, nor are two that bonds hold together. False where there is no room.
    """
    (function, record), answer = searching
    call(function, record)
    return answer[0]


@CompiledPart
def _find_pairs(record):
    near, listing, count, answer = unpack(record)
    call(listing[0], listing[1])
    answer[0] = write_pairs(near, count[0])


@CompiledPart
def _list_candidates(record):
    """Pieces whose boxes meet as blocks stand now, sorted, into search.candidates; how many pairs into count (1,)."""
    near, count = unpack(record)
    motion, search = near.motion, near.search
    placing.update_pieces(near.pieces, motion.frame, near.turned)
    for b in range(len(motion.travel)):
        search.built[b] = motion.travel[b]
        for i in range(3):
            search.position[b, i] = motion.centre[b, i] + motion.moved[b, i]
    search.tally[SEARCHES] += 1
    write_boxes(near.pieces, near.turned, search.position, 2.0 * search.skin[0], near.cells)
    count[0] = near_pairs(near.cells, search.candidates)


@inner
def write_pairs(near, count):
    """Write the candidates as pairs, unless there is no room for so many: then False."""
    search = near.search
    if count > len(search.candidates):
        search.refusal[REASON], search.refusal[ROOM] = NEED_PAIRS, count
        return False
    copy_pairs(near.pairs, near.before)
    merge(near, count)
    return True


@inner
def merge(near, count):
    """Write the candidates, which are sorted, as pairs, with what is known of them; what is far now parts."""
    pieces, pairs, before, search = near.pieces, near.pairs, near.before, near.search
    number, p, last = 0, 0, before.number[0]
    for k in range(count):
        i, j = search.candidates[k, 0], search.candidates[k, 1]
        while p < last and (before.piece[p, 0] < i or (before.piece[p, 0] == i and before.piece[p, 1] < j)):
            leave(near, before, p)
            p += 1
        a, b = pieces.body[i], pieces.body[j]
        known = p < last and before.piece[p, 0] == i and before.piece[p, 1] == j
        if known:
            copy_pair(before, p, pairs, number)
            p, number = p + 1, number + 1
        elif (search.moves[a] or search.moves[b]) and not is_bonded(
            search.bonded, search.alive, pieces.block[a], pieces.block[b], len(pieces.body)
        ):
            within_unit = 1 if search.unit[a] == search.unit[b] else 0
            begin_pair(pairs, number, i, j, a, b, search.law_of[search.group[a], search.group[b], within_unit])
            number += 1
    while p < last:
        leave(near, before, p)
        p += 1
    pairs.number[0] = number


@inner
def is_bonded(bonded, alive, a, b, count):
    """Whether bonds hold two blocks together."""
    key = min(a, b) * count + max(a, b)
    k = np.searchsorted(bonded, key)
    return k < len(bonded) and bonded[k] == key and alive[k]


@inner
def leave(near, pairs, p):
    """A pair is near no more; its faces remember how far it was crushed."""
    keep_crushing(near.crushed, near, pairs, p)
    part(near, pairs, p)


@inner
def part(near, pairs, p):
    """A pair touches no more: its slot is free again, and what its points still hold is booked as lost."""
    points, s = near.points, pairs.slot[p]
    if s < 0:
        return
    pressed, sheared = stored(pairs, points, near.rules, near.motion, p)
    near.account[SHEAR_LOST] += sheared
    near.account[NORMAL_GAINED] -= pressed
    pairs.gained[p] -= pressed
    pairs.slack[p] = pairs.damped[p] = 0.0
    room = len(points.number)
    points.free[points.free[room]] = s
    points.free[room] += 1
    points.number[s] = 0
    pairs.slot[p] = -1
