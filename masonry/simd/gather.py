"""Eight rows of x, y, z, wherever they lie, as three times eight lanes, and back."""

from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic

from masonry.simd.arithmetic import DOUBLE, WORD, Lanes
from masonry.simd.load_store import load, store
from masonry.simd.pointers import pointer_to, unpacked
from masonry.simd.rows import in_row


def _shuffle(builder, a, b, order):
    return builder.shuffle_vector(a, b, ir.Constant(ir.VectorType(WORD, len(order)), order))


def _transpose(builder, rows):
    """Four rows of four numbers as four columns."""
    even = [_shuffle(builder, rows[i], rows[i + 1], [0, 4, 2, 6]) for i in (0, 2)]
    odd = [_shuffle(builder, rows[i], rows[i + 1], [1, 5, 3, 7]) for i in (0, 2)]
    low, high = [0, 1, 4, 5], [2, 3, 6, 7]
    return [_shuffle(builder, *pair, order) for order in (low, high) for pair in (even, odd)]


def _rows(context, builder, sig, args):
    """Pointers to eight rows of an array whose rows have room for four; index[at] and the seven beside it name them."""
    (array, index, at), (array_kind, index_kind, at_kind) = args[:3], sig.args[:3]
    zero = ir.Constant(WORD, 0), types.int32
    first = pointer_to(context, builder, index_kind, index, unpacked(builder, at, at_kind))
    for lane in range(8):
        row = builder.load(builder.gep(first, [ir.Constant(WORD, lane)])), index_kind.dtype
        yield pointer_to(context, builder, array_kind, array, [row, zero])


def _columns(builder, pointers):
    """x, y, z of eight rows."""
    rows = [load(builder, pointer, 4) for pointer in pointers]
    halves = _transpose(builder, rows[:4]), _transpose(builder, rows[4:])
    return [_shuffle(builder, halves[0][i], halves[1][i], list(range(8))) for i in range(3)]


def _as_rows(builder, columns):
    """Eight rows (x, y, z, 0)."""
    nothing = ir.Constant(ir.VectorType(DOUBLE, 4), [0.0] * 4)
    for first in (0, 4):
        part = [_shuffle(builder, v, v, list(range(first, first + 4))) for v in columns]
        yield from _transpose(builder, [*part, nothing])


def _row(context, builder, sig, args):
    """Pointers to x, y, z of the row index[at] of an array."""
    (array, index, at), (array_kind, index_kind, at_kind) = args[:3], sig.args[:3]
    row = builder.load(pointer_to(context, builder, index_kind, index, unpacked(builder, at, at_kind)))
    return in_row(context, builder, array_kind, array, (row, index_kind.dtype))


@intrinsic
def gather(context, array, index, at, like):
    """x, y, z of the row index[at] of an array; with lanes of that and the seven rows named beside it.

    Rows of the array have room for four numbers.
    """
    kind = like if isinstance(like, Lanes) else types.float64

    def generate(context, builder, sig, args):
        if isinstance(like, Lanes):
            found = _columns(builder, _rows(context, builder, sig, args))
        else:
            found = [builder.load(pointer) for pointer in _row(context, builder, sig, args)]
        return context.make_tuple(builder, sig.return_type, found)

    return types.UniTuple(kind, 3)(array, index, at, like), generate


@intrinsic
def gather_corners(context, array, corner, t, j, like):
    """x, y, z of the four rows corner[t, 0..3, j] of an array: of the tets j.. of group t, as many as `like` has."""
    point = types.UniTuple(like if isinstance(like, Lanes) else types.float64, 3)

    def generate(context, builder, sig, args):
        points = []
        for k in range(4):
            at = context.make_tuple(builder, types.UniTuple(types.int64, 3), _places(context, builder, sig, args, k))
            parts = types.UniTuple(types.int64, 3)
            signature = types.void(array, corner, parts)
            if isinstance(like, Lanes):
                found = _columns(builder, _rows(context, builder, signature, [args[0], args[1], at]))
            else:
                found = [builder.load(p) for p in _row(context, builder, signature, [args[0], args[1], at])]
            points.append(context.make_tuple(builder, point, found))
        return context.make_tuple(builder, sig.return_type, points)

    return types.UniTuple(point, 4)(array, corner, t, j, like), generate


def _places(context, builder, sig, args, k):
    t, j = (context.cast(builder, args[i], sig.args[i], types.int64) for i in (2, 3))
    return [t, t.type(k), j]


@intrinsic
def take_slopes(context, array, t, j, like):
    """The nine numbers array[t, 0..8, j] of the tets j.. of group t."""
    kind = like if isinstance(like, Lanes) else types.float64

    def generate(context, builder, sig, args):
        found = []
        for k in range(9):
            at = (args[1], t), (WORD(k), types.int32), (args[2], j)
            pointer = pointer_to(context, builder, array, args[0], at)
            found.append(load(builder, pointer, like.width) if isinstance(like, Lanes) else builder.load(pointer))
        return context.make_tuple(builder, sig.return_type, found)

    return types.UniTuple(kind, 9)(array, t, j, like), generate


@intrinsic
def scatter(context, array, index, at, x, y, z):
    """Add x, y, z to the rows that `gather` reads, one row after the other: it may be named twice."""

    def generate(context, builder, sig, args):
        if isinstance(x, Lanes):
            for pointer, row in zip(_rows(context, builder, sig, args), _as_rows(builder, args[3:]), strict=True):
                store(builder, builder.fadd(load(builder, pointer, 4), row), pointer)
        else:
            for pointer, value in zip(_row(context, builder, sig, args), args[3:], strict=True):
                builder.store(builder.fadd(builder.load(pointer), value), pointer)
        return context.get_dummy_value()

    return types.void(array, index, at, x, y, z), generate


@intrinsic
def put_rows(context, array, first, number, x, y, z):
    """Write x, y, z as the row `first` of an array; with lanes that and the rows after it, eight or the first `number`
    of them: what lies behind is not touched."""

    def generate(context, builder, sig, args):
        start, many = (context.cast(builder, args[i], sig.args[i], types.intp) for i in (1, 2))
        if isinstance(x, Lanes):
            for lane, row in enumerate(_as_rows(builder, args[3:])):
                at = builder.add(start, start.type(lane)), types.intp
                with builder.if_then(builder.icmp_signed(">", many, many.type(lane)), likely=True):
                    store(builder, row, pointer_to(context, builder, array, args[0], [at, (WORD(0), types.int32)]))
        else:
            pointers = in_row(context, builder, array, args[0], (start, types.intp))
            for pointer, value in zip(pointers, args[3:], strict=True):
                builder.store(value, pointer)
        return context.get_dummy_value()

    return types.void(array, first, number, x, y, z), generate
