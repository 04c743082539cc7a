"""Which pairs a block is part of: lists that are made where a look asks for them, so that it need not ask all pairs."""

from masonry.jit.compiler import inner


@inner
def list_pairs(pairs, search):
    """A list of pairs for each block, rising, unless they are listed: `first_pair` has the first one of a block,
    `next_pair` the next one of either block of each; -1 behind the last."""
    if search.listed[0]:
        return
    search.first_pair[:] = -1
    for p in range(pairs.number[0] - 1, -1, -1):
        for side in range(2):
            block = pairs.body[p, side]
            search.next_pair[p, side] = search.first_pair[block]
            search.first_pair[block] = p
    search.listed[0] = True


@inner
def next_pair(pairs, search, p, block):
    """The pair behind pair p in the list of a block."""
    return search.next_pair[p, 0 if pairs.body[p, 0] == block else 1]
