"""Several numbers at once: a Numba type for the processor's vectors, so that one formula serves one number or eight.

`Lanes` are 4 or 8 doubles that add, multiply and compare like one; `choose` takes the place of `if`. With
MASONRY_LANES=0 the functions of `lane_memory.py` hand out plain numbers one by one instead, and the same kernels,
compiled for numbers, do the same work.
"""

import math
import operator
import os

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin, models, overload, register_jitable, register_model

PLAIN = os.environ.get("MASONRY_LANES") == "0"
"""Whether kernels are compiled for single numbers."""
DOUBLE, WORD = ir.DoubleType(), ir.IntType(32)


class Lanes(types.Type):
    """Some doubles side by side."""

    def __init__(self, width: int) -> None:
        self.width = width
        super().__init__(f"Lanes({width})")


class Choice(types.Type):
    """True or false for each of some lanes."""

    def __init__(self, width: int) -> None:
        self.width = width
        super().__init__(f"Choice({width})")


@register_model(Lanes)
class _LanesModel(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, ir.VectorType(DOUBLE, kind.width))


@register_model(Choice)
class _ChoiceModel(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, ir.VectorType(ir.IntType(1), kind.width))


def _spread(builder, value, kind, width):
    """A number in every lane; lanes stay as they are."""
    if isinstance(kind, Lanes):
        return value
    if isinstance(kind, types.Integer):
        value = builder.sitofp(value, DOUBLE)
    vector = ir.Constant(ir.VectorType(DOUBLE, width), ir.Undefined)
    first = builder.insert_element(vector, value, ir.Constant(WORD, 0))
    return builder.shuffle_vector(first, vector, ir.Constant(ir.VectorType(WORD, width), [0] * width))


def _width(args) -> int | None:
    """Width of the lanes among some arguments; None where all are plain."""
    return next((kind.width for kind in args if isinstance(kind, Lanes)), None)


def _define(function, instruction: str, comparison: str | None = None) -> None:
    """Let an operator of Python work on lanes, and on lanes with a number."""

    @infer_global(function)
    class _Typed(AbstractTemplate):
        def generic(self, args, kws):
            width = _width(args)
            if len(args) != 2 or width is None:
                return None
            if not all(isinstance(kind, (Lanes, types.Float, types.Integer)) for kind in args):
                return None
            return signature(Lanes(width) if comparison is None else Choice(width), *args)

    def lower(context, builder, sig, args):
        width = _width(sig.args)
        a, b = (_spread(builder, value, kind, width) for value, kind in zip(args, sig.args, strict=True))
        if comparison is None:
            return getattr(builder, instruction)(a, b)
        return builder.fcmp_ordered(comparison, a, b)

    for a, b in ((Lanes, Lanes), (Lanes, types.Float), (types.Float, Lanes), (Lanes, types.Integer)):
        lower_builtin(function, a, b)(lower)
    lower_builtin(function, types.Integer, Lanes)(lower)


for _name, _instruction in (("add", "fadd"), ("sub", "fsub"), ("mul", "fmul"), ("truediv", "fdiv")):
    for _prefix in ("", "i"):
        _define(getattr(operator, _prefix + _name), _instruction)
for _function, _comparison in (
    (operator.lt, "<"), (operator.le, "<="), (operator.gt, ">"), (operator.ge, ">="), (operator.eq, "==")
):  # fmt: skip
    _define(_function, "fcmp_ordered", _comparison)


@infer_global(operator.and_)
class _Both(AbstractTemplate):
    def generic(self, args, kws):
        if all(isinstance(kind, Choice) for kind in args):
            return signature(args[0], *args)
        return None


@lower_builtin(operator.and_, Choice, Choice)
def _and(context, builder, sig, args):
    return builder.and_(*args)


@infer_global(operator.neg)
class _Negated(AbstractTemplate):
    def generic(self, args, kws):
        return signature(args[0], args[0]) if isinstance(args[0], Lanes) else None


@lower_builtin(operator.neg, Lanes)
def _negate(context, builder, sig, args):
    return builder.fneg(args[0])


@intrinsic
def _select(context, choice, a, b):
    width = choice.width
    sig = Lanes(width)(choice, a, b)

    def generate(context, builder, sig, args):
        either = [_spread(builder, v, k, width) for v, k in zip(args[1:], sig.args[1:], strict=True)]
        return builder.select(args[0], *either)

    return sig, generate


@intrinsic
def _fill(context, number, like):
    def generate(context, builder, sig, args):
        return _spread(builder, args[0], types.float64, like.width)

    return like(types.float64, like), generate


def filled(number, like):
    """A number, as many times as `like` has."""
    return number


@overload(filled)
def _filled(number, like):
    if isinstance(like, Lanes):
        return lambda number, like: _fill(number, like)
    return lambda number, like: number


def choose(condition, a, b):
    """Lane by lane: a where the condition holds, else b."""
    return a if condition else b


@overload(choose)
def _choose(condition, a, b):
    if isinstance(condition, Choice):
        return lambda condition, a, b: _select(condition, a, b)
    return lambda condition, a, b: a if condition else b


def _by_llvm(function, name: str, count: int) -> None:
    """Let a function of `count` numbers work on lanes, by the function of LLVM with that name."""

    @infer_global(function)
    class _Typed(AbstractTemplate):
        def generic(self, args, kws):
            width = _width(args)
            return None if width is None or len(args) != count else signature(Lanes(width), *args)

    def lower(context, builder, sig, args):
        width = _width(sig.args)
        vectors = [_spread(builder, value, kind, width) for value, kind in zip(args, sig.args, strict=True)]
        kind = vectors[0].type
        function_type = ir.FunctionType(kind, [kind] * count)
        named = cgutils.get_or_insert_function(builder.module, function_type, f"{name}.v{width}f64")
        return builder.call(named, vectors)

    for kinds in ((Lanes,),) if count == 1 else ((Lanes, Lanes), (Lanes, types.Float), (Lanes, types.Integer)):
        lower_builtin(function, *kinds)(lower)


_by_llvm(abs, "llvm.fabs", 1)
_by_llvm(math.sqrt, "llvm.sqrt", 1)
_by_llvm(operator.pow, "llvm.pow", 2)


@intrinsic
def _all_lanes(context, choice):
    def generate(context, builder, sig, args):
        bits = builder.bitcast(args[0], ir.IntType(choice.width))
        return builder.icmp_unsigned("==", bits, bits.type((1 << choice.width) - 1))

    return types.boolean(choice), generate


@intrinsic
def _any_lane(context, choice):
    def generate(context, builder, sig, args):
        bits = builder.bitcast(args[0], ir.IntType(choice.width))
        return builder.icmp_unsigned("!=", bits, bits.type(0))

    return types.boolean(choice), generate


def some(condition):
    """Whether a condition holds in any lane."""
    return condition


def every(condition):
    """Whether a condition holds in all lanes."""
    return condition


@overload(some)
def _some(condition):
    if isinstance(condition, Choice):
        return lambda condition: _any_lane(condition)
    return lambda condition: condition


@overload(every)
def _every(condition):
    if isinstance(condition, Choice):
        return lambda condition: _all_lanes(condition)
    return lambda condition: condition


@register_jitable
def larger(a, b):
    """The larger of two, lane by lane."""
    return choose(a > b, a, b)


@register_jitable
def smaller(a, b):
    """The smaller of two, lane by lane."""
    return choose(a < b, a, b)


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
