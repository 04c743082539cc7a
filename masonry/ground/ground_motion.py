"""One component of a motion of the ground: its acceleration is straight between samples, and it is integrated exactly.

Within a piece the velocity is a parabola and the displacement a cubic. Velocities and displacements that are given
become splines whose acceleration is continuous and straight between knots, so that all motions are of one kind; it may
begin and end at once, as that of an acceleration may.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

STRAIGHT = 1e-5
"""Of its peak: how far a formula may leave the straight lines between the samples that are taken of it."""
FIRST_PIECES, MOST_HALVINGS = 64, 20
"""Pieces in which a formula is looked at first; how often each may be halved."""
SETTLED = 1e-4
"""Of the peak acceleration: what twice as many samples may change in a spline through a formula."""
MISSED = 4.0
"""Times STRAIGHT, and SETTLED: how far a formula may be off at times that no period fits (LOOKS, FEW of them)."""
LOOKS, FEW = 2**17, 512
FOLLOWED = 1e-3
"""Of its largest value: how far a formula may be from the spline through it at LOOKS times."""
GOLDEN = 0.6180339887498949
MOST_PIECES, MOST_OF_SPLINES = 2**22, 2**21
"""128 MB of an acceleration; some seconds of a spline."""
SLOPE = (0.0,), (2.0, -0.5), (3.0, -1.5, 1.0 / 3.0)
"""Of a polynomial through the first two, three or four samples: weights of the second sample and those after it."""
CURVATURE = (0.0,), (4.0, -0.5), (6.0, -1.5, 2.0 / 9.0)
"""The same of one that begins without a slope."""
AT_REST = 1e-3
"""Of the peak: a velocity with which a record begins or ends below that is noise."""


@dataclass(frozen=True)
class Motion:
    """A motion along one axis, (n,) each: times (s, rising, from 0 on), and acceleration (m/s2), velocity (m/s) and
    displacement (m) at these. It is at rest before; after the end no acceleration is left."""

    time: np.ndarray
    acceleration: np.ndarray
    velocity: np.ndarray
    displacement: np.ndarray

    @property
    def duration(self) -> float:
        return float(self.time[-1])

    @property
    def peak_acceleration(self) -> float:
        """m/s2, the largest, in size; between samples it is no larger."""
        return float(np.abs(self.acceleration).max())

    @property
    def peak_velocity(self) -> float:
        """m/s, the largest in size: at a sample, or where the acceleration passes through 0 between two."""
        first, last = self.acceleration[:-1], self.acceleration[1:]
        crossing = first * last < 0.0
        fraction = first[crossing] / (first - last)[crossing]
        between = self.time[:-1][crossing] + fraction * np.diff(self.time)[crossing]
        return float(np.abs(np.concatenate([self.velocity, self.velocity_at(between)])).max())

    @property
    def peak_displacement(self) -> float:
        """m, the largest in size at a sample."""
        return float(np.abs(self.displacement).max())

    @property
    def residual_velocity(self) -> float:
        """m/s, with which the record ends."""
        return float(self.velocity[-1])

    @property
    def residual_displacement(self) -> float:
        """m, at the end of the record."""
        return float(self.displacement[-1])

    def acceleration_at(self, time: np.ndarray) -> np.ndarray:
        """(k,) m/s2 at times (k,) s; 0 before the start and after the end."""
        return np.asarray(np.interp(time, self.time, self.acceleration, left=0.0, right=0.0))

    def velocity_at(self, time: np.ndarray) -> np.ndarray:
        """(k,) m/s at times (k,) s; after the end the residual velocity."""
        k, since = self._piece(time)
        speed = self.velocity[k] + since * (self.acceleration[k] + 0.5 * self._slope(k) * since)
        return np.asarray(np.where(time < 0.0, 0.0, speed))

    def displacement_at(self, time: np.ndarray) -> np.ndarray:
        """(k,) m at times (k,) s; after the end it goes on at the residual velocity."""
        k, since = self._piece(time)
        by_acceleration = 0.5 * self.acceleration[k] + self._slope(k) * since / 6.0
        place = self.displacement[k] + since * (self.velocity[k] + since * by_acceleration)
        late = np.maximum(np.asarray(time) - self.duration, 0.0)
        return np.asarray(np.where(np.asarray(time) < 0.0, 0.0, place + self.residual_velocity * late))

    def _slope(self, k: np.ndarray) -> np.ndarray:
        """(k,) m/s3 of pieces (k,)."""
        rise = self.acceleration[k + 1] - self.acceleration[k]
        return np.asarray(rise / (self.time[k + 1] - self.time[k]))

    def _piece(self, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Number (k,) of the piece at times (k,), and the time (s) since it began; the end counts to the last."""
        within = np.clip(time, 0.0, self.duration)
        k = np.clip(np.searchsorted(self.time, within, side="right") - 1, 0, len(self.time) - 2)
        return k, within - self.time[k]

    def scaled(self, factor: float) -> "Motion":
        """So many times as large."""
        return replace(
            self,
            acceleration=factor * self.acceleration,
            velocity=factor * self.velocity,
            displacement=factor * self.displacement,
        )

    def with_linear_baseline(self) -> "Motion":
        """Less the acceleration c + d t that takes it back to rest where it began: no residual is left."""
        end, velocity, away = self.duration, self.residual_velocity, self.residual_displacement
        d = (6.0 * velocity * end - 12.0 * away) / end**3
        c = velocity / end - 0.5 * d * end
        t = self.time
        return Motion(
            t,
            self.acceleration - (c + d * t),
            self.velocity - t * (c + 0.5 * d * t),
            self.displacement - t * t * (0.5 * c + d * t / 6.0),
        )

    def over_steps(self, start: float, dt: float, steps: int) -> tuple[np.ndarray, np.ndarray]:
        """The mean acceleration (steps + 1,) m/s2 over each step, half of it before and half after times
        start + n dt; and those n, rising, between which it is straight.

        A leapfrog that is driven by these means has the exact velocity in the middle of every step.
        """
        t = start + dt * np.arange(steps + 1)
        mean = self.acceleration_at(t)
        bent = np.rint((self.time - start) / dt)
        bent = np.unique(bent[(bent >= 0) & (bent <= steps)]).astype(np.int64)
        at = t[bent]
        mean[bent] = (self.velocity_at(at + 0.5 * dt) - self.velocity_at(at - 0.5 * dt)) / dt
        knots = np.unique(np.concatenate([[0], bent - 1, bent, bent + 1, [steps]]))
        return mean, knots[(knots >= 0) & (knots <= steps)]


def from_acceleration(time: np.ndarray, acceleration: np.ndarray) -> Motion:
    """Straight between samples (n,): times from 0 on, s; m/s2."""
    step = np.diff(time)
    first, last = acceleration[:-1], acceleration[1:]
    gained = 0.5 * step * (first + last)
    velocity = np.concatenate([[0.0], np.cumsum(gained)])
    moved = step * velocity[:-1] + step**2 * (2.0 * first + last) / 6.0
    return Motion(time, acceleration, velocity, np.concatenate([[0.0], np.cumsum(moved)]))


def from_velocity(time: np.ndarray, velocity: np.ndarray, line: bool = False) -> Motion:
    """Parabolas through samples (n,) m/s that meet half-way between them, in equal steps; at both ends with the
    acceleration of the cubic through the four samples there.

    line  takes off the straight line through the first and the last sample
    Raises ValueError where the ground moves at its start or end.
    """
    velocity = _from_rest(time, velocity, line, "velocity", "m/s")
    knots = np.concatenate([[time[0]] * 3, 0.5 * (time[1:] + time[:-1]), [time[-1]] * 3])
    from scipy.interpolate import make_interp_spline

    ends = [_at_end(velocity, SLOPE), -_at_end(velocity[::-1], SLOPE)]
    begun, ended = ([(1, slope / (time[1] - time[0]))] for slope in ends)
    spline = make_interp_spline(time, velocity, k=2, t=knots, bc_type=(begun, ended))
    places = spline.antiderivative()
    at = np.concatenate([time[:1], knots[3:-3], time[-1:]])
    return Motion(at, spline(at, 1), spline(at), places(at) - places(at[0]))


def _at_end(values: np.ndarray, weights: tuple[tuple[float, ...], ...]) -> float:
    """A derivative at the first of a few samples, per sample, by as many weights as there are samples; 0 of two."""
    row = weights[min(len(values), 4) - 2]
    with np.errstate(over="ignore", invalid="ignore"):
        return float(sum(weight * (value - values[0]) for weight, value in zip(row, values[1:], strict=False)))


def from_displacement(time: np.ndarray, displacement: np.ndarray, line: bool = False, slowly: bool = False) -> Motion:
    """A cubic spline with continuous acceleration through samples (n,) m, less the first: without velocity at both
    ends, for which the first and the last piece are made of two, and with the acceleration of the polynomial
    through the four samples there.

    line    takes off the straight line through the first and the last sample
    slowly  without acceleration at both ends either; else steps are equal
    """
    displacement = displacement - displacement[0]
    if line:
        displacement = displacement - np.linspace(0.0, displacement[-1], len(time))
    if len(time) == 2:
        inner = time[0] + np.array([1.0, 2.0]) / 3.0 * (time[1] - time[0])
    else:
        halves = 0.5 * (time[:2] + time[1:3])[0], 0.5 * (time[-2] + time[-1])
        inner = np.concatenate([[halves[0]], time[1:-1], [halves[1]]])
    knots = np.concatenate([[time[0]] * 4, inner, [time[-1]] * 4])
    both = displacement, displacement[::-1]
    ends = [0.0 if slowly else _at_end(values, CURVATURE) / (time[1] - time[0]) ** 2 for values in both]
    begun, ended = ([(1, 0.0), (2, acceleration)] for acceleration in ends)
    from scipy.interpolate import make_interp_spline

    spline = make_interp_spline(time, displacement, k=3, t=knots, bc_type=(begun, ended))
    at = np.concatenate([time[:1], inner, time[-1:]])
    return Motion(at, spline(at, 2), spline(at, 1), spline(at))


MADE_OF: dict[str, Callable[[np.ndarray, np.ndarray], Motion]] = {
    "acceleration": from_acceleration,
    "velocity": from_velocity,
    "displacement": from_displacement,
}


def from_samples(quantity: str, time: np.ndarray, values: np.ndarray, baseline: str = "none") -> Motion:
    """Of samples of an "acceleration", "velocity" or "displacement"; times from 0 on, SI.

    baseline  "linear": no residual is left. Raises ValueError.
    """
    linear = baseline == "linear"
    if quantity == "acceleration":
        motion = from_acceleration(time, values)
        return motion.with_linear_baseline() if linear else motion
    return (from_velocity if quantity == "velocity" else from_displacement)(time, values, linear)


def from_formula(quantity: str, at: Callable[[np.ndarray], np.ndarray], duration: float) -> Motion:
    """Of a formula: values (k,) at times (k,) s, from 0 to `duration`. Raises ValueError."""
    at = _finite(at)
    if quantity == "acceleration":
        time = _bent_times(at, duration)
        return from_acceleration(time, at(time))
    _require_rest(quantity, at, duration)
    look = np.linspace(0.0, duration, 8 * FIRST_PIECES + 1)
    odd = duration * _golden(FEW)
    anywhere = duration * _golden(LOOKS)
    values = at(anywhere)
    peak = float(np.abs(values).max())
    pieces, before = 2 * FIRST_PIECES, None
    while pieces <= MOST_OF_SPLINES:
        time = np.linspace(0.0, duration, pieces + 1)
        samples = at(time)
        if np.abs(samples).max() >= 0.5 * peak:  # else a period fits the samples
            motion = MADE_OF[quantity](time, samples)
            now = motion.acceleration_at(look), motion.acceleration_at(odd)
            if before is not None:
                changed = [np.abs(new - old).max() for new, old in zip(now, before, strict=True)]
                settled = SETTLED * motion.peak_acceleration
                if changed[0] <= settled and changed[1] <= MISSED * settled:
                    made = motion.velocity_at if quantity == "velocity" else motion.displacement_at
                    if np.abs(made(anywhere) + samples[0] - values).max() <= FOLLOWED * peak:
                        return motion
            before = now
        pieces *= 2
    raise ValueError(
        f"the {quantity} jumps, has corners, or swings too often for {MOST_OF_SPLINES} pieces: its acceleration "
        "depends on their number; smooth it, shorten the duration, or give the acceleration"
    )


def _finite(at: Callable[[np.ndarray], np.ndarray]) -> Callable[[np.ndarray], np.ndarray]:
    """A formula that raises ValueError where it has no value."""

    def values(time: np.ndarray) -> np.ndarray:
        with np.errstate(all="ignore"):
            result = at(time)
        if not np.isfinite(result).all():
            raise ValueError(f"the expression has no finite value at t = {time[np.argmin(np.isfinite(result))]:.6g} s")
        return result

    return values


def _golden(count: int) -> np.ndarray:
    """(count,) places in (0, 1), spread evenly, which no period fits."""
    return (GOLDEN * np.arange(1, count + 1)) % 1.0


def _bent_times(at: Callable[[np.ndarray], np.ndarray], duration: float) -> np.ndarray:
    """Times between which a formula is straight, each piece halved until it is. Raises ValueError where they are too
    many."""
    time = np.linspace(0.0, duration, FIRST_PIECES + 1)
    peak = float(np.abs(at(np.linspace(0.0, duration, 4 * FIRST_PIECES * FIRST_PIECES + 1))).max())
    anywhere = duration * np.sort(_golden(LOOKS))
    values = at(anywhere)
    if np.abs(values).max() > 1.001 * peak:
        peak = float(np.abs(values).max())
    shortest = 1.01 * duration / FIRST_PIECES / 2**MOST_HALVINGS
    while True:
        value, step = at(time), np.diff(time)
        bent = np.zeros(len(step), dtype=bool)
        for fraction in (0.25, 0.5, 0.75):
            line = (1.0 - fraction) * value[:-1] + fraction * value[1:]
            bent |= np.abs(at(time[:-1] + fraction * step) - line) > STRAIGHT * peak
        bent &= step > shortest
        if not bent.any():
            missed = np.abs(np.interp(anywhere, time, value) - values) > MISSED * STRAIGHT * peak
            bent[np.searchsorted(time, anywhere[missed]) - 1] = True
            bent &= step > shortest
        if not bent.any():
            return time
        if len(time) + bent.sum() > MOST_PIECES + 1:
            raise ValueError(
                f"the acceleration swings too often for {MOST_PIECES} straight pieces, which follow it within "
                f"{STRAIGHT:g} of its peak; shorten the duration"
            )
        time = np.sort(np.concatenate([time, (0.5 * (time[:-1] + time[1:]))[bent]]))


def _require_rest(quantity: str, at: Callable[[np.ndarray], np.ndarray], duration: float) -> None:
    """ValueError where a formula of the displacement starts or ends with a velocity: no ground follows that at once."""
    if quantity != "displacement":
        return
    tiny = 1e-6 * duration
    times = np.array([0.0, tiny, duration - tiny, duration])
    place = at(times)
    over = (1.0 - 1e-6) * duration * _golden(FEW)
    peak_speed = float(np.abs(at(over + tiny) - at(over)).max()) / tiny
    for name, speed in (("starts", (place[1] - place[0]) / tiny), ("ends", (place[3] - place[2]) / tiny)):
        if abs(speed) > 1e-2 * peak_speed:
            raise ValueError(
                f"the displacement {name} with {speed:.3g} m/s, and the ground is at rest before and after; let it "
                f"rise and fall smoothly, or give its velocity or acceleration"
            )


def _from_rest(time: np.ndarray, values: np.ndarray, line: bool, what: str, unit: str) -> np.ndarray:
    """Values that begin and end at 0."""
    values = values - np.interp(time, time[[0, -1]], values[[0, -1]]) if line else values.copy()
    peak = float(np.abs(values).max())
    for k, name in ((0, "begins"), (-1, "ends")):
        if abs(values[k]) > AT_REST * peak:
            raise ValueError(
                f"the {what} {name} with {values[k]:.3g} {unit}, and the ground is at rest before and after; give a "
                f"record from rest to rest, or baseline = 'linear'"
            )
        values[k] = 0.0
    return values
