"""Eight rows of an array at once: array[eight_rows(b), i] are eight lanes, number i of row b and of the seven below it.

So a formula that reads and writes array[b, i] serves one row or eight, by what b is. The last axis of the array has no
gaps, as `take` of lanes has it.
"""

import operator
from typing import NamedTuple

from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic, overload

from masonry.simd.arithmetic import DOUBLE, PLAIN, WORD, Lanes
from masonry.simd.pointers import pointer_to, unpacked

WIDTH = 8


class Rows(NamedTuple):
    """Eight rows of an array, by the number of the first."""

    first: int


def eight_rows(first):
    """An index of row `first` and the seven below it; without lanes, of row `first` alone."""
    return first


@overload(eight_rows)
def _eight_rows(first):
    return (lambda first: first) if PLAIN else (lambda first: Rows(first))


def names_rows(at) -> bool:
    """Whether an index of this type begins with eight rows."""
    return isinstance(at, types.BaseTuple) and getattr(at.types[0], "instance_class", None) is Rows


def load_column(context, builder, kind, array, at_kind, at):
    """A number of each of eight rows."""
    found = ir.Constant(ir.VectorType(DOUBLE, WIDTH), ir.Undefined)
    for lane, pointer in enumerate(_pointers(context, builder, kind, array, at_kind, at)):
        found = builder.insert_element(found, builder.load(pointer), WORD(lane))
    return found


def store_column(context, builder, kind, array, at_kind, at, value):
    """Write a number into each of eight rows."""
    for lane, pointer in enumerate(_pointers(context, builder, kind, array, at_kind, at)):
        builder.store(builder.extract_element(value, WORD(lane)), pointer)


def _pointers(context, builder, kind, array, at_kind, at):
    """Where the numbers lie."""
    (rows, _), *middle, (last, last_kind) = unpacked(builder, at, at_kind)
    first, nothing = builder.extract_value(rows, 0), (ir.Constant(WORD, 0), types.int32)
    column = context.cast(builder, last, last_kind, types.intp)
    for lane in range(WIDTH):
        row = builder.add(first, first.type(lane)), types.int64
        yield builder.gep(pointer_to(context, builder, kind, array, [row, *middle, nothing]), [column])


@intrinsic
def _take_column(context, array, at):
    def generate(context, builder, sig, args):
        return load_column(context, builder, array, args[0], at, args[1])

    return Lanes(WIDTH)(array, at), generate


@intrinsic
def _put_column(context, array, at, value):
    def generate(context, builder, sig, args):
        store_column(context, builder, array, args[0], at, *args[1:])
        return context.get_dummy_value()

    return types.void(array, at, value), generate


@overload(operator.getitem)
def _read(array, at):
    if isinstance(array, types.Array) and names_rows(at):
        return lambda array, at: _take_column(array, at)
    return None


@overload(operator.setitem)
def _write(array, at, value):
    if isinstance(array, types.Array) and names_rows(at) and isinstance(value, Lanes):
        return lambda array, at, value: _put_column(array, at, value)
    return None
