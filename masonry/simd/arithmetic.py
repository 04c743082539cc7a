"""Lanes: a Numba type for 4 or 8 doubles side by side, which add, multiply and compare like one."""

import math
import operator
import os

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import lower_builtin, models, register_model

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


def spread(builder, value, kind, width):
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
        a, b = (spread(builder, value, kind, width) for value, kind in zip(args, sig.args, strict=True))
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


class _OfChoices(AbstractTemplate):
    def generic(self, args, kws):
        if all(isinstance(kind, Choice) for kind in args):
            return signature(args[0], *args)
        return None


for _operator, _instruction in ((operator.and_, "and_"), (operator.or_, "or_")):
    infer_global(_operator)(type(f"_{_instruction}", (_OfChoices,), {}))

    def _lower(context, builder, sig, args, instruction=_instruction):
        return getattr(builder, instruction)(*args)

    lower_builtin(_operator, Choice, Choice)(_lower)


@infer_global(operator.neg)
class _Negated(AbstractTemplate):
    def generic(self, args, kws):
        return signature(args[0], args[0]) if isinstance(args[0], Lanes) else None


@lower_builtin(operator.neg, Lanes)
def _negate(context, builder, sig, args):
    return builder.fneg(args[0])


def _by_llvm(function, name: str, count: int) -> None:
    """Let a function of `count` numbers work on lanes, by the function of LLVM with that name."""

    @infer_global(function)
    class _Typed(AbstractTemplate):
        def generic(self, args, kws):
            width = _width(args)
            return None if width is None or len(args) != count else signature(Lanes(width), *args)

    def lower(context, builder, sig, args):
        width = _width(sig.args)
        vectors = [spread(builder, value, kind, width) for value, kind in zip(args, sig.args, strict=True)]
        kind = vectors[0].type
        function_type = ir.FunctionType(kind, [kind] * count)
        named = cgutils.get_or_insert_function(builder.module, function_type, f"{name}.v{width}f64")
        return builder.call(named, vectors)

    numbers = (types.Float, types.Integer)
    pairs = ((Lanes, Lanes), *((Lanes, kind) for kind in numbers), *((kind, Lanes) for kind in numbers))
    for kinds in ((Lanes,),) if count == 1 else pairs:
        lower_builtin(function, *kinds)(lower)


_by_llvm(abs, "llvm.fabs", 1)
_by_llvm(math.sqrt, "llvm.sqrt", 1)
_by_llvm(math.sin, "llvm.sin", 1)
_by_llvm(math.cos, "llvm.cos", 1)
_by_llvm(operator.pow, "llvm.pow", 2)
