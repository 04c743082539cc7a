"""Levers of contact forces on blocks that turn: both sides of a contact act at one point, the material point of side b.

So the lever of side a is that of its own material point and `apart`, u_b - u_a: then the two forces have no couple, and
the angular momentum of the pair is kept. What a force has beyond its material point is a couple: it acts on the turn of
a block that deforms, and not on its stretch, as the frames of contacts turn and do not stretch.
"""

from masonry.jit.extending import register_jitable
from masonry.kinematics.matrices import scaled, vector_at, vector_or_zero
from masonry.simd import numbers, pack, plus, take_row


@register_jitable
def moments(apart, start, code, arm, force, b):
    """Force (3) on block b; its first moments (9), row by row: force times arm, of the arms as they are given; and the
    couple (3) of the forces on sides a about their material points, global, which is 0 without `apart`."""
    nothing = pack((0.0, 0.0, 0.0, 0.0))
    whole, by_x, by_y, by_z = nothing, nothing, nothing, nothing
    beside_x, beside_y, beside_z = nothing, nothing, nothing
    for k in range(start[b], start[b + 1]):
        c, on_b = code[k] >> 1, 1.0 * (code[k] & 1)
        row = take_row(force, c)
        push = plus(nothing, 1.0 - 2.0 * on_b, row)
        whole = plus(whole, 1.0, push)
        by_x = plus(by_x, arm[k, 0], push)
        by_y = plus(by_y, arm[k, 1], push)
        by_z = plus(by_z, arm[k, 2], push)
        if apart is not None:
            on_a = plus(nothing, 1.0 - on_b, row)
            beside_x = plus(beside_x, apart[c, 0], on_a)
            beside_y = plus(beside_y, apart[c, 1], on_a)
            beside_z = plus(beside_z, apart[c, 2], on_a)
    f, x, y, z = numbers(whole), numbers(by_x), numbers(by_y), numbers(by_z)
    first = x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]
    x, y, z = numbers(beside_x), numbers(beside_y), numbers(beside_z)
    return (f[0], f[1], f[2]), first, (y[2] - z[1], z[0] - x[2], x[1] - y[0])


@register_jitable
def axial(m):
    """The moment, sum of x cross f, of first moments (9), sum of f_i x_j row by row."""
    return m[7] - m[5], m[2] - m[6], m[3] - m[1]


@register_jitable
def skew(couple):
    """The antisymmetric first moments (9) of a couple: what they do work on is the turn alone."""
    x, y, z = scaled(0.5, couple)
    return 0.0, -z, y, z, 0.0, -x, -y, x, 0.0


@register_jitable
def patch_force(patches, b):
    """Force of the detected contacts on block b; 0 where there are none."""
    return vector_or_zero(patches, b, 0)


@register_jitable
def patch_couple(patches, b):
    """Moment of the detected contacts about the centroid of block b; 0 where there are none."""
    return vector_or_zero(patches, b, 3)


@register_jitable
def patch_moments(patches, b):
    """First moments (9) of the detected contacts about the centroid of block b, global; 0 where there are none."""
    if patches is None:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    return *vector_at(patches, b, 3), *vector_at(patches, b, 6), *vector_at(patches, b, 9)
