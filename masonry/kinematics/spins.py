"""How fast blocks turn that have some angular momentum: of one block in numbers, of eight in lanes."""

from masonry.jit.extending import register_jitable
from masonry.kinematics.matrices import (
    added,
    cross,
    each,
    exponential,
    inverse,
    matrix_at,
    minus,
    product,
    scaled,
    times,
    transposed,
    transposed_times,
)
from masonry.simd import any_lane, filled, where


@register_jitable
def principal_axes(axes, b, r):
    """The principal axes of block b now, in columns."""
    if axes is None:
        return r
    return product(r, matrix_at(axes, b))


@register_jitable
def over_inertia(q, inertia, momentum):
    """J^-1 momentum, with principal axes q."""
    x, y, z = transposed_times(q, momentum)
    return times(q, (x / inertia[0], y / inertia[1], z / inertia[2]))


@register_jitable
def inertia_now(q, inertia):
    """J."""
    i, j, k = inertia
    return product(
        (q[0] * i, q[1] * j, q[2] * k, q[3] * i, q[4] * j, q[5] * k, q[6] * i, q[7] * j, q[8] * k), transposed(q)
    )


@register_jitable
def free_axes(dt_over_mass):
    """1 for each axis that a block turns about freely, 0 where that is prescribed, of its three paces."""
    return (
        where(dt_over_mass[0] > 0.0, 1.0, 0.0),
        where(dt_over_mass[1] > 0.0, 1.0, 0.0),
        where(dt_over_mass[2] > 0.0, 1.0, 0.0),
    )


@register_jitable
def is_held(free):
    """Whether a block is held about some axis."""
    return free[0] + free[1] + free[2] < 3.0


@register_jitable
def chosen(condition, a, b):
    """Vector a where the condition holds, else b."""
    return where(condition, a[0], b[0]), where(condition, a[1], b[1]), where(condition, a[2], b[2])


@register_jitable
def held_spin(q, inertia, free, momentum, prescribed):
    """w: prescribed where not free, elsewhere such that J w has the given momentum."""
    j = inertia_now(q, inertia)
    x, y, z = free
    rows = (
        *(x * j[0] + (1.0 - x), x * j[1], x * j[2], y * j[3], y * j[4] + (1.0 - y), y * j[5]),
        *(z * j[6], z * j[7], z * j[8] + (1.0 - z)),
    )
    held = 1.0 - x, 1.0 - y, 1.0 - z
    return times(inverse(rows), added(each(free, momentum), each(held, prescribed)))


@register_jitable
def spin_of(q, inertia, free, momentum, prescribed):
    """Angular velocity w of a block."""
    w, held = over_inertia(q, inertia, momentum), is_held(free)
    if any_lane(held):
        w = chosen(held, held_spin(q, inertia, free, momentum, prescribed), w)
    return w


@register_jitable
def mean_spin(r, axes, b, inertia, free, momentum, w, dt):
    """w*: the angular velocity in the middle of the step, to second order."""
    change, held = over_inertia(principal_axes(axes, b, r), inertia, cross(momentum, w)), is_held(free)
    mean = added(w, scaled(0.5 * dt, change))
    if any_lane(held):
        now = held_spin(principal_axes(axes, b, r), inertia, free, momentum, w)
        half = product(exponential(scaled(0.5 * dt, now)), r)
        mean = chosen(held, held_spin(principal_axes(axes, b, half), inertia, free, momentum, w), mean)
    return mean


@register_jitable
def given_spin(q, inertia, free, momentum, w):
    """Less what w owes to prescribed turns about other axes; the kinetic energy of the free ones leaves that out."""
    zero, held = filled(0.0, w[0]), is_held(free)
    given = zero, zero, zero
    if any_lane(held):
        given = chosen(held, minus(held_spin(q, inertia, free, momentum, given), w), given)
    return given
