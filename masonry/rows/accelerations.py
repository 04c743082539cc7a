"""Accelerations from displacements at rows that are equally spaced in time: as an accelerometer reads them.

With d the second difference of the displacement over the time T between rows, a = (d - (second difference of d) / 12) /
T^2. Here d / T^2 is the mean of the acceleration over both neighbouring intervals, weighted by a triangle: a filter
sinc^2(f T) that lets nothing through near f = 1/T, 2/T, ..., so that the vibration of contacts, far above, does not
come back as a slow motion. The second term makes it flat: 0.17 % too little at a tenth of the rate 1/T, 2.4 % at a
fifth, half of the power at 0.42 of it. There is no shift in phase. A jump of the velocity by dv shows as 7/6 dv / T at
the row at which it comes, with -1/12 dv / T beside.
"""

import numpy as np

BESIDE = 2
"""Rows on either side that an acceleration takes."""
ALIKE = 1e-6
"""Share by which steps in time may differ and count as equal."""


def regular(time: np.ndarray, begin: float) -> slice:
    """The rows from a time (s) on that are equally spaced, up to the last of them: a row at the end may come early."""
    first = int(np.searchsorted(time, begin - ALIKE * abs(begin)))
    apart = np.diff(time[first:])
    if not len(apart):
        return slice(first, len(time))
    other = np.flatnonzero(np.abs(apart - apart[0]) > ALIKE * apart[0])
    return slice(first, first + 1 + (int(other[0]) if len(other) else len(apart)))


def accelerations(time: np.ndarray, displacement: np.ndarray, begin: float) -> np.ndarray:
    """(n,) m/s2 at rows (n,) s, from displacements (n,) m. They are 0 before the time at which motion begins, as what
    settles does so by a damping of its own. The first two and the last two rows take the value next to them."""
    acceleration = np.zeros(len(time))
    rows = regular(time, begin)
    t, u = time[rows], displacement[rows]
    if len(t) <= 2:
        return acceleration
    second = np.diff(u, 2) / ((t[-1] - t[0]) / (len(t) - 1)) ** 2
    inner = second[1:-1] - np.diff(second, 2) / 12.0 if len(second) > 2 else second
    beside = (len(t) - len(inner)) // 2
    acceleration[rows] = np.pad(inner, (beside, len(t) - len(inner) - beside), mode="edge")
    acceleration[rows.stop :] = acceleration[rows.stop - 1]
    return acceleration
