"""A rigid block that slides on ground whose acceleration is straight between samples: exact, from event to event.

    u'' = -a - k+ while it slides forward, -a + k- while it slides back; it sticks while -k- <= -a <= k+

u is the slip against the ground, k+ and k- the accelerations at which it yields: mu g both ways on a level table.
In each interval the sliding velocity is a parabola, and the instant at which it comes to 0 a root of it.

Reference: Newmark (1965), Geotechnique 15, 139.
"""

from typing import NamedTuple

import numpy as np


class Slip(NamedTuple):
    """m: at the end, the least and the most."""

    end: float
    minimum: float
    maximum: float


def slide(time: np.ndarray, acceleration: np.ndarray, forward: float, back: float, after: float = 60.0) -> Slip:
    """The slip of a block at rest at first.

    time, acceleration  (n,) s and m/s2 of the ground, straight between samples, none behind the last
    forward, back       m/s2, at which it yields; `after` s after the end at most it comes to rest
    """
    time = np.concatenate([time, [time[-1] * (1 + 1e-15), time[-1] + after]])
    push = -np.concatenate([acceleration, [0.0, 0.0]])
    place = speed = 0.0
    minimum = maximum = 0.0
    for k in range(len(time) - 1):
        begin, duration, now = push[k], time[k + 1] - time[k], 0.0
        slope = (push[k + 1] - begin) / duration
        while now < duration:
            drive = begin + slope * now
            side = float(np.sign(speed)) or (1.0 if _yields(drive - forward, slope) else 0.0)
            side = side or (-1.0 if _yields(-drive - back, -slope) else 0.0)
            if side == 0.0:
                now = _begins(begin, slope, now, duration, forward, back)
                continue
            excess = drive - forward if side > 0.0 else drive + back
            lasts = _until_it_stops(speed, excess, slope, duration - now)
            place += lasts * (speed + lasts * (0.5 * excess + slope * lasts / 6.0))
            speed += lasts * (excess + 0.5 * slope * lasts)
            if lasts < duration - now:
                speed = 0.0
            now += lasts
            minimum, maximum = min(minimum, place), max(maximum, place)
    return Slip(place, minimum, maximum)


def _yields(excess: float, slope: float) -> bool:
    return excess > 0.0 or (excess == 0.0 and slope > 0.0)


def _begins(begin: float, slope: float, now: float, duration: float, forward: float, back: float) -> float:
    """When a block that sticks yields in an interval; its end where it does not."""
    if slope == 0.0:
        return duration
    at = ((forward if slope > 0.0 else -back) - begin) / slope
    return float(np.nextafter(at, np.inf)) if now < at < duration else duration


def _until_it_stops(speed: float, excess: float, slope: float, duration: float) -> float:
    """Time (s) until speed + excess t + slope t^2 / 2 comes back to 0, `duration` at most."""
    roots = np.roots([0.5 * slope, excess, speed]) if slope else np.array([-speed / excess]) if excess else np.zeros(0)
    real = roots[np.abs(np.imag(roots)) < 1e-14].real
    ahead = real[(real > 1e-13 * max(duration, 1.0)) & (real < duration)]
    return float(ahead.min()) if len(ahead) else duration
