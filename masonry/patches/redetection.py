"""Looking for contacts again: where a pair touches, and what its points remember; refreshing.py says when."""

from math import sqrt
from typing import NamedTuple

import numpy as np

from masonry.detection import placing
from masonry.detection.narrow import FACE, NONE, touch
from masonry.detection.placing import owner
from masonry.detection.spread import spread, spread_in_rounds
from masonry.detection.transfer import transfer, turn_tractions
from masonry.jit.compiled_parts import Call, CompiledPart
from masonry.jit.compiler import inner
from masonry.jit.records import call, unpack
from masonry.kinematics.matrices import vector_at
from masonry.kinematics.planes import into, plane_of, turned
from masonry.patches.arrays import (
    AREA,
    BORN,
    LEVEL,
    LOOKS,
    NEED_POINTS,
    NORMAL_GAINED,
    PAIR,
    PLACE,
    REASON,
    SEARCHES,
    SHEAR,
    SHEAR_LOST,
    TOO_DEEP,
    Near,
    number_of,
    outward,
    places_alone,
    put_number_of,
    put_vector_of,
    vector_of,
)
from masonry.patches.branches import forget
from masonry.patches.crushed_faces import keep_crushing, recall_crushing
from masonry.patches.pair_search import part
from masonry.patches.pairs import FAR
from masonry.patches.press import stored
from masonry.patches.relative_motion import keep_pose
from masonry.patches.sunk_edges import is_as_deep_beside, is_sunk, place
from masonry.simd import FOUR

MOVED = 0.01
"""Of the size of a patch: travel of its two blocks after which it is looked at again."""
SIDEWAYS = 0.01
"""Of the skin: travel of two triangles that lie beside each other after which they are looked at again, at least."""
BORN_DEEP = 0.1
"""Of the side of a contact of edges, itself a tenth of a block's: the overlap at which a contact may not begin."""
WHICH, SUNK, KIND, COUNT, OWNER, FORMER, ANSWER = range(7)
SEPARATION, BLEND, SIZE = range(3)


class Touch(NamedTuple):
    """Question about a pair, and findings of a look.

    whole  (7,) WHICH pair; whether it touches with other faces as it is SUNK; KIND of contact, COUNT of points and side
           of their OWNER; how many points there were, FORMER; ANSWER
    real   (3,) SEPARATION (m), BLEND and SIZE (m) as `touch` returns them
    """

    whole: np.ndarray
    real: np.ndarray


def looking_at(near: Near) -> tuple[Call, Touch]:
    """Call of `look`, and room for what it asks and finds."""
    touch, places = Touch(np.zeros(7, dtype=np.int64), np.zeros(3)), places_alone(near)
    renewing = _renew.of(near, _hand_on.of(places, touch), touch)
    return _look.of(near, _touch.of(places, touch), renewing, touch), touch


@inner
def look(looking, p):
    """Where pair p touches now; its points take over what they remember. False without room."""
    (function, record), query = looking
    query.whole[WHICH] = p
    call(function, record)
    return query.whole[ANSWER] != 0


@CompiledPart
def _look(record):
    near, touching, renewing, query = unpack(record)
    query.whole[ANSWER] = answer_of(near, touching, renewing, query)


@CompiledPart
def _renew(record):
    near, handing, query = unpack(record)
    query.whole[ANSWER] = renew(near, query.whole[WHICH], query.whole[COUNT], query.whole[OWNER], handing, query)


@CompiledPart
def _hand_on(record):
    """Shear tractions of the former points to those of a look, from `former` to `footprint`."""
    near, query = unpack(record)
    count, former_count, axis = query.whole[COUNT], query.whole[FORMER], near.pairs.axis[query.whole[WHICH]]
    former, footprint = near.former, near.footprint
    turn_tractions(former.shear, former_count, former.normal, axis, 0.0)
    transfer(
        *(former.point, former.area, former.feature, former.shear, former_count),
        *(footprint.point, footprint.area, footprint.feature, footprint.shear, count, axis, near.scratch),
    )


@CompiledPart
def _touch(record):
    near, query = unpack(record)
    query.whole[COUNT] = touch_anew(near, query.whole[WHICH], query)


@inner
def touch_anew(near, p, query):
    """Write where pair p touches now into footprint, with further points inside; returns how many points there are."""
    pieces, pairs, search, footprint = near.pieces, near.pairs, near.search, near.footprint
    a, b = pairs.body[p, 0], pairs.body[p, 1]
    minimum_area, query.whole[SUNK] = min(search.minimum_area[a], search.minimum_area[b]), False
    of_tets = pieces.block[a] != a or pieces.block[b] != b
    while True:
        # FAR: an overlap is not cut where its gap is wide, so that its points keep their areas while a block rocks.
        kind, count, separation, blend, size = touch(
            *(
                pieces,
                near.turned,
                search.position,
                pairs.piece[p, 0],
                pairs.piece[p, 1],
                search.skin[0],
                FAR,
                minimum_area,
            ),
            *(query.whole[SUNK] != 0, pairs.axis[p], pairs.witness[p], near.scratch),
            *(footprint.point, footprint.gap, footprint.area, footprint.feature),
        )
        if query.whole[SUNK] or of_tets or kind == NONE or not is_sunk(near, p, count):
            break
        query.whole[SUNK] = True
    query.whole[KIND] = kind
    query.real[SEPARATION], query.real[BLEND], query.real[SIZE] = separation, blend, size
    return further_points(search, footprint, count) if kind == FACE and count >= 3 else count


@inner
def answer_of(near, touching, renewing, query):
    """Answer of `look`."""
    p = query.whole[WHICH]
    pieces, pairs, points, motion, search = near.pieces, near.pairs, near.points, near.motion, near.search
    a, b = pairs.body[p, 0], pairs.body[p, 1]
    for side in range(2):
        block = pairs.body[p, side]
        placing.update_piece(pieces, pairs.piece[p, side], motion.frame[block], near.turned)
    place(near, a, a)
    place(near, a, b)
    pairs.face[p, 0] = pairs.face[p, 1] = -1
    if pairs.witness[p, 0] == FACE:
        pairs.face[p, 0], pairs.face[p, 1] = pairs.witness[p, 1], pairs.witness[p, 2]
    keep_crushing(near.crushed, near, pairs, p)
    skin = search.skin[0]
    search.tally[LOOKS] += 1
    call(touching[0], touching[1])
    separation, size = query.real[SEPARATION], query.real[SIZE]
    pairs.mark[p] = motion.travel[a] + motion.travel[b]
    keep_pose(pairs, motion, p)
    if query.whole[KIND] == NONE:
        reach = max(separation - 0.5 * skin, 0.25 * skin)
        of_tets = pieces.block[a] != a or pieces.block[b] != b
        if of_tets or query.whole[SUNK]:  # inner faces of tets part nothing, nor do sunk ones: they may meet at once
            reach = max(separation - 0.5 * skin, size, SIDEWAYS * skin)
        pairs.limit[p] = pairs.reach[p] = reach
        part(near, pairs, p)
        return True
    pairs.limit[p] = pairs.reach[p] = MOVED * size
    if pairs.slot[p] < 0 and points.free[len(points.number)] == 0:
        search.refusal[REASON], search.refusal[PAIR] = NEED_POINTS, p
        pairs.mark[p] = -FAR
        return False
    query.whole[OWNER] = owner(pieces, pairs.piece[p, 0], pairs.piece[p, 1], query.real[BLEND])
    call(renewing[0], renewing[1])
    return query.whole[ANSWER] != 0


@inner
def further_points(search, footprint, count):
    """Points inside of a patch of two faces, besides the `count` at its corners; returns how many there are in all."""
    if len(search.rounds) > 1:
        return spread_in_rounds(footprint.point, footprint.gap, footprint.area, footprint.feature, count, search.rounds)
    if search.spread:
        return spread(footprint.point, footprint.gap, footprint.area, footprint.feature, count)
    return count


@inner
def renew(near, p, count, owner, handing, query):
    """Give pair p the points that a look found; `owner` is the side they belong to. False where one is too deep."""
    pairs, points, motion, search = near.pairs, near.points, near.motion, near.search
    pressed, sheared = stored(pairs, points, near.rules, motion, p)
    former_count = 0
    if pairs.slot[p] < 0:
        room = len(points.number)
        points.free[room] -= 1
        pairs.slot[p] = points.free[points.free[room]]
    else:
        former_count = remember(near, p)
    set_plane(near, p, owner)
    deepest, area = write_points(near, p, count, former_count)
    if former_count > 0:
        query.whole[FORMER] = former_count
        call(handing[0], handing[1])
    put_shear(near, p, count, former_count)
    closing = recall_crushing(near.crushed, near, p, count, former_count)
    set_dashpot(pairs, near.rules, search, p, area)
    deep = BORN_DEEP * min(search.deep[pairs.body[p, 0]], search.deep[pairs.body[p, 1]])
    if former_count == 0 and -deepest - closing > deep and not is_as_deep_beside(near, p, -deepest):
        search.refusal[REASON], search.refusal[PAIR] = TOO_DEEP, p
        return False
    pairs.slack[p] = min(pairs.slack[p], 0.0)  # what a patch took over from bonds stays
    now_pressed, now_sheared = stored(pairs, points, near.rules, motion, p)
    if former_count > 0 or search.tally[SEARCHES] > 1:  # what presses from the start is as the scene says
        pairs.gained[p] += now_pressed - pressed
    near.account[SHEAR_LOST] += sheared - now_sheared
    near.account[NORMAL_GAINED if former_count > 0 else BORN] += now_pressed - pressed
    return True


@inner
def remember(near, p):
    """Keep the places, names, areas, shear tractions and the normal of a patch; returns how many points it has."""
    pairs, points, motion, former = near.pairs, near.points, near.motion, near.former
    s, owner = pairs.slot[p], pairs.points_of[p]
    ref, other = pairs.body[p, 1 - owner], pairs.body[p, owner]
    x, y, z = pairs.normal[p, 0], pairs.normal[p, 1], pairs.normal[p, 2]
    n = plane_of(motion.frame, motion.dual, ref, x, y, z)
    for i in range(3):
        former.normal[i] = outward(owner) * n[i]
    for k in range(points.number[s]):
        x, y, z = vector_of(points, s, k, PLACE)
        arm, shear = turned(motion.frame, other, x, y, z), vector_of(points, s, k, SHEAR)
        for i in range(3):
            former.point[k, i] = near.search.position[other, i] + arm[i]
            former.shear[k, i] = outward(owner) * shear[i]
        former.area[k], former.feature[k] = number_of(points, s, k, AREA), points.feature[s, k]
    return points.number[s]


@inner
def set_plane(near, p, owner):
    """The plane lies in the block on the other side than the points, across the axis: F^T n, whatever the frame."""
    pairs, frame, axis = near.pairs, near.motion.frame, near.pairs.axis[p]
    ref, sign = pairs.body[p, 1 - owner], outward(owner)
    pairs.points_of[p] = owner
    for i in range(3):
        along = frame[ref, 0, i] * axis[0] + frame[ref, 1, i] * axis[1] + frame[ref, 2, i] * axis[2]
        pairs.normal[p, i] = sign * along


@inner
def write_points(near, p, count, former_count):
    """Write the points of a look, without their shear; returns the least gap, or 0, (m) and the whole area (m2)."""
    pairs, points, motion, footprint = near.pairs, near.points, near.motion, near.footprint
    s, owner, axis, position = pairs.slot[p], pairs.points_of[p], pairs.axis[p], near.search.position
    ref, other, sign = pairs.body[p, 1 - owner], pairs.body[p, owner], outward(owner)
    area = deepest = 0.0
    for k in range(count):
        deepest = min(deepest, footprint.gap[k])
        along, gap = 0.0, footprint.gap[k]
        for i in range(3):
            footprint.point[k, i] += 0.5 * sign * gap * axis[i]  # from the middle to the face that the points belong to
            along += axis[i] * (footprint.point[k, i] - position[ref, i])
        x, y = footprint.point[k, 0] - position[other, 0], footprint.point[k, 1] - position[other, 1]
        z = footprint.point[k, 2] - position[other, 2]
        put_vector_of(points, s, k, PLACE, into(motion.frame, motion.dual, other, x, y, z))
        put_number_of(points, s, k, LEVEL, sign * along - gap)
        put_number_of(points, s, k, AREA, footprint.area[k])
        points.feature[s, k] = footprint.feature[k]
        if k >= former_count or near.former.feature[k] != footprint.feature[k]:
            points.damper[k // FOUR, s, k % FOUR] = 0.0
            forget(points.branches, s, k)
        area += footprint.area[k]
    points.number[s] = count
    return deepest, area


@inner
def put_shear(near, p, count, former_count):
    """The points take over the shear of the patch that was, as footprint has it; without one they begin with none."""
    pairs, points, footprint = near.pairs, near.points, near.footprint
    s, sign = pairs.slot[p], outward(pairs.points_of[p])
    for k in range(-(-count // FOUR) * FOUR):
        x, y, z = vector_at(footprint.shear, k, 0) if former_count > 0 and k < count else (0.0, 0.0, 0.0)
        put_vector_of(points, s, k, SHEAR, (sign * x, sign * y, sign * z))
        if k >= count:  # beside the points: whatever was there has been lost already, and is not to count again
            points.damper[k // FOUR, s, k % FOUR] = 0.0
            forget(points.branches, s, k)


@inner
def set_dashpot(pairs, rules, search, p, area):
    """The dashpot of a patch (Pa s/m): its fraction of the critical damping of the two masses on the whole patch, or of
    the mass that moves where the other block is held.

    Patches of a mesh are parts of a face, and the smaller the finer it is: there the masses behind its area count.
    """
    damping_ratio, kn = rules.dashpot[pairs.law[p]], rules.normal_stiffness[pairs.law[p]]
    pairs.dashpot[p] = 0.0
    if damping_ratio > 0.0 and area > 0.0:
        a, b = pairs.body[p, 0], pairs.body[p, 1]
        mass_a, mass_b = search.mass[a], search.mass[b]
        hit = (
            mass_a * mass_b / (mass_a + mass_b)
            if search.free[a] and search.free[b]
            else (mass_a if search.free[a] else mass_b)
        )
        behind = hit if search.meshed else hit / area
        ratio = share_in_steps(rules.rise, pairs.law[p], damping_ratio, sqrt(kn / behind))
        pairs.dashpot[p] = 2.0 * ratio * sqrt(kn * hit / (1.0 if search.meshed else area))


@inner
def share_in_steps(rise, law, ratio, omega):
    """The share of critical that a dashpot needs in steps as they are: more where a restitution is given."""
    if rise is None:
        return ratio
    omega = min(omega, rise[law, 2])
    return ratio + rise[law, 0] * omega + rise[law, 1] * omega * omega
