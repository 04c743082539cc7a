"""Lanes from arrays and back, and zero in lanes; the same for single numbers."""

from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic

from masonry.jit.extending import overload
from masonry.simd.arithmetic import DOUBLE, PLAIN, WORD, Lanes
from masonry.simd.eight_rows import load_column, names_rows, store_column
from masonry.simd.pointers import pointer_to, unpacked
from masonry.simd.select import filled

EIGHT, FOUR = (1, 1) if PLAIN else (8, 4)
"""Numbers that a kernel takes at a time: of eight tets or dofs, and of a row of four."""


def load(builder, pointer, width):
    """So many numbers from a pointer on."""
    vector = ir.VectorType(DOUBLE, width)
    return builder.load(builder.bitcast(pointer, vector.as_pointer()), align=8)


def store(builder, value, pointer):
    """Write lanes from a pointer on."""
    builder.store(value, builder.bitcast(pointer, value.type.as_pointer()), align=8)


@intrinsic
def take(context, array, at, like):
    """Numbers of an array from index `at` on, as many as `like` has; None where the array is absent."""
    if not isinstance(array, types.Array):
        return types.none(array, at, like), lambda context, builder, sig, args: context.get_dummy_value()

    def generate(context, builder, sig, args):
        if names_rows(at):
            return load_column(context, builder, array, args[0], at, args[1])
        pointer = pointer_to(context, builder, array, args[0], unpacked(builder, args[1], at))
        return load(builder, pointer, like.width) if isinstance(like, Lanes) else builder.load(pointer)

    return (like if isinstance(like, Lanes) else array.dtype)(array, at, like), generate


@intrinsic
def put(context, array, at, value):
    """Write numbers into an array from index `at` on; nothing where it is absent."""
    if not isinstance(array, types.Array):
        return types.void(array, at, value), lambda context, builder, sig, args: context.get_dummy_value()

    def generate(context, builder, sig, args):
        if names_rows(at):
            store_column(context, builder, array, args[0], at, args[1], args[2])
            return context.get_dummy_value()
        pointer = pointer_to(context, builder, array, args[0], unpacked(builder, args[1], at))
        if isinstance(value, Lanes):
            store(builder, args[2], pointer)
        else:
            builder.store(args[2], pointer)
        return context.get_dummy_value()

    return types.void(array, at, value), generate


@intrinsic
def put_where(context, which, array, at, value):
    """`put`, but for lanes where `which` does not hold: what the array holds there is not touched."""
    sig = types.void(which, array, at, value)
    if not isinstance(array, types.Array):
        return sig, lambda context, builder, sig, args: context.get_dummy_value()

    def generate(context, builder, sig, args):
        pointer = pointer_to(context, builder, array, args[1], unpacked(builder, args[2], at))
        if isinstance(value, Lanes):
            _store_where(builder, args[0], args[3], pointer)
        else:
            with builder.if_then(args[0]):
                builder.store(args[3], pointer)
        return context.get_dummy_value()

    return sig, generate


def _store_where(builder, which, value, pointer):
    vector, width = value.type, value.type.count
    kinds = [vector, vector.as_pointer(), WORD, which.type]
    name = f"llvm.masked.store.v{width}f64.p0"
    masked = cgutils.get_or_insert_function(builder.module, ir.FunctionType(ir.VoidType(), kinds), name)
    builder.call(masked, [value, builder.bitcast(pointer, vector.as_pointer()), WORD(8), which])


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


@intrinsic
def local(context, parameters, at, like):
    """The parameters (NamedTuple) of the contact `at` of their group, and of those after it as many as `like` has.

    One that differs from contact to contact is an array in the tuple of the group; numbers and None are handed on, so
    that a tuple without arrays costs nothing.
    """
    there = [like if isinstance(kind, types.Array) else kind for kind in parameters.types]
    found = types.BaseTuple.from_types(there, parameters.instance_class)

    def generate(context, builder, sig, args):
        if not any(isinstance(kind, types.Array) for kind in parameters.types):
            return args[0]
        taken = []
        for i, kind in enumerate(parameters.types):
            value = builder.extract_value(args[0], i)
            if isinstance(kind, types.Array):
                pointer = pointer_to(context, builder, kind, value, [(args[1], at)])
                value = load(builder, pointer, like.width) if isinstance(like, Lanes) else builder.load(pointer)
            taken.append(value)
        return context.make_tuple(builder, found, taken)

    return found(parameters, at, like), generate
