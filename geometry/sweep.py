"""Which axis-parallel boxes overlap or touch, in time that grows nearly as their number."""

import numpy as np

from geometry.ragged import ranges


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
    box, number = ranges(np.zeros(len(low), dtype=np.int64), covered.prod(axis=1))
    cell = np.empty((len(box), low.shape[1]), dtype=np.int64)
    key = np.zeros(len(box), dtype=np.int64)
    for axis in range(low.shape[1]):
        number, place = np.divmod(number, covered[box, axis])
        cell[:, axis] = first[box, axis] + place
        key = key * (cell[:, axis].max() + 1) + cell[:, axis]
    order = np.argsort(key, kind="stable")
    box, cell, key = box[order], cell[order], key[order]
    end = np.searchsorted(key, key, side="right")
    one, two = ranges(np.arange(len(key)) + 1, end - np.arange(len(key)) - 1)
    i, j = box[one], box[two]
    once = np.all(cell[one] == np.maximum(first[i], first[j]), axis=1)
    meet = np.all((low[i] <= high[j]) & (low[j] <= high[i]), axis=1)
    pairs = np.sort(np.stack([i, j], axis=1)[once & meet], axis=1)
    return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]
