"""How far the two blocks of a pair have moved against each other since it was looked at.

The travel of blocks only grows, and is cheap to count. Blocks that fly or fall together travel far and stay as they are
to each other: before such a pair is looked at, the place of one in the frame of the other tells whether it must be.
"""

from math import sqrt

from masonry.jit.compiler import inner
from masonry.kinematics.planes import into
from masonry.patches.arrays import between
from masonry.patches.pairs import FAR

LEFT = 0.25
"""Of what a pair may move between two looks: with less of it left the pair is looked at."""
STRETCH = 1.25
"""How much longer a length may be in space than in the frame of a block that deforms: it is squeezed to 0.8 of that."""


@inner
def stays(near, p):
    """Whether a pair whose blocks have travelled far need not be looked at: then it says when to ask again."""
    pairs, travel = near.pairs, near.motion.travel
    if pairs.mark[p] <= -FAR:
        return False
    remaining = pairs.reach[p] - moved_apart(pairs, near.motion, p)
    if remaining < LEFT * pairs.reach[p]:
        return False
    pairs.limit[p] = travel[pairs.body[p, 0]] + travel[pairs.body[p, 1]] - pairs.mark[p] + remaining
    return True


@inner
def keep_pose(pairs, motion, p):
    """Where one block of the pair stands in the frame of the other, now that it is looked at."""
    pose = pose_of(pairs, motion, p)
    for i in range(len(pose)):
        pairs.pose[p, i] = pose[i]


@inner
def moved_apart(pairs, motion, p):
    """m, bound of how far any point of the smaller block has moved in the frame of the other one since then."""
    pose, moved, turned = pose_of(pairs, motion, p), 0.0, 0.0
    for i in range(3):
        moved += (pose[i] - pairs.pose[p, i]) ** 2
    for i in range(3, 12):
        turned += (pose[i] - pairs.pose[p, i]) ** 2
    bound = sqrt(moved) + sqrt(turned) * min(motion.radius[pairs.body[p, 0]], motion.radius[pairs.body[p, 1]])
    return bound if motion.dual is None else STRETCH * bound


@inner
def pose_of(pairs, motion, p):
    """Centroid of the smaller block, and its three axes, in the frame of the other one: twelve numbers."""
    a, b = pairs.body[p, 0], pairs.body[p, 1]
    if motion.radius[a] < motion.radius[b]:
        a, b = b, a
    frame, dual = motion.frame, motion.dual
    dx, dy, dz = between(motion.centre, motion.moved, a, b)
    x, y, z = into(frame, dual, a, dx, dy, dz)
    xx, xy, xz = into(frame, dual, a, frame[b, 0, 0], frame[b, 1, 0], frame[b, 2, 0])
    yx, yy, yz = into(frame, dual, a, frame[b, 0, 1], frame[b, 1, 1], frame[b, 2, 1])
    zx, zy, zz = into(frame, dual, a, frame[b, 0, 2], frame[b, 1, 2], frame[b, 2, 2])
    return x, y, z, xx, xy, xz, yx, yy, yz, zx, zy, zz
