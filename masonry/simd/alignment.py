"""Arrays that begin on a boundary of 64 bytes, so that eight doubles side by side are one line of the cache."""

import numpy as np

BEHIND = 8
"""Zeros behind the last number (or row): eight at a time may be read, and rows written, past the last contact."""


def aligned(values: np.ndarray) -> np.ndarray:
    """The same numbers, column after column, with room behind them."""
    line = 64 // values.dtype.itemsize
    room = np.zeros(values.size + line + BEHIND, dtype=values.dtype)
    first = -(room.ctypes.data // values.dtype.itemsize) % line
    result = room[first : first + values.size].reshape(values.shape, order="F")
    result[...] = values
    return result
