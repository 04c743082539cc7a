"""Eight rows of an array at once: array[eight_rows(b), i] are eight lanes, number i of row b and of the seven below it;
of an array of numbers array[eight_rows(b)].

So a formula that reads and writes array[b, i] serves one row or eight, by what b is. The last axis of the array has no
gaps, as `take` of lanes has it.
"""

import operator
from typing import NamedTuple

from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic

from masonry.jit.extending import overload
from masonry.simd.arithmetic import DOUBLE, PLAIN, WORD, Lanes
from masonry.simd.pointers import pointer_to, unpacked

WIDTH = 8


class Rows(NamedTuple):
    """Eight rows of an array, by the number of the first: in a tuple, as Numba would take a tuple of one integer for
    an index of its own, and which of the two comes first depends on what was compiled before.
    """

    first: tuple[int]


def eight_rows(first):
    """An index of row `first` and the seven below it; without lanes, of row `first` alone."""
    return first


@overload(eight_rows)
def _eight_rows(first):
    return (lambda first: first) if PLAIN else (lambda first: Rows((first,)))


def names_rows(at):
    """Whether an index of this type is or begins with eight rows."""
    return _is_rows(at) or (isinstance(at, types.BaseTuple) and _is_rows(at.types[0]))


def _is_rows(kind):
    return getattr(kind, "instance_class", None) is Rows


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
    (rows, _), *columns = [(at, at_kind)] if _is_rows(at_kind) else unpacked(builder, at, at_kind)
    first, last = builder.extract_value(rows, [0, 0]), columns[-1:]
    nothing = [(ir.Constant(WORD, 0), types.int32) for _ in last]
    on = [context.cast(builder, *column, types.intp) for column in last]
    for lane in range(WIDTH):
        row = builder.add(first, first.type(lane)), types.int64
        pointer = pointer_to(context, builder, kind, array, [row, *columns[:-1], *nothing])
        yield builder.gep(pointer, on) if on else pointer


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
