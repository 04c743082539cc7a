"""Lane by lane: this or that, the larger and the smaller; over the lanes: whether some or all hold, and the sum."""

from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic

from masonry.jit.extending import overload, register_jitable
from masonry.simd.arithmetic import WORD, Choice, Lanes, spread


@intrinsic
def _select(context, choice, a, b):
    width = choice.width
    sig = Lanes(width)(choice, a, b)

    def generate(context, builder, sig, args):
        either = [spread(builder, v, k, width) for v, k in zip(args[1:], sig.args[1:], strict=True)]
        return builder.select(args[0], *either)

    return sig, generate


@intrinsic
def _fill(context, number, like):
    def generate(context, builder, sig, args):
        return spread(builder, args[0], types.float64, like.width)

    return like(types.float64, like), generate


def filled(number, like):
    """A number, as many times as `like` has; lanes are so already."""
    return number


@overload(filled)
def _filled(number, like):
    if isinstance(like, Lanes) and not isinstance(number, Lanes):
        return lambda number, like: _fill(number, like)
    return lambda number, like: number


def where(condition, a, b):
    """Lane by lane: a where the condition holds, else b."""
    return a if condition else b


@overload(where)
def _choose(condition, a, b):
    if isinstance(condition, Choice):
        return lambda condition, a, b: _select(condition, a, b)
    return lambda condition, a, b: a if condition else b


@intrinsic
def _lanes_below(context, count, like):
    width = like.width
    sig = Choice(width)(types.int64, like)

    def generate(context, builder, sig, args):
        vector = ir.VectorType(ir.IntType(64), width)
        lane = builder.insert_element(ir.Constant(vector, ir.Undefined), args[0], WORD(0))
        counts = builder.shuffle_vector(lane, lane, ir.Constant(ir.VectorType(WORD, width), [0] * width))
        return builder.icmp_signed("<", ir.Constant(vector, list(range(width))), counts)

    return sig, generate


def below(count, like):
    """Which lanes come before number `count`; one number is always there."""
    return True


@overload(below)
def _below(count, like):
    if isinstance(like, Lanes):
        return lambda count, like: _lanes_below(count, like)
    return lambda count, like: True


@intrinsic
def _and_not(context, choice, other):
    return choice(choice, other), lambda context, builder, sig, args: builder.and_(args[0], builder.not_(args[1]))


def unless(condition, other):
    """Where the one holds and the other does not; the other may be one truth for all lanes."""
    return condition and not other


@overload(unless)
def _unless(condition, other):
    if isinstance(condition, Choice) and isinstance(other, Choice):
        return lambda condition, other: _and_not(condition, other)
    if isinstance(condition, Choice):
        return lambda condition, other: False if other else any_lane(condition)
    return lambda condition, other: condition and not other


@intrinsic
def _any_lane(context, choice):
    def generate(context, builder, sig, args):
        bits = builder.bitcast(args[0], ir.IntType(choice.width))
        return builder.icmp_unsigned("!=", bits, bits.type(0))

    return types.boolean(choice), generate


def any_lane(condition):
    """Whether a condition holds in any lane."""
    return condition


@overload(any_lane)
def _any_lane_of(condition):
    if isinstance(condition, Choice):
        return lambda condition: _any_lane(condition)
    return lambda condition: condition


@register_jitable
def maximum(a, b):
    """The larger of two, lane by lane."""
    return where(a > b, a, b)


@register_jitable
def minimum(a, b):
    """The smaller of two, lane by lane."""
    return where(a < b, a, b)


@intrinsic
def _sum_of_lanes(context, value):
    """Pairwise, always in the same order."""

    def generate(context, builder, sig, args):
        vector, width = args[0], value.width
        while width > 1:
            width //= 2
            low, high = (
                builder.shuffle_vector(
                    vector, vector, ir.Constant(ir.VectorType(WORD, width), [first + i for i in range(width)])
                )
                for first in (0, width)
            )
            vector = builder.fadd(low, high)
        return builder.extract_element(vector, ir.Constant(WORD, 0))

    return types.float64(value), generate


def total(value):
    """Sum over the lanes; a number is its own."""
    return value


@overload(total)
def _total(value):
    if isinstance(value, Lanes):
        return lambda value: _sum_of_lanes(value)
    return lambda value: value
