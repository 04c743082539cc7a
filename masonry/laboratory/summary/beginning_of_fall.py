"""When a fall began, told from the steady motion with which a specimen follows its drive."""

import numpy as np

STILL_FRACTION = 1e-4
"""Of the kinetic energy when the first block has fallen: with less, the fall has not begun."""
STEADY = 1.2
"""Times the kinetic energy that is usual at this speed of the drive: what has no more follows the drive, and does not
fall. It is usual to within a few per cent where supports are drawn apart steadily."""
ROWS = 50
"""The last rows before, by which it is told what is usual."""
FASTER = 2.0
"""Times the speed that is no steady motion any more: by when that is there the way back to the beginning is told."""


def usual(rows: dict[str, np.ndarray]) -> np.ndarray:
    """(n,) J, the kinetic energy that is usual at each row: the median of the last rows at which the drive moved, in
    proportion to the square of its speed; 0 while it rests."""
    speed = np.diff(rows["displacement"], prepend=rows["displacement"][0])
    speed /= np.maximum(np.diff(rows["time"], prepend=rows["time"][0]), 1e-300)
    moving = np.flatnonzero(np.abs(speed) > 1e-9 * np.abs(speed).max(initial=0.0))
    per_square = rows["kinetic"][moving] / speed[moving] ** 2
    energy = np.zeros(len(speed))
    for k, row in enumerate(moving):
        energy[row] = np.median(per_square[max(k + 1 - ROWS, 0) : k + 1]) * speed[row] ** 2
    return energy


def beginning(rows: dict[str, np.ndarray], fallen: int) -> tuple[int | None, float]:
    """The last row before one at which a block has fallen at which nothing moved but steadily: None without one, that
    row itself where nothing moves but steadily even then. And the time (s) at which the fall began, from how it
    gained speed from there.

    The speed of what begins to fall grows with the square of the time: a push that grows steadily, with the load or the
    drive, acts on it, and it had no speed. So the root of the speed, less what is steady, is a straight line.
    """
    kinetic, time = rows["kinetic"][: fallen + 1], rows["time"]
    steady = usual(rows)[: fallen + 1]
    least = np.maximum(STILL_FRACTION * kinetic[-1], STEADY * steady)
    still = np.flatnonzero(kinetic[:-1] < least[:-1])
    if 0.0 < kinetic[-1] <= STEADY * steady[-1]:
        return fallen, float(time[fallen])
    if not len(still):
        return None, 0.0
    last = int(still[-1])
    excess = np.sqrt(np.maximum(kinetic - steady, 0.0))
    faster = np.flatnonzero(excess[last + 1 :] >= FASTER * excess[last + 1])
    then = last + 1 + int(faster[0]) if len(faster) else fallen
    first, second = np.sqrt(excess[[last + 1, then]])
    if second <= first:
        return last, float(time[last])
    return last, float(time[last + 1] - first * (time[then] - time[last + 1]) / (second - first))
