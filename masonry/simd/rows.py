"""Rows of x, y, z with room for a fourth number, as four lanes: to and from arrays, tuples and sums; and arrays
that begin on a boundary of 64 bytes, so that eight doubles side by side are one line of the processor's cache."""

import numpy as np
from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic

from masonry.jit.extending import overload
from masonry.simd.arithmetic import DOUBLE, PLAIN, WORD, Lanes
from masonry.simd.load_store import load, store
from masonry.simd.pointers import pointer_to

BEHIND = 8
"""Zeros behind the last number (or row): eight at a time may be read, and rows written, past the last contact."""


def aligned(values: np.ndarray) -> np.ndarray:
    """The same numbers, column after column, with room behind them."""
    line = 64 // values.dtype.itemsize
    room = np.zeros(values.size + line + BEHIND, dtype=values.dtype)
    first = -(room.ctypes.data // values.dtype.itemsize) % line
    result = room[first : first + values.size].reshape(values.shape, order="F")
    result[...] = values
    return result


@intrinsic
def take_row(context, array, n):
    """Row n of an array, which holds x, y, z and has room for four: four lanes, or without lanes a tuple."""
    kind = types.UniTuple(types.float64, 4) if PLAIN else Lanes(4)

    def generate(context, builder, sig, args):
        pointers = in_row(context, builder, array, args[0], (args[1], n))
        if not PLAIN:
            return load(builder, pointers[0], 4)
        found = [*(builder.load(pointer) for pointer in pointers), DOUBLE(0.0)]
        return context.make_tuple(builder, kind, found)

    return kind(array, n), generate


@intrinsic
def put_row(context, array, n, row):
    """Write a row that `take_row` or `pack` made."""

    def generate(context, builder, sig, args):
        pointers = in_row(context, builder, array, args[0], (args[1], n))
        if isinstance(row, Lanes):
            store(builder, args[2], pointers[0])
        else:
            for i, pointer in enumerate(pointers):
                builder.store(builder.extract_value(args[2], i), pointer)
        return context.get_dummy_value()

    return types.void(array, n, row), generate


@intrinsic
def numbers(context, row):
    """The four numbers of a row, in a tuple."""
    if not isinstance(row, Lanes):
        return row(row), lambda context, builder, sig, args: args[0]

    def generate(context, builder, sig, args):
        found = [builder.extract_element(args[0], WORD(i)) for i in range(row.width)]
        return context.make_tuple(builder, sig.return_type, found)

    return types.UniTuple(types.float64, row.width)(row), generate


def plus(row, factor, other):
    """Row + factor * other, for rows of four."""
    return tuple(a + factor * b for a, b in zip(row, other, strict=True))


@overload(plus)
def _plus(row, factor, other):
    if isinstance(row, Lanes):
        return lambda row, factor, other: row + factor * other
    return lambda row, factor, other: (
        row[0] + factor * other[0],
        row[1] + factor * other[1],
        row[2] + factor * other[2],
        row[3] + factor * other[3],
    )


@intrinsic
def _pack_lanes(context, values):
    width = len(values)
    sig = Lanes(width)(values)

    def generate(context, builder, sig, args):
        vector = ir.Constant(ir.VectorType(DOUBLE, width), ir.Undefined)
        for i in range(width):
            vector = builder.insert_element(vector, builder.extract_value(args[0], i), ir.Constant(WORD, i))
        return vector

    return sig, generate


def pack(values):
    """Lanes of a tuple of 4 or 8 numbers; without lanes, the tuple."""
    return values


@overload(pack)
def _pack(values):
    if PLAIN:
        return lambda values: values
    return lambda values: _pack_lanes(values)


def part(values, i):
    """Result of `pack` from number i on: the lanes themselves, or number i of the tuple."""
    return values[i]


@overload(part)
def _part(values, i):
    if isinstance(values, Lanes):
        return lambda values, i: values
    return lambda values, i: values[i]


def in_row(context, builder, array_kind, array, row):
    """Pointers to x, y, z of a row."""
    return [pointer_to(context, builder, array_kind, array, [row, (WORD(i), types.int32)]) for i in range(3)]
