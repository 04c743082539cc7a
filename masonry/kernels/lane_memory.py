"""Lanes from memory and back: in a row, from the nodes of eight tets, from a handful of numbers."""

from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic, overload

from masonry.kernels.lanes import DOUBLE, PLAIN, WORD, Lanes, filled

EIGHT, FOUR = (1, 1) if PLAIN else (8, 4)
"""Numbers that a kernel takes at a time: of eight tets or freedoms, and of a row of four."""


def _pointer(context, builder, kind, value, indices):
    """Where an element of an array lies; indices as typed values, never negative."""
    array = context.make_array(kind)(context, builder, value)
    words = [context.cast(builder, i, k, types.intp) for i, k in indices]
    return cgutils.get_item_pointer(context, builder, kind, array, words, wraparound=False)


def _unpacked(builder, at, kind):
    """The indices of an index, with their types."""
    if isinstance(kind, types.BaseTuple):
        return list(zip(cgutils.unpack_tuple(builder, at), kind.types, strict=True))
    return [(at, kind)]


def _load(builder, pointer, width):
    vector = ir.VectorType(DOUBLE, width)
    return builder.load(builder.bitcast(pointer, vector.as_pointer()), align=8)


def _store(builder, value, pointer):
    builder.store(value, builder.bitcast(pointer, value.type.as_pointer()), align=8)


@intrinsic
def take(context, array, at, like):
    """Numbers of an array from index `at` on, as many as `like` has; None where the array is absent."""
    if not isinstance(array, types.Array):
        return types.none(array, at, like), lambda context, builder, sig, args: context.get_dummy_value()

    def generate(context, builder, sig, args):
        pointer = _pointer(context, builder, array, args[0], _unpacked(builder, args[1], at))
        return _load(builder, pointer, like.width) if isinstance(like, Lanes) else builder.load(pointer)

    return (like if isinstance(like, Lanes) else array.dtype)(array, at, like), generate


@intrinsic
def put(context, array, at, value):
    """Write numbers into an array from index `at` on; nothing where it is absent."""
    if not isinstance(array, types.Array):
        return types.void(array, at, value), lambda context, builder, sig, args: context.get_dummy_value()

    def generate(context, builder, sig, args):
        pointer = _pointer(context, builder, array, args[0], _unpacked(builder, args[1], at))
        if isinstance(value, Lanes):
            _store(builder, args[2], pointer)
        else:
            builder.store(args[2], pointer)
        return context.get_dummy_value()

    return types.void(array, at, value), generate


def or_zero(value, like):
    """The value; zero where it is None, as many times as `like` has."""
    return filled(0.0, like) if value is None else value


@overload(or_zero)
def _or_zero(value, like):
    if isinstance(value, (Lanes, types.Float)):
        return lambda value, like: value
    return lambda value, like: filled(0.0, like)


def width_of(like):
    """How many numbers there are in one."""
    return 1


@overload(width_of)
def _width_of(like):
    width = like.width if isinstance(like, Lanes) else 1
    return lambda like: width


@intrinsic
def take_row(context, array, n):
    """Row n of an array, which holds x, y, z and has room for four: four lanes, or without lanes a tuple."""
    kind = types.UniTuple(types.float64, 4) if PLAIN else Lanes(4)

    def generate(context, builder, sig, args):
        pointers = _in_row(context, builder, array, args[0], (args[1], n))
        if not PLAIN:
            return _load(builder, pointers[0], 4)
        found = [*(builder.load(pointer) for pointer in pointers), DOUBLE(0.0)]
        return context.make_tuple(builder, kind, found)

    return kind(array, n), generate


@intrinsic
def put_row(context, array, n, row):
    """Write a row that `take_row` or `pack` made."""

    def generate(context, builder, sig, args):
        pointers = _in_row(context, builder, array, args[0], (args[1], n))
        if isinstance(row, Lanes):
            _store(builder, args[2], pointers[0])
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
    """What `pack` made, from number i on: the lanes themselves, or number i of the tuple."""
    return values[i]


@overload(part)
def _part(values, i):
    if isinstance(values, Lanes):
        return lambda values, i: values
    return lambda values, i: values[i]


def _zeros(width):
    """An intrinsic: zero in some lanes."""

    @intrinsic
    def zeros(context):
        constant = ir.Constant(ir.VectorType(DOUBLE, width), [0.0] * width)
        return Lanes(width)(), lambda context, builder, sig, args: constant

    return zeros


_zeros_of_eight, _zeros_of_four = _zeros(8), _zeros(4)


def eight():
    """Zero, in eight lanes."""
    return 0.0


def four():
    """Zero, in four lanes."""
    return 0.0


@overload(eight)
def _eight():
    return (lambda: 0.0) if PLAIN else (lambda: _zeros_of_eight())


@overload(four)
def _four():
    return (lambda: 0.0) if PLAIN else (lambda: _zeros_of_four())


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
    first = _pointer(context, builder, index_kind, index, _unpacked(builder, at, at_kind))
    for lane in range(8):
        row = builder.load(builder.gep(first, [ir.Constant(WORD, lane)])), index_kind.dtype
        yield _pointer(context, builder, array_kind, array, [row, zero])


def _columns(builder, pointers):
    """x, y, z of eight rows."""
    rows = [_load(builder, pointer, 4) for pointer in pointers]
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
    row = builder.load(_pointer(context, builder, index_kind, index, _unpacked(builder, at, at_kind)))
    return _in_row(context, builder, array_kind, array, (row, index_kind.dtype))


def _in_row(context, builder, array_kind, array, row):
    return [_pointer(context, builder, array_kind, array, [row, (WORD(i), types.int32)]) for i in range(3)]


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
            own = types.void(array, corner, parts)
            if isinstance(like, Lanes):
                found = _columns(builder, _rows(context, builder, own, [args[0], args[1], at]))
            else:
                found = [builder.load(p) for p in _row(context, builder, own, [args[0], args[1], at])]
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
            pointer = _pointer(context, builder, array, args[0], at)
            found.append(_load(builder, pointer, like.width) if isinstance(like, Lanes) else builder.load(pointer))
        return context.make_tuple(builder, sig.return_type, found)

    return types.UniTuple(kind, 9)(array, t, j, like), generate


@intrinsic
def scatter(context, array, index, at, x, y, z):
    """Add x, y, z to the rows that `gather` reads, one row after the other: it may be named twice."""

    def generate(context, builder, sig, args):
        if isinstance(x, Lanes):
            for pointer, row in zip(_rows(context, builder, sig, args), _as_rows(builder, args[3:]), strict=True):
                _store(builder, builder.fadd(_load(builder, pointer, 4), row), pointer)
        else:
            for pointer, value in zip(_row(context, builder, sig, args), args[3:], strict=True):
                builder.store(builder.fadd(builder.load(pointer), value), pointer)
        return context.get_dummy_value()

    return types.void(array, index, at, x, y, z), generate


@intrinsic
def put_rows(context, array, first, x, y, z):
    """Write x, y, z as the row `first` of an array; with lanes that and the seven rows after it."""

    def generate(context, builder, sig, args):
        start = context.cast(builder, args[1], first, types.intp)
        if isinstance(x, Lanes):
            for lane, row in enumerate(_as_rows(builder, args[2:])):
                at = builder.add(start, start.type(lane)), types.intp
                _store(builder, row, _pointer(context, builder, array, args[0], [at, (WORD(0), types.int32)]))
        else:
            pointers = _in_row(context, builder, array, args[0], (start, types.intp))
            for pointer, value in zip(pointers, args[2:], strict=True):
                builder.store(value, pointer)
        return context.get_dummy_value()

    return types.void(array, first, x, y, z), generate
