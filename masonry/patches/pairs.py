"""Pairs of convex pieces that are near to each other: one list of columns, and all that follows from it.

A column is one line of PatchPairs. From these lines come room for pairs, what a new pair is, its copies, and the names
in a checkpoint. All columns are views of one memory, so that a pair is copied whole, whatever its columns are.
"""

from math import prod
from typing import Annotated, NamedTuple, get_type_hints

import numpy as np

from masonry.jit.compiler import inner, jit

FAR = 1e30
"""m: farther than anything is, or moves."""


class Column:
    """Shape of a row, and what a new pair has there. Each is equal to itself alone: Python 3.11.2 takes equal
    annotations for one, as (), 0 and (), 0.0 are."""

    def __init__(self, shape: tuple[int, ...], new: float) -> None:
        self.shape, self.new = shape, new


class PatchPairs(NamedTuple):
    """Room for P pairs, sorted, of which the first ones are there.

    A column (P, ...) is Annotated[np.ndarray, Column(shape of its rows, what a new pair has there)]: a whole number
    makes one of whole numbers. Side 0 of a pair is the piece with the lower number.
    """

    number: np.ndarray  # (1,) how many pairs there are
    memory: np.ndarray  # numbers of all columns, one column after the other
    piece: Annotated[np.ndarray, Column((2,), 0)]  # numbers of the two pieces, the lower first
    body: Annotated[np.ndarray, Column((2,), 0)]  # their blocks
    slot: Annotated[np.ndarray, Column((), -1)]  # where its points are; -1 where the two are apart
    points_of: Annotated[np.ndarray, Column((), 0)]  # side that the points belong to; the other one is the reference
    normal: Annotated[
        np.ndarray, Column((3,), 0.0)
    ]  # of the plane, which is fixed in the reference, out of it, in its frame
    axis: Annotated[np.ndarray, Column((3,), 0.0)]  # the normal of the last look, from side 0 to side 1, in space
    witness: Annotated[np.ndarray, Column((3,), -1)]  # of that look: detection/narrow.py
    face: Annotated[np.ndarray, Column((2,), -1)]  # its two faces before that look, -1 for edges
    mark: Annotated[np.ndarray, Column((), -FAR)]  # m, travel of both blocks at the last look
    limit: Annotated[np.ndarray, Column((), 0.0)]  # m, that after which it is looked at again
    reach: Annotated[np.ndarray, Column((), 0.0)]  # m, how far they may move against each other until the next look
    pose: Annotated[np.ndarray, Column((12,), 0.0)]  # how they stood to each other at the last one: relative_motion.py
    law: Annotated[np.ndarray, Column((), 0)]  # row of Rules
    dashpot: Annotated[np.ndarray, Column((), 0.0)]  # Pa s/m
    slack: Annotated[
        np.ndarray, Column((), 0.0)
    ]  # m, by which points press less than they overlap, or more where below 0
    gained: Annotated[
        np.ndarray, Column((), 0.0)
    ]  # J, normal energy that the last look gave or took, until it is settled
    damped: Annotated[
        np.ndarray, Column((), 0.0)
    ]  # J, what its dashpot took since the two touch, less what it paid: slack.py


COLUMNS = {
    name: (hint.__metadata__[0].shape, hint.__metadata__[0].new)
    for name, hint in get_type_hints(PatchPairs, include_extras=True).items()
    if hasattr(hint, "__metadata__")
}
"""Shape of a row, and what a new pair has there, by column."""
WIDTH = np.array([prod(shape) for shape, _ in COLUMNS.values()])
FIRST = np.cumsum(WIDTH) - WIDTH
"""How many numbers of a pair a column holds, and how many are in the columns before it."""


def no_pairs(room: int) -> PatchPairs:
    """Room for so many pairs, and none in it."""
    memory = np.zeros(room * int(WIDTH.sum()), dtype=np.int64)
    columns: dict[str, np.ndarray] = {}
    for first, width, (name, (shape, new)) in zip(FIRST, WIDTH, COLUMNS.items(), strict=True):
        column = memory[room * first : room * (first + width)].view(np.int64 if isinstance(new, int) else np.float64)
        columns[name] = column.reshape(room, *shape)
        if new != 0:  # memory that is not written is not taken
            column[:] = new
    return PatchPairs(number=np.zeros(1, dtype=np.int64), memory=memory, **columns)


NEW = no_pairs(1).memory
"""The numbers of a pair of which nothing is known."""


@jit
def copy_pairs(source, target):
    """The target holds all pairs of the source; it has as much room, or more."""
    target.number[0] = source.number[0]
    for p in range(source.number[0]):
        copy_pair(source, p, target, p)


@inner
def copy_pair(source, p, target, q):
    """Row q of the target becomes row p of the source."""
    for c in range(len(WIDTH)):
        start, end = FIRST[c] * len(source.slot) + WIDTH[c] * p, FIRST[c] * len(target.slot) + WIDTH[c] * q
        for i in range(WIDTH[c]):
            target.memory[end + i] = source.memory[start + i]


@inner
def begin_pair(pairs, p, piece, other, body, other_body, law):
    """Row p becomes a pair of two pieces of which nothing else is known."""
    for c in range(len(WIDTH)):
        for i in range(WIDTH[c]):
            pairs.memory[FIRST[c] * len(pairs.slot) + WIDTH[c] * p + i] = NEW[FIRST[c] + i]
    pairs.piece[p, 0], pairs.piece[p, 1] = piece, other
    pairs.body[p, 0], pairs.body[p, 1] = body, other_body
    pairs.law[p] = law
