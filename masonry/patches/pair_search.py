"""Which pairs of pieces are near each other: found anew, and what is known of those that were near before is kept."""

import numpy as np

from masonry.detection import placing
from masonry.detection.broad import near_pairs, write_boxes
from masonry.jit.compiler import inner, jit

FAR = 1e30
"""m: farther than anything is, or moves."""
NEED_POINTS, NEED_PAIRS, TOO_DEEP = 1, 2, 3
"""Why a step was not taken: no free slot, no room for pairs, or a contact that was born with a deep overlap."""


@inner
def find_pairs(near):
    """All pairs that may meet before the next search; what is known of those that were near before stays.

    Blocks that do not move are no pair, nor are two that bonds hold together. False where there is no room.
    """
    pieces, motion, search = near.pieces, near.motion, near.search
    placing.update_pieces(pieces, motion.frame, near.turned)
    for b in range(len(motion.travel)):
        search.built[b] = motion.travel[b]
        for i in range(3):
            search.position[b, i] = motion.centre[b, i] + motion.moved[b, i]
    search.flag[2] += 1
    write_boxes(pieces, near.turned, search.position, 2.0 * search.skin[0], near.cells)
    count = near_pairs(near.cells, search.found)
    if count > len(search.found):
        search.flag[0], search.flag[1] = NEED_PAIRS, count
        return False
    copy_pairs(near.pairs, near.before)
    merge(near.pairs, near.before, near.points, pieces.body, pieces.block, search, count)
    return True


@jit
def copy_pairs(pairs, before):
    """Keep what is known of all pairs."""
    before.number[0] = pairs.number[0]
    for p in range(pairs.number[0]):
        copy_pair(pairs, p, before, p)


@inner
def copy_pair(source, p, target, q):
    """Row q of the target becomes row p of the source."""
    for i in range(2):
        target.piece[q, i], target.body[q, i] = source.piece[p, i], source.body[p, i]
        target.face[q, i] = source.face[p, i]
    for i in range(3):
        target.normal[q, i], target.axis[q, i] = source.normal[p, i], source.axis[p, i]
        target.witness[q, i] = source.witness[p, i]
    target.slot[q], target.points_of[q] = source.slot[p], source.points_of[p]
    for i in range(12):
        target.pose[q, i] = source.pose[p, i]
    target.mark[q], target.limit[q], target.reach[q] = source.mark[p], source.limit[p], source.reach[p]
    target.law[q], target.dashpot[q] = source.law[p], source.dashpot[p]
    target.slack[q], target.gained[q], target.damped[q] = source.slack[p], source.gained[p], source.damped[p]


@inner
def merge(pairs, before, points, body, block, search, count):
    """Write the sorted pairs that were found, with what is known of them; slots of those that are gone become free."""
    number, p, had = 0, 0, before.number[0]
    for k in range(count):
        i, j = search.found[k, 0], search.found[k, 1]
        while p < had and (before.piece[p, 0] < i or (before.piece[p, 0] == i and before.piece[p, 1] < j)):
            release(points, before.slot[p])
            p += 1
        a, b = body[i], body[j]
        known = p < had and before.piece[p, 0] == i and before.piece[p, 1] == j
        if known:
            copy_pair(before, p, pairs, number)
            p, number = p + 1, number + 1
        elif (search.moves[a] or search.moves[b]) and not is_bonded(
            search.bonded, search.held, block[a], block[b], len(body)
        ):
            one = 1 if search.unit[a] == search.unit[b] else 0
            pairs.piece[number, 0], pairs.piece[number, 1] = i, j
            pairs.body[number, 0], pairs.body[number, 1] = a, b
            pairs.slot[number], pairs.mark[number], pairs.limit[number] = -1, -FAR, 0.0
            pairs.slack[number] = pairs.gained[number] = pairs.damped[number] = 0.0
            pairs.law[number], pairs.dashpot[number] = search.law_of[search.group[a], search.group[b], one], 0.0
            for m in range(3):
                pairs.axis[number, m], pairs.witness[number, m] = 0.0, -1
            number += 1
    while p < had:
        release(points, before.slot[p])
        p += 1
    pairs.number[0] = number


@inner
def is_bonded(bonded, held, a, b, count):
    """Whether bonds hold two blocks together."""
    key = min(a, b) * count + max(a, b)
    k = np.searchsorted(bonded, key)
    return k < len(bonded) and bonded[k] == key and held[k]


@inner
def release(points, s):
    """A slot is free again; nothing where a pair had none (-1)."""
    if s >= 0:
        room = len(points.held)
        points.free[points.free[room]] = s
        points.free[room] += 1
        points.held[s] = 0
