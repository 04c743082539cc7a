"""The dashpot that gives an impact of two blocks a restitution, in closed form; and what the step's length changes.

On a spring and a dashpot that cannot pull, zeta of critical, a block keeps e = exp(-(pi - 2 a) tan a) of its speed,
with sin a = zeta; beyond critical exp(-2 b / tanh b), with cosh b = zeta.
"""

from math import acosh, asin, exp, pi, tan, tanh

import numpy as np

PHASES, LENGTHS = 64, (0.1, 0.2, 0.4)
"""Places between two steps at which an impact begins; steps over those of 1 rad of the impact."""
HALVINGS, MOST_LENGTH = 30, 0.5
"""The last: of w dt, beyond which a step changes no more."""


def restitution_of(zeta: float) -> float:
    """Speed after over before, of an impact on a dashpot of zeta times the critical one."""
    if abs(zeta - 1.0) < 1e-9:
        return exp(-2.0)
    if zeta < 1.0:
        return exp(-(pi - 2.0 * asin(zeta)) * tan(asin(zeta)))
    return exp(-2.0 * acosh(zeta) / tanh(acosh(zeta)))


def share_of_critical(restitution: float) -> float:
    """The zeta that gives it."""
    low, high = 0.0, 1e3
    for _ in range(100):
        zeta = 0.5 * (low + high)
        low, high = (zeta, high) if restitution_of(zeta) > restitution else (low, zeta)
    return high


def further_share(restitution: float) -> np.ndarray:
    """(2,) by how much more of critical a dashpot needs in steps of w dt, over w dt and its square: it acts on
    velocities half a step old, and in the first step of an impact as long as the blocks touch."""
    zeta, lengths, shares = share_of_critical(restitution), [], []
    for length in LENGTHS:
        if length > 0.5 * (np.hypot(1.0, zeta) - zeta):
            continue
        low, high = 0.2 * zeta, 3.0 * zeta
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if in_steps(middle, length) > restitution else (low, middle)
        lengths.append(length)
        shares.append(high - zeta)
    if not lengths:
        return np.zeros(2)
    powers = np.column_stack([lengths, np.square(lengths)])
    return np.asarray(np.linalg.lstsq(powers, np.array(shares), rcond=None)[0])


def in_steps(zeta: float, length: float) -> float:
    """The mean restitution of impacts in steps of w dt = length, as patches/press.py takes them."""
    x, v = (np.arange(PHASES) + 0.5) / PHASES * length, -np.ones(PHASES)
    while True:
        before, x = x, x + length * v
        rate = (np.minimum(x, 0.0) - np.minimum(before, 0.0)) / length
        v = v + length * np.where(x < 0.0, np.maximum(-x - 2.0 * zeta * rate, 0.0), 0.0)
        if np.all((v > 0.0) & (x > 0.0)):
            return float(v.mean())
