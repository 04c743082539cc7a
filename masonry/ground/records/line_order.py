"""Is a table of numbers one record that goes on from line to line, or records beside each other? By its own steps.

A motion of the ground is smooth beside its samples: one that goes on from line to line changes little from number to
number, and much down its columns; records beside each other change much from column to column. In one record the step
from number to number is as large everywhere in a line, and from its end to the next line.
"""

import numpy as np

ONE_RECORD, BESIDE = 1.5, 0.67
"""Change down the columns over that from number to number: one record above, records beside each other below. Noise
has 1; one record of width w that is smooth has w."""
UNEVEN = 0.5
"""The smallest step over the largest one, by their places in a line: of one record at least. Records that are alike
have small steps in a line, and a large one at its end."""
SAME = 1e-3
"""Of the steps of times: how far they may be apart."""


def goes_on_from_line_to_line(values: np.ndarray) -> bool | None:
    """Whether rows (n, w) are one record; None where it may be either.

    A column of times decides for columns.
    """
    steps = np.diff(values, axis=0)
    if len(values) < 2 or _has_times(steps):
        return False
    flat = np.abs(np.diff(values.ravel()))
    total = flat.sum()
    if total == 0.0:
        return False
    change = np.abs(steps).sum() / total
    if change < BESIDE:
        return False
    ends = np.append(flat, np.nan).reshape(values.shape)
    by_place = np.nanmean(ends, axis=0)
    if by_place.min() < UNEVEN * by_place.max():
        return None if change < ONE_RECORD else False
    return True if change > ONE_RECORD else None


def _has_times(steps: np.ndarray) -> bool:
    """Whether a column rises in equal steps."""
    rises = (steps > 0.0).all(axis=0) & (np.ptp(steps, axis=0) <= SAME * np.abs(steps).max(axis=0))
    return bool(rises.any())
