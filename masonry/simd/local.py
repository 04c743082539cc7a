"""The parameters of one contact, or of eight, from those of its group.

A group of contacts has its parameters in a NamedTuple. One that differs from contact to contact is an array in it.
`local` makes the NamedTuple of the same class that the formulas read; numbers and None are handed on, so that a tuple
without arrays costs nothing.
"""

from numba.core import types
from numba.extending import intrinsic

from masonry.simd.arithmetic import Lanes
from masonry.simd.load_store import load, pointer_to


@intrinsic
def local(context, parameters, at, like):
    """The parameters (NamedTuple) of the contact `at` of their group, and of those after it as many as `like` has."""
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
