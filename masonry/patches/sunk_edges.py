"""Contacts that are there only because blocks press: the edge of a block that is sunk into what bears it."""

from math import inf, sqrt

from masonry.detection import placing
from masonry.detection.axes import height
from masonry.detection.narrow import FACE
from masonry.jit.compiler import inner
from masonry.kinematics.matrices import dot, minus, vector_at
from masonry.patches.arrays import between
from masonry.patches.press import gap_of

NARROW = 0.02
"""Of the radius of a piece: a narrower patch may be there only because blocks press, and is asked whether it is."""
SUNK = 2.0
"""Of the width of such a place: how deep it may lie below the two faces that are level with each other there."""
LEVEL_WITH = 0.995
"""Cosine of the angle between faces, or axes, that count as level with each other."""


@inner
def is_as_deep_beside(near, p, depth):
    """Whether another patch on a face of patch p is at least half as deep: what slides over a seam brings its depth."""
    pairs, search = near.pairs, near.search
    if pairs.witness[p, 0] != FACE:
        return False
    list_pairs(pairs, search)
    for side in range(2):
        block = pairs.body[p, side]
        q = search.first_pair[block]
        while q >= 0:
            if q != p and shares_face(pairs, p, q):
                for k in range(near.points.number[pairs.slot[q]]):
                    if -gap_of(pairs, near.points, near.motion, q, k) >= 0.5 * depth:
                        return True
            q = next_pair(pairs, search, q, block)
    return False


@inner
def shares_face(pairs, p, q):
    """Whether pair q touches on a face of patch p."""
    if pairs.slot[q] < 0 or pairs.witness[q, 0] != FACE:
        return False
    return pairs.witness[p, 1] in pairs.witness[q, 1:] or pairs.witness[p, 2] in pairs.witness[q, 1:]


@inner
def is_sunk(near, p, count):
    """Whether a patch is there only as a block of it presses on a third one; `witness` then names the right faces.

    A block that slides over a seam is sunk into the first slab by what its springs give way. By that much its edge
    meets the side of the next slab, where the first one is as well, so that nothing can be hit: they touch with their
    faces that lie level. The third one may be another piece of a block that is not convex.
    """
    pairs, search, first, own_face, other_face, widest = near.pairs, near.search, 0, -1, -1, 0.0
    a, b, i, j = pairs.body[p, 0], pairs.body[p, 1], pairs.piece[p, 0], pairs.piece[p, 1]
    if not is_narrow(near, p, count):
        return False
    list_pairs(pairs, search)
    here, there = search.first_pair[a], search.first_pair[b]
    while here >= 0 or there >= 0:
        q = here if there < 0 or 0 <= here <= there else there
        here = next_pair(pairs, search, q, a) if here == q else here
        there = next_pair(pairs, search, q, b) if there == q else there
        for t in range(2 if pairs.slot[q] >= 0 else 0):
            shared, third = pairs.body[q, 1 - t], pairs.piece[q, t]
            if shared not in (a, b) or third in (i, j):
                continue
            side = 0 if shared == a else 1
            width, n = covered_by(near, count, p, q, t)
            if width <= widest:
                continue
            f, along = face_along(near, pairs.piece[p, side], (-n[0], -n[1], -n[2]))
            g, against = face_along(near, pairs.piece[p, 1 - side], n)
            deep = min(heights_on(near, shared, f, count)[0], heights_on(near, pairs.body[p, 1 - side], g, count)[0])
            if min(along, against) > LEVEL_WITH and deep >= -SUNK * width:
                first, own_face, other_face, widest = side, f, g, width
    if widest > 0.0:
        pairs.witness[p, 0], pairs.witness[p, 1 + first], pairs.witness[p, 2 - first] = FACE, own_face, other_face
    return widest > 0.0


@inner
def is_narrow(near, p, count):
    """Whether a patch is so narrow that is_sunk is asked, or that its corners are two; one only where a block has
    pieces."""
    pieces, point, total, longest = near.pieces, near.footprint.point, 0.0, 0.0
    if count == 1:
        start, a, b = pieces.piece_start, near.pairs.body[p, 0], near.pairs.body[p, 1]
        return max(start[a + 1] - start[a], start[b + 1] - start[b]) > 1
    for k in range(count):
        apart = minus(vector_at(point, k, 0), vector_at(point, 0, 0))
        total, longest = total + near.footprint.area[k], max(longest, sqrt(dot(apart, apart)))
    return total < NARROW * longest * min(pieces.radius[near.pairs.piece[p, 0]], pieces.radius[near.pairs.piece[p, 1]])


@inner
def covered_by(near, count, p, q, t):
    """How wide (m) the place is at which patch p lies within side t of pair q, and the normal out of that towards what
    presses on it; 0 where the patch lies beside it, or stands out of it by more than it is pressed."""
    pairs, pieces, axis = near.pairs, near.pieces, vector_at(near.pairs.axis, q, 0)
    n = axis if t == 0 else (-axis[0], -axis[1], -axis[2])
    block, piece = pairs.body[q, t], pairs.piece[q, t]
    placing.update_piece(pieces, piece, near.motion.frame[block], near.turned)
    place(near, pairs.body[p, 0], block)
    top, along = face_along(near, piece, n)
    if along < LEVEL_WITH or abs(dot(n, vector_at(pairs.axis, p, 0))) > LEVEL_WITH:
        return 0.0, n
    low, high = heights_on(near, block, top, count)
    pressed = -low - max(pairs.slack[q], 0.0)
    width = max(high - low, pressed)
    for f in range(pieces.face_start[piece], pieces.face_start[piece + 1]):
        if heights_on(near, block, f, count)[1] > (pressed if f == top else width):
            return 0.0, n
    return width, n


@inner
def place(near, first, block):
    """Write where a block is, from the first one of a pair: so it is the same everywhere in space."""
    from_first = between(near.motion.centre, near.motion.moved, first, block)
    for i in range(3):
        near.search.position[block, i] = from_first[i]


@inner
def heights_on(near, block, face, count):
    """The least and the greatest height (m) of the points of a look above a face of a block."""
    turned, low, high = near.turned, inf, -inf
    for k in range(count):
        x, y, z = minus(vector_at(near.footprint.point, k, 0), vector_at(near.search.position, block, 0))
        above = height(turned.normal, turned.offset, face, x, y, z)
        low, high = min(low, above), max(high, above)
    return low, high


@inner
def face_along(near, piece, n):
    """The free face of a piece that looks most along n, and the cosine between both."""
    normal, face_start, face, cosine = near.turned.normal, near.pieces.face_start, 0, -2.0
    for f in range(face_start[piece], face_start[piece + 1]):
        along = dot(vector_at(normal, f, 0), n)
        if along > cosine and not near.pieces.inner[f]:
            face, cosine = f, along
    return face, cosine


@inner
def list_pairs(pairs, search):
    """A list of pairs for each block, rising, unless they are listed: `first_pair` has the first one of a block,
    `next_pair` the next one of either block of each; -1 behind the last."""
    if search.listed[0]:
        return
    search.first_pair[:] = -1
    for p in range(pairs.number[0] - 1, -1, -1):
        for side in range(2):
            block = pairs.body[p, side]
            search.next_pair[p, side] = search.first_pair[block]
            search.first_pair[block] = p
    search.listed[0] = True


@inner
def next_pair(pairs, search, p, block):
    """The pair behind pair p in the list of a block."""
    return search.next_pair[p, 0 if pairs.body[p, 0] == block else 1]
