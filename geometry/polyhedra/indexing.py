"""Index arrays for lists of different lengths, without Python loops."""

import numpy as np


def ranges(start: np.ndarray, count: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Owner i and index of every entry of the ranges start[i] .. start[i] + count[i] - 1, one after another."""
    owner = np.repeat(np.arange(len(count)), count)
    before = np.cumsum(count) - count
    return owner, np.arange(len(owner)) - before[owner] + np.asarray(start)[owner]


def following(start: np.ndarray) -> np.ndarray:
    """(c,) of the entries of rings, which begin at start (n + 1,): where the next one of the same ring is."""
    after = np.arange(1, int(start[-1]) + 1)
    after[start[1:] - 1] = start[:-1]
    return after
