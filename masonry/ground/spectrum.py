"""Response spectra: the largest answer of damped oscillators to one acceleration that is straight between its samples.

The oscillator u'' + 2 zeta w u' + w^2 u = -a is one equation of first order in the complex number z = u' - l* u, with
l = w (-zeta + i sqrt(1 - zeta^2)): z' = l z - a. Over an interval in which a is straight it is solved exactly; that is
the recurrence of Nigam and Jennings (Bull. Seism. Soc. Am. 59(2), 1969, 909-922) in two real numbers.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

PER_PERIOD = 16
"""Intervals a period, at least: between two of them the cubic through u and u' is off by (2 pi / 16)^4 / 384 = 6e-5."""
ALIKE = 9
"""Digits, in mean steps, to which two steps of a record are one."""
NEAR = 0.95
"""The displacement of a sample beside the largest peak, in peaks, at least."""
MOST = 4_000_000
"""Complex numbers that are held at once."""


@dataclass(frozen=True)
class ResponseSpectrum:
    """The largest answer of oscillators of one damping ratio.

    periods       (n,) s
    displacement  (n,) m, the largest relative displacement: the spectral displacement
    damping       share of the critical damping
    """

    periods: np.ndarray
    displacement: np.ndarray
    damping: float

    @property
    def pseudo_velocity(self) -> np.ndarray:
        """(n,) m/s, w times the displacement."""
        return self.displacement * (2.0 * np.pi / self.periods)

    @property
    def pseudo_acceleration(self) -> np.ndarray:
        """(n,) m/s^2, w^2 times the displacement."""
        return self.displacement * (2.0 * np.pi / self.periods) ** 2

    @property
    def frequencies(self) -> np.ndarray:
        """(n,) Hz."""
        return 1.0 / self.periods


def response_spectrum(
    time: np.ndarray, acceleration: np.ndarray, periods: np.ndarray, damping: float = 0.05
) -> ResponseSpectrum:
    """The spectrum of one component of a motion that starts from rest; after its end the ground is not accelerated, and
    what the oscillators do then counts.

    time          (m,) s, growing, steps of any length
    acceleration  (m,) m/s^2 at these times, straight between them
    periods       (n,) s, above 0, of the undamped oscillators
    damping       share of the critical damping, in [0, 1)
    Raises ValueError where an argument is none of this.
    """
    return ResponseSpectrum(
        np.asarray(periods, dtype=float), np.abs(peaks(time, acceleration, periods, damping).displacement), damping
    )


class LargestSwings(NamedTuple):
    """When the displacement of each oscillator is largest, (n,) s, and what it is then, (n,) m, with its sign."""

    time: np.ndarray
    displacement: np.ndarray


def peaks(time: np.ndarray, acceleration: np.ndarray, periods: np.ndarray, damping: float = 0.05) -> LargestSwings:
    """As `response_spectrum`: the peaks themselves."""
    time, acceleration, periods = (np.asarray(each, dtype=float) for each in (time, acceleration, periods))
    _require(time, acceleration, periods, damping)
    largest = LargestSwings(np.zeros(periods.shape), np.zeros(periods.shape))
    parts = _divisions(np.diff(time).max(), periods)
    for part in np.unique(parts):
        members = np.flatnonzero(parts == part)
        fine = _refined(time, acceleration, int(part))
        few = max(1, MOST // len(fine[0]))
        for begin in range(0, len(members), few):
            group = members[begin : begin + few]
            largest.time[group], largest.displacement[group] = _peaks(*fine, 2.0 * np.pi / periods[group], damping)
    return largest


def periods_between(shortest: float, longest: float, count: int = 100) -> np.ndarray:
    """(count,) s, in equal ratios."""
    return np.geomspace(shortest, longest, count)


def oscillations(time: np.ndarray, acceleration: np.ndarray, rates: np.ndarray, damping: float) -> np.ndarray:
    """(m, n) the complex number z of each oscillator at each time; from it `displacements` and `velocities`.

    rates  (n,) rad/s, of the undamped oscillators
    """
    poles = _poles(rates, damping)
    steps = np.diff(time)
    distinct, kind = np.unique(np.round(steps / steps.mean(), ALIKE), return_inverse=True)
    x = poles * (distinct * steps.mean())[:, None]
    turn = np.exp(x)
    whole = np.expm1(x) / poles
    end = (np.expm1(x) - x) / (poles * x)
    pushes = (whole - end)[kind] * acceleration[:-1, None] + end[kind] * acceleration[1:, None]
    z = np.zeros((len(time), len(rates)), dtype=complex)
    for n, which in enumerate(kind):
        np.multiply(turn[which], z[n], out=z[n + 1])
        z[n + 1] -= pushes[n]
    return z


def displacements(z: np.ndarray, rates: np.ndarray, damping: float) -> np.ndarray:
    """Relative displacements (m) of oscillators, of the shape of z."""
    displacement: np.ndarray = z.imag / _poles(rates, damping).imag
    return displacement


def velocities(z: np.ndarray, rates: np.ndarray, damping: float) -> np.ndarray:
    """Relative velocities (m/s) of oscillators, of the shape of z."""
    velocity: np.ndarray = z.real - damping * rates * displacements(z, rates, damping)
    return velocity


def _poles(rates: np.ndarray, damping: float) -> np.ndarray:
    poles: np.ndarray = rates * complex(-damping, np.sqrt(1.0 - damping**2))
    return poles


def _require(time: np.ndarray, acceleration: np.ndarray, periods: np.ndarray, damping: float) -> None:
    if time.ndim != 1 or acceleration.shape != time.shape or len(time) < 2:
        raise ValueError("time and acceleration must be two rows of the same length, two samples or more")
    if not (np.isfinite(time).all() and np.isfinite(acceleration).all() and (np.diff(time) > 0.0).all()):
        raise ValueError("times must grow, and all numbers must be finite")
    if periods.ndim != 1 or not (np.isfinite(periods).all() and (periods > 0.0).all()):
        raise ValueError("periods must be a row of finite numbers above 0")
    if not 0.0 <= damping < 1.0:
        raise ValueError(f"damping {damping:g}: a share of the critical damping in [0, 1)")


def _divisions(longest_step: float, periods: np.ndarray) -> np.ndarray:
    """Into how many parts an interval is divided, a power of two, for each period."""
    needed = np.maximum(1.0, longest_step * PER_PERIOD / periods)
    parts: np.ndarray = 2 ** np.ceil(np.log2(needed)).astype(int)
    return parts


def _refined(time: np.ndarray, acceleration: np.ndarray, parts: int) -> tuple[np.ndarray, np.ndarray]:
    """The same straight lines with `parts` intervals in place of one."""
    if parts == 1:
        return time, acceleration
    places = np.arange((len(time) - 1) * parts + 1) / parts
    fine = np.interp(places, np.arange(len(time)), time)
    return fine, np.interp(fine, time, acceleration)


def _peaks(time: np.ndarray, acceleration: np.ndarray, rates: np.ndarray, damping: float) -> LargestSwings:
    z = oscillations(time, acceleration, rates, damping)
    u = displacements(z, rates, damping)
    size = np.abs(u)
    top = size.argmax(axis=0)
    every = np.arange(len(rates))
    largest = LargestSwings(time[top], u[top, every])
    near = size >= NEAR * size[top, every]
    row, column = np.nonzero(near[:-1] | near[1:])
    v, v_end = (velocities(z[at, column], rates[column], damping) for at in (row, row + 1))
    turns = v * v_end < 0.0
    row, column, length = row[turns], column[turns], time[row[turns] + 1] - time[row[turns]]
    place, inner = _turning_point(u[row, column], u[row + 1, column], v[turns] * length, v_end[turns] * length)
    _replace(largest, column, time[row] + place * length, inner)
    delay, later = _afterwards(z[-1], rates, damping)
    _replace(largest, every, time[-1] + delay, later)
    return largest


def _replace(largest: LargestSwings, column: np.ndarray, time: np.ndarray, displacement: np.ndarray) -> None:
    """Put displacements in the place of those that are less; several may be of one oscillator."""
    order = np.argsort(np.abs(displacement), kind="stable")  # of several the last one stays, the largest
    order = order[np.abs(displacement[order]) > np.abs(largest.displacement[column[order]])]
    largest.time[column[order]] = time[order]
    largest.displacement[column[order]] = displacement[order]


def _turning_point(u: np.ndarray, u_end: np.ndarray, v: np.ndarray, v_end: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where in [0, 1] the cubic turns through displacements and slopes at both ends, and its value there."""
    a, b = 2.0 * (u - u_end) + v + v_end, 3.0 * (u_end - u) - 2.0 * v - v_end
    root = np.sqrt(np.maximum(b * b - 3.0 * a * v, 0.0))
    low = -b - np.where(b >= 0.0, root, -root)  # the sum that does not cancel
    with np.errstate(divide="ignore", invalid="ignore"):
        first, second = low / (3.0 * a), v / low
    place = np.where((second >= 0.0) & (second <= 1.0), second, np.clip(np.nan_to_num(first), 0.0, 1.0))
    return place, u + place * (v + place * (b + place * a))


def _afterwards(z: np.ndarray, rates: np.ndarray, damping: float) -> tuple[np.ndarray, np.ndarray]:
    """The first peak of the free swing that starts from z, after what time: it turns where Re z = zeta w u."""
    poles = _poles(rates, damping)
    turning = np.arctan2(poles.imag, damping * rates)
    angle = np.mod(turning - np.angle(z), np.pi)
    swing = z * np.exp(poles / poles.imag * angle)
    return angle / poles.imag, displacements(swing, rates, damping)
