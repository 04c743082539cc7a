"""A record matched to a response spectrum in the time domain, by wavelets at the times at which oscillators peak.

Lilhanand and Tseng (9th World Conf. Earthquake Eng., 1988), with the tapered cosines of Al Atik and Abrahamson
(Earthquake Spectra 26(3), 2010, 601-617). The changes of all peaks are linear in the sizes of all wavelets: one system
of equations a round. A peak may jump to another time, so that it takes some rounds.
"""

import numpy as np

from masonry.ground.resting import at_rest
from masonry.ground.spectrum import peaks

ROUNDS, STEP, RIDGE = 20, 0.7, 0.1
"""How often; the share of what is missing that a round adds; the ridge under the equations, which keeps wavelets of
near periods from working against each other, as a share of what one does at its own period."""


def match(
    time: np.ndarray,
    acceleration: np.ndarray,
    envelope: np.ndarray,
    periods: np.ndarray,
    target: np.ndarray,
    damping: float,
    enough: float,
) -> np.ndarray:
    """The first record whose spectrum is off by less than the share `enough`, or the best one.

    time, acceleration, envelope  (m,) s, m/s^2, 1
    periods, target               (n,) s, pseudo-accelerations in m/s^2
    """
    rates = 2.0 * np.pi / periods
    best, minimum = acceleration, np.inf
    for _ in range(ROUNDS):
        times, displacement = peaks(time, acceleration, periods, damping)
        response = rates**2 * np.abs(displacement)
        error = float(np.abs(response / target - 1.0).max())
        if error < minimum:
            best, minimum = acceleration, error
        if error < enough:
            break
        signs = np.sign(displacement)
        wavelets = _wavelets(time, times, rates, damping, envelope) * signs
        changes = (_answers(time, times, rates, damping) * signs[:, None]) @ wavelets
        damped = changes.T @ changes + (RIDGE * np.abs(np.diag(changes)).mean()) ** 2 * np.eye(len(periods))
        sizes = np.linalg.solve(damped, changes.T @ (target - response))
        acceleration = at_rest(time, acceleration + STEP * wavelets @ sizes, envelope)
    return best


def _wavelets(
    time: np.ndarray, times: np.ndarray, rates: np.ndarray, damping: float, envelope: np.ndarray
) -> np.ndarray:
    """(m, n) tapered cosines that reach their oscillators' peaks at the `times` (n,)."""
    root = np.sqrt(1.0 - damping**2)
    late = time[:, None] - times + np.arctan2(root, damping) / (rates * root)
    width = 1.178 * (rates / (2.0 * np.pi)) ** -0.93
    wavelets: np.ndarray = np.cos(rates * root * late) * np.exp(-((late / width) ** 2))
    wavelets *= np.minimum(1.0, 20.0 * envelope)[:, None]
    return wavelets


def _answers(time: np.ndarray, times: np.ndarray, rates: np.ndarray, damping: float) -> np.ndarray:
    """(n, m) what a unit of acceleration at each time adds to each oscillator's pseudo-acceleration at its peak."""
    step, root = time[1] - time[0], np.sqrt(1.0 - damping**2)
    before = np.maximum(0.0, times[:, None] - time)
    swing = np.exp(-damping * rates[:, None] * before) * np.sin(root * rates[:, None] * before)
    answers: np.ndarray = -step * rates[:, None] / root * swing
    return answers
