"""Records: the arguments of a compiled function as one piece of memory, so that all such functions have one signature.

A record holds a number of eight bytes for each float, integer and address; an array has its address, its shape and its
strides there; what is None has nothing. The TYPE of a record says what is in it: compiled code takes its arguments out
by `unpack`, as if they had been handed over one by one, and calls other such functions by `call`.
"""

import struct
from collections.abc import Iterator
from typing import Any

import numba
import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.core.datamodel import models
from numba.extending import intrinsic, register_model

WORD = ir.IntType(64)


class RecordKind(types.Type):
    """The Numba type of a record with these arguments (a type of tuples); its value is the address."""

    def __init__(self, arguments: Any) -> None:
        self.arguments = arguments
        super().__init__(f"Record({arguments})")


@register_model(RecordKind)
class _Address(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, WORD)


def kind_of(*arguments: Any) -> RecordKind:
    """The type of a record with such arguments."""
    return RecordKind(_with_strides(numba.typeof(arguments), arguments))


def _with_strides(kind: Any, value: Any) -> Any:
    """The same type, but of rows with room behind their numbers also where there is one row alone: numpy takes it for
    one piece, and one block would have other parts than many."""
    if isinstance(kind, types.BaseTuple):  # type: ignore[attr-defined]
        inner = [_with_strides(member, part) for member, part in zip(kind, value, strict=True)]
        return types.BaseTuple.from_types(inner, getattr(kind, "instance_class", None))  # type: ignore[attr-defined]
    rows = isinstance(kind, types.Array) and kind.layout == "C" and value.ndim > 1
    apart = rows and value.strides[0] != value.itemsize * int(np.prod(value.shape[1:]))
    return kind.copy(layout="A") if apart else kind


class ArgumentRecord:
    """Arguments in one piece of memory, whose arrays it keeps alive."""

    def __init__(self, kind: RecordKind, arguments: tuple[Any, ...]) -> None:
        self.kind, self.arguments = kind, list(arguments)
        words = [[*_words(inner, part)] for inner, part in zip(kind.arguments, arguments, strict=True)]
        self.bounds = np.cumsum([0, *map(len, words)])
        self.words = np.array([word for of_one in words for word in of_one], dtype=np.int64)
        self.address = self.words.ctypes.data

    def put(self, k: int, value: Any) -> None:
        """Another value of the same kind in place of argument number k; the record stays where it is."""
        self.arguments[k] = value
        self.words[self.bounds[k] : self.bounds[k + 1]] = [*_words(self.kind.arguments[k], value)]


def _words(kind: Any, value: Any) -> Iterator[int]:
    if isinstance(kind, types.BaseTuple):  # type: ignore[attr-defined]
        for inner, part in zip(kind, value, strict=True):
            yield from _words(inner, part)
    elif isinstance(kind, types.Array):
        yield from (value.ctypes.data, *value.shape, *value.strides)
    elif isinstance(kind, types.Float) and kind.bitwidth == 64:
        yield from struct.unpack("q", struct.pack("d", value))
    elif isinstance(kind, (types.Integer, types.Boolean)):
        yield int(value)
    elif not isinstance(kind, types.NoneType):  # type: ignore[attr-defined]
        raise TypeError(f"a record has no room for {kind}")


@intrinsic
def unpack(context, record):
    """The arguments in a record, in a tuple."""
    kind = record.arguments

    def generate(context, builder, sig, args):
        words = _Words(builder, args[0])
        return words.take(context, kind)

    return kind(record), generate


class _Words:
    """The words of a record, taken one after the other."""

    def __init__(self, builder, address):
        self.builder, self.next = builder, 0
        self.begin = builder.inttoptr(address, WORD.as_pointer())

    def word(self):
        place = self.builder.gep(self.begin, [ir.Constant(WORD, self.next)])
        self.next += 1
        return self.builder.load(place)

    def take(self, context, kind):
        builder = self.builder
        if isinstance(kind, types.BaseTuple):
            return context.make_tuple(builder, kind, [self.take(context, inner) for inner in kind])
        if isinstance(kind, types.Array):
            array = context.make_array(kind)(context, builder)
            data = builder.inttoptr(self.word(), array.data.type)
            shape, strides = [self.word() for _ in range(kind.ndim)], [self.word() for _ in range(kind.ndim)]
            from numba.np.arrayobj import populate_array  # tools of compiling, which a run that loads needs not

            size = ir.Constant(WORD, np.dtype(str(kind.dtype)).itemsize)
            populate_array(array, data, shape, strides, size, meminfo=None)
            return array._getvalue()
        if isinstance(kind, types.Float):
            return builder.bitcast(self.word(), ir.DoubleType())
        if isinstance(kind, (types.Integer, types.Boolean)):
            value, word_type = self.word(), context.get_value_type(kind)
            return value if word_type == WORD else builder.trunc(value, word_type)
        return context.get_dummy_value()


@intrinsic
def call(context, function, record):
    """Call a compiled function of one record, both by their addresses."""
    sig = types.void(types.intp, types.intp)

    def generate(context, builder, sig, args):
        convention, signature = context.call_conv, (types.intp,)
        pointer = convention.get_function_type(types.none, signature).as_pointer()
        function = builder.inttoptr(args[0], pointer)
        status, _ = convention.call_function(builder, function, types.none, signature, [args[1]])
        with cgutils.if_unlikely(builder, status.is_error):
            convention.return_status_propagate(builder, status)
        return context.get_dummy_value()

    return sig, generate
