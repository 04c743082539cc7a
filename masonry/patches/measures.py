"""Measures of patches at rows, and not at every step: energies, forces, overlaps, compressions."""

from masonry.detection.narrow import FACE
from masonry.jit.compiled_parts import CompiledPart
from masonry.jit.records import unpack
from masonry.kinematics.planes import plane_of, turned
from masonry.patches.arrays import AREA, PLACE, SHEAR, number_of, outward, vector_of
from masonry.patches.branches import with_branches
from masonry.patches.crushed_points import with_closing
from masonry.patches.press import gap_of, pressing_gap, stored
from masonry.simd import FOUR


@CompiledPart
def stored_energy(record):
    """Elastic energy (J) of all patches, into energy (1,)."""
    near, energy = unpack(record)
    energy[0] = 0.0
    for p in range(near.pairs.number[0]):
        pressed, sheared = stored(near.pairs, near.points, near.rules, near.motion, p)
        energy[0] += pressed + sheared


@CompiledPart
def point_forces(record):
    """Write the two blocks and bodies (K, 2), the place (K, 3) m, the force (K, 3) N on the first, and the normal
    (K, 3) from it to the second, of all points that bear; and into number (1,) how many these are, or would be with
    more room."""
    near, block, body, place, force, normal, number = unpack(record)
    pairs, points, motion, count = near.pairs, near.points, near.motion, 0
    for p in range(pairs.number[0]):
        s, owner = pairs.slot[p], pairs.points_of[p]
        ref, other = pairs.body[p, 1 - owner], pairs.body[p, owner]
        kn = near.rules.normal_stiffness[pairs.law[p]]
        for k in range(points.number[s] if s >= 0 else 0):
            gap = pressing_gap(pairs, points, motion, p, k)
            if gap >= 0.0:
                continue
            if count < len(block):
                x, y, z = pairs.normal[p, 0], pairs.normal[p, 1], pairs.normal[p, 2]
                n = plane_of(motion.frame, motion.dual, ref, x, y, z)
                x, y, z = vector_of(points, s, k, PLACE)
                arm = turned(motion.frame, other, x, y, z)
                sigma = kn * gap + (points.damper[k // FOUR, s, k % FOUR] if pairs.dashpot[p] > 0.0 else 0.0)
                shear = with_branches(points.branches, s, k, vector_of(points, s, k, SHEAR))
                sign = outward(owner)
                for i in range(3):
                    place[count, i] = motion.centre[other, i] + motion.moved[other, i] + arm[i]
                    force[count, i] = sign * number_of(points, s, k, AREA) * (shear[i] + sigma * n[i])
                    normal[count, i] = sign * n[i]
                for side in range(2):
                    body[count, side] = pairs.body[p, side]
                    block[count, side] = near.pieces.block[pairs.body[p, side]]
            count += 1
    number[0] = count


@CompiledPart
def deepest(record):
    """How far points overlap at most, over the least width (B,) m of the thinner of their two blocks, into overlap
    (1,); and the pair, into pair (1,)."""
    near, width, overlap, pair = unpack(record)
    pairs, points, block, maximum, which = near.pairs, near.points, near.pieces.block, 0.0, -1
    for p in range(pairs.number[0]):
        s = pairs.slot[p]
        for k in range(points.number[s] if s >= 0 else 0):
            gap = with_closing(points.crushed, s, k, gap_of(pairs, points, near.motion, p, k))
            over_width = -gap / min(width[block[pairs.body[p, 0]]], width[block[pairs.body[p, 1]]])
            if over_width > maximum:
                maximum, which = over_width, p
    overlap[0], pair[0] = maximum, which


@CompiledPart
def compressions(record):
    """Raise pressed (R,) Pa to the compression of every point of patches of two faces, by row of the rules.

    Edges and corners stand on an area that is made up, so their stress tells nothing. What dashpots add is no stress of
    a joint either.
    """
    near, pressed = unpack(record)
    pairs, points, motion = near.pairs, near.points, near.motion
    for p in range(pairs.number[0]):
        s, row = pairs.slot[p], pairs.law[p]
        if s < 0 or pairs.witness[p, 0] != FACE:
            continue
        for k in range(points.number[s]):
            gap = pressing_gap(pairs, points, motion, p, k)
            pressed[row] = max(pressed[row], -near.rules.normal_stiffness[row] * gap)
