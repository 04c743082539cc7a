"""Where the elements of arrays lie."""

from numba.core import cgutils, types


def pointer_to(context, builder, kind, value, indices):
    """Where an element of an array lies; indices as typed values, never negative."""
    array = context.make_array(kind)(context, builder, value)
    words = [context.cast(builder, i, k, types.intp) for i, k in indices]
    return cgutils.get_item_pointer(context, builder, kind, array, words, wraparound=False)


def unpacked(builder, at, kind):
    """The indices of an index, with their types."""
    if isinstance(kind, types.BaseTuple):
        return list(zip(cgutils.unpack_tuple(builder, at), kind.types, strict=True))
    return [(at, kind)]
