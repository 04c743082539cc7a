"""Which axis-parallel boxes overlap or touch, in time that grows nearly as their number."""

import numpy as np

from geometry.polyhedra.indexing import ranges

MOST_CELLS = 10_000
"""Of one box: one that covers more, as the floor under a tower does, is compared with all others instead."""


def overlapping_boxes(low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Pairs (N, 2), first < second, of the boxes low..high (B, D) that overlap or touch; sorted.

    Every box is entered in the cells of a regular grid that it covers; a pair is taken in one cell only, the lowest
    that both cover.
    """
    if len(low) == 0:
        return np.zeros((0, 2), dtype=np.int64)
    origin = low.min(axis=0)
    span = (high - origin).max(axis=0)
    size = np.maximum((high - low).mean(axis=0), span / len(low))
    size[size <= 0] = 1.0
    first = np.floor((low - origin) / size).astype(np.int64)
    covered = np.floor((high - origin) / size).astype(np.int64) - first + 1
    large = covered.astype(float).prod(axis=1) > MOST_CELLS
    if large.any():
        return _beside_large(low, high, large)
    box, number = ranges(np.zeros(len(low), dtype=np.int64), covered.prod(axis=1))
    cells = []
    key = np.zeros(len(box), dtype=np.int64)
    for axis in range(low.shape[1]):
        number, place = np.divmod(number, covered[box, axis])
        cells.append(first[box, axis] + place)
        key = key * (cells[axis].max() + 1) + cells[axis]
    order = np.argsort(key, kind="stable")
    box, key = box[order], key[order]
    end = np.flatnonzero(np.append(key[1:] != key[:-1], True)) + 1
    end = np.repeat(end, np.diff(end, prepend=0))
    pair_a, pair_b = ranges(np.arange(len(key)) + 1, end - np.arange(len(key)) - 1)
    for axis, cell in enumerate(cells):  # axis by axis: each leaves fewer pairs to look at
        i, j = box[pair_a], box[pair_b]
        begin, lowest, highest = (np.ascontiguousarray(values[:, axis]) for values in (first, low, high))
        overlap = cell[order[pair_a]] == np.maximum(begin[i], begin[j])
        overlap &= (lowest[i] <= highest[j]) & (lowest[j] <= highest[i])
        pair_a, pair_b = pair_a[overlap], pair_b[overlap]
    i, j = box[pair_a], box[pair_b]
    pair = np.sort(np.minimum(i, j) * len(low) + np.maximum(i, j))
    return np.stack(np.divmod(pair, len(low)), axis=1)


def _beside_large(low: np.ndarray, high: np.ndarray, large: np.ndarray) -> np.ndarray:
    """The same where some boxes (B,) are much larger than the others."""
    rest = np.flatnonzero(~large)
    pairs = [rest[overlapping_boxes(low[rest], high[rest])]]
    for k in np.flatnonzero(large):
        other = np.flatnonzero(((low <= high[k]) & (low[k] <= high)).all(axis=1) & (~large | (np.arange(len(low)) > k)))
        pairs.append(np.sort(np.column_stack([np.full(len(other), k), other]), axis=1))
    every = np.concatenate(pairs)
    return every[np.lexsort(every.T[::-1])]
