"""One lane after the other: what was written for single numbers, called once for each lane of its arguments."""

from collections.abc import Callable, Iterable
from functools import cache
from typing import Any

from llvmlite import ir
from numba.core import types
from numba.core.types.containers import BaseTuple
from numba.extending import intrinsic, register_jitable

from masonry.simd.arithmetic import WORD, Lanes
from masonry.simd.rows import pack


def width_in(kinds: Iterable[Any]) -> int | None:
    """How many lanes there are in some types, tuples among them; None where all are single numbers."""
    for kind in kinds:
        width = kind.width if isinstance(kind, Lanes) else None
        if isinstance(kind, BaseTuple):
            width = width_in(kind.types)
        if width is not None:
            return width
    return None


def single(kind: Any) -> Any:
    """The type of one lane: of lanes a number, of a tuple the tuple of these."""
    if isinstance(kind, Lanes):
        return types.float64
    if not isinstance(kind, BaseTuple):
        return kind
    return BaseTuple.from_types([single(one) for one in kind.types], getattr(kind, "instance_class", None))


def _extract(context, builder, kind, value, i):
    if isinstance(kind, Lanes):
        return builder.extract_element(value, ir.Constant(WORD, i))
    if not isinstance(kind, BaseTuple):
        return value
    parts = [_extract(context, builder, one, builder.extract_value(value, k), i) for k, one in enumerate(kind.types)]
    return context.make_tuple(builder, single(kind), parts)


def _lane(i: int) -> Any:
    @intrinsic
    def taken(context, values):
        return single(values)(values), lambda context, builder, sig, args: _extract(
            context, builder, values, args[0], i
        )

    return taken


_l0, _l1, _l2, _l3, _l4, _l5, _l6, _l7 = (_lane(i) for i in range(8))


@cache
def by_lane(function: Any, width: int) -> Callable[..., Any]:
    """A function of a tuple of arguments that calls another with single numbers, once for each of 4 or 8 lanes."""

    @register_jitable
    def eight(values):
        return pack(
            (
                float(function(*_l0(values))),
                float(function(*_l1(values))),
                float(function(*_l2(values))),
                float(function(*_l3(values))),
                float(function(*_l4(values))),
                float(function(*_l5(values))),
                float(function(*_l6(values))),
                float(function(*_l7(values))),
            )
        )

    @register_jitable
    def four(values):
        return pack(
            (
                float(function(*_l0(values))),
                float(function(*_l1(values))),
                float(function(*_l2(values))),
                float(function(*_l3(values))),
            )
        )

    return eight if width == 8 else four
