"""Arrays that begin on a boundary of 64 bytes, so that eight doubles side by side are one line of the cache."""

import numpy as np


def aligned(values: np.ndarray) -> np.ndarray:
    """The same numbers, column after column."""
    room = np.zeros(values.size + 8)
    first = -(room.ctypes.data // 8) % 8
    result = room[first : first + values.size].reshape(values.shape, order="F")
    result[...] = values
    return result
