"""A rigid block that rocks on shaken ground: Housner's equation, integrated on its own, without the solver.

    th'' = -p^2 (s sin(alpha - s th) + a/g cos(alpha - s th)),  s = sign(th),  p^2 = 3 g/(4 R),  tan(alpha) = b/h

No small angles. It lifts off where |a| passes g tan(alpha), does not slide, and keeps a share of its spin, the
restitution, as it comes down and goes on about the other corner. scipy's solve_ivp takes steps by its error estimate,
none longer than one of the record, and locates each impact as an event.

Reference: Housner (1963), Bulletin of the Seismological Society of America 53, 403.
"""

from bisect import bisect_right
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

STILL = 1e-6
"""Spin, in p, after an impact below which the block has come to rest."""
TOLERANCE = 1e-8
FLAT = 0.5 * np.pi
"""Angle (rad) at which it lies."""


@dataclass(frozen=True)
class RockingBlock:
    """half_width and half_height (m), g (m/s^2), and the share of its spin that it keeps at an impact."""

    half_width: float
    half_height: float
    restitution: float
    g: float = 9.81

    @property
    def alpha(self) -> float:
        """rad, at which it stands on one corner in balance."""
        return float(np.arctan2(self.half_width, self.half_height))

    @property
    def p(self) -> float:
        """rad/s, its frequency parameter."""
        return float(np.sqrt(0.75 * self.g / np.hypot(self.half_width, self.half_height)))

    @property
    def of_housner(self) -> float:
        """The restitution if the impulse acts at the corner."""
        return float(1.0 - 1.5 * np.sin(self.alpha) ** 2)


@dataclass(frozen=True)
class Rocking:
    """Motion of a block: times (s) and angles (rad, towards +x positive) of all steps, times of its impacts."""

    time: np.ndarray
    angle: np.ndarray
    impacts: np.ndarray

    @property
    def overturned(self) -> bool:
        return bool(np.abs(self.angle[-1]) >= FLAT * (1.0 - 1e-9))

    @property
    def peak(self) -> float:
        """rad, the largest angle."""
        return float(np.abs(self.angle).max())


def rock(
    block: RockingBlock,
    time: np.ndarray,
    acceleration: np.ndarray,
    until: float,
    angle: float = 0.0,
    tolerance: float = TOLERANCE,
) -> Rocking:
    """The motion of a block from rest at `angle` until a time (s), or until it lies.

    time, acceleration  (m,) s and m/s^2 of the ground towards +x, straight between samples, none before and after
    """
    ground = _Ground(time, acceleration)
    times, angles, impacts = [0.0], [angle], []
    now, state = 0.0, np.array([angle, 0.0])
    while now < until:
        if state[0] == 0.0 and abs(state[1]) <= STILL * block.p:
            begin = ground.exceeds(block.g * np.tan(block.alpha), now)
            if begin is None or begin >= until:
                break
            side = -np.sign(ground.at(begin))
            now, state = begin, np.zeros(2)
        else:
            side = np.sign(state[0]) if state[0] != 0.0 else np.sign(state[1])
        swing = _swing(block, ground, (now, until), state, float(side), tolerance)
        times.extend(swing.t[1:])
        angles.extend(swing.y[0, 1:])
        now = float(swing.t[-1])
        if not swing.t_events[0].size:
            break
        impacts.append(now)
        state = np.array([0.0, block.restitution * swing.y[1, -1]])
    return Rocking(np.array([*times, until][: len(times) + 1]), np.array([*angles, angles[-1]]), np.array(impacts))


class _Ground:
    def __init__(self, time: np.ndarray, acceleration: np.ndarray) -> None:
        self.time, self.acceleration = time.tolist(), acceleration.tolist()
        self.step = float(np.diff(time).max())

    def at(self, t: float) -> float:
        """m/s^2 at a time."""
        k = bisect_right(self.time, t) - 1
        if k < 0 or k >= len(self.time) - 1:
            return self.acceleration[-1] if t == self.time[-1] else 0.0
        fraction = (t - self.time[k]) / (self.time[k + 1] - self.time[k])
        return (1.0 - fraction) * self.acceleration[k] + fraction * self.acceleration[k + 1]

    def exceeds(self, limit: float, since: float) -> float | None:
        """When its size is more than a limit first, from a time on."""
        if abs(self.at(since)) > limit:
            return since
        for k in range(max(0, bisect_right(self.time, since) - 1), len(self.time) - 1):
            first, last = self.acceleration[k], self.acceleration[k + 1]
            if abs(last) > limit:
                fraction = (np.sign(last) * limit - first) / (last - first)
                return max(since, self.time[k] + float(fraction) * (self.time[k + 1] - self.time[k]))
        return None


def _swing(
    block: RockingBlock, ground: _Ground, span: tuple[float, float], state: np.ndarray, side: float, tolerance: float
) -> Any:
    """About one corner, until the block comes down, lies, or time is over."""
    p2, alpha, g = block.p**2, block.alpha, block.g

    def rates(t: float, y: np.ndarray) -> tuple[float, float]:
        lean = alpha - side * y[0]
        return y[1], -p2 * (side * np.sin(lean) + ground.at(t) / g * np.cos(lean))

    def comes_down(t: float, y: np.ndarray) -> float:
        return float(side * y[0])

    def lies(t: float, y: np.ndarray) -> float:
        return float(side * y[0] - FLAT)

    comes_down.terminal = lies.terminal = True  # type: ignore[attr-defined]
    comes_down.direction = -1.0  # type: ignore[attr-defined]
    return solve_ivp(
        rates,
        span,
        state,
        events=(comes_down, lies),
        max_step=ground.step,
        rtol=tolerance,
        atol=(tolerance * alpha, tolerance * alpha * block.p),
    )
