"""Looking for contacts again changes no normal energy: a patch gets slack, and presses as much less or more.

A look measures the gaps of a patch from where its blocks are, and its areas from how they overlap. Where area comes
under pressure, or two crossed edges become two faces, the springs would hold more than before, which nothing has paid:
what falls would come off the ground faster than it came down. Where area goes they would hold less, as if something had
taken it. So gaps get a slack, the same for all points of the pair, with which the patch holds what it held: above 0 it
presses less, below 0 more. It is taken back as the blocks part (press.ease).

Where the dashpot of the pair has dissipated as much, it pays for what the springs gain, and they get no slack: what has
hit the ground with a corner comes to rest on it as on any spring, and not as deep as it hit. Energy does not grow: the
work that the dashpot has taken is less, by what it has paid.

A block that slides over a seam takes area from one patch to another: what the first loses pays for what the second
gains, where they share a face. There the first gets no slack: the two would press unlike each other, which is felt.
"""

from math import sqrt

from masonry.detection.narrow import FACE
from masonry.jit.compiler import inner, jit
from masonry.patches.arrays import AREA, DASHPOT, NORMAL_GAINED, number_of
from masonry.patches.press import pressing_gap, stored

ROUNDS = 60
"""Of Newton's method, at most: six are usual."""


@inner
def settle(near):
    """Give slack to all pairs that gained normal energy in the looks of this step, as far as none on their faces lost
    as much; and to patches that lost some, but not to others on their faces. What goes with a pair is lost."""
    pairs, losers, count = near.pairs, near.search.losers, 0
    for p in range(pairs.number[0]):
        if pairs.gained[p] < 0.0:
            losers[count] = p
            count += 1
    if count > 0:
        list_losers(pairs, near.search, count)
        for p in range(pairs.number[0]):
            if pairs.gained[p] > 0.0 and pairs.witness[p, 0] == FACE:
                let_losers_pay(pairs, near.search, p)
        count_patches(pairs, near.search.patches)
    for p in range(pairs.number[0]):
        if pairs.gained[p] > 0.0 or (pairs.gained[p] < 0.0 and is_alone(pairs, near.search.patches, p)):
            pressed = stored(pairs, near.points, near.rules, near.motion, p)[0]
            paid = max(0.0, min(pairs.damped[p], pairs.gained[p]))
            near.account[NORMAL_GAINED] += hold(near, p, pressed - pairs.gained[p] + paid) - pressed - paid
            near.account[DASHPOT] -= paid
            pairs.damped[p] -= paid
        pairs.gained[p] = 0.0


@inner
def count_patches(pairs, patches):
    """How many patches lie on each face, into patches (faces,)."""
    patches[:] = 0
    for p in range(pairs.number[0]):
        if pairs.slot[p] >= 0 and pairs.witness[p, 0] == FACE:
            patches[pairs.witness[p, 1]] += 1
            patches[pairs.witness[p, 2]] += 1


@inner
def is_alone(pairs, patches, p):
    """Whether a pair touches with the same two faces as before the last look, and nothing else touches these."""
    face_a, face_b = pairs.witness[p, 1], pairs.witness[p, 2]
    if pairs.slot[p] < 0 or pairs.witness[p, 0] != FACE or pairs.face[p, 0] != face_a or pairs.face[p, 1] != face_b:
        return False
    return patches[face_a] == 1 and patches[face_b] == 1


@inner
def list_losers(pairs, search, count):
    """A list for each face of the pairs on it, before the last look, that lost energy: `patches` has the first one of a
    face, `candidates` the next one on either face of each; numbers in `losers`, rising, -1 behind the last."""
    first, following = search.patches, search.candidates
    first[:] = -1
    for k in range(count - 1, -1, -1):
        for side in range(2):
            face = pairs.face[search.losers[k], side]
            if face >= 0:
                following[k, side] = first[face]
                first[face] = k


@inner
def let_losers_pay(pairs, search, p):
    """Payment for the gain of patch p by what others on its two faces lost, in the order of their numbers."""
    face_a, face_b = pairs.witness[p, 1], pairs.witness[p, 2]
    here, there = search.patches[face_a], search.patches[face_b]
    while here >= 0 or there >= 0:
        k = here if there < 0 or 0 <= here <= there else there
        q = search.losers[k]
        paid = min(pairs.gained[p], -pairs.gained[q])
        pairs.gained[p] -= paid
        pairs.gained[q] += paid
        here = search.candidates[k, 0 if pairs.face[q, 0] == face_a else 1] if here == k else here
        there = search.candidates[k, 0 if pairs.face[q, 0] == face_b else 1] if there == k else there


@jit
def hold(near, p, energy):
    """Give a pair the slack with which its points hold a normal energy (J), if any; returns what they hold then.

    The root of the energy is a convex function of the slack: Newton's method comes from the left, and stays there; from
    the right its first step goes there.
    """
    pairs, points, motion = near.pairs, near.points, near.motion
    s, kn = pairs.slot[p], near.rules.normal_stiffness[pairs.law[p]]
    target = sqrt(max(energy, 0.0))
    for _ in range(ROUNDS):
        twice = force = deepest = 0.0
        for k in range(points.number[s]):
            gap = pressing_gap(pairs, points, motion, p, k)
            if gap < 0.0:
                twice += number_of(points, s, k, AREA) * kn * gap * gap
                force -= number_of(points, s, k, AREA) * kn * gap
                deepest = min(deepest, gap)
        root = sqrt(0.5 * twice)
        if force == 0.0:
            return 0.0
        if target == 0.0:
            pairs.slack[p] -= deepest
            return 0.0
        change = 2.0 * root * (root - target) / force
        if abs(change) <= 1e-15 * (abs(pairs.slack[p]) - deepest):
            return root * root
        pairs.slack[p] += change
    return stored(pairs, points, near.rules, motion, p)[0]
