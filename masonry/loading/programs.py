"""Programs, step by step: dead loads that rise, and drives at a rate, in steps, or from place to place."""

from math import ceil

import numpy as np

from masonry.errors import SceneError
from masonry.loading.scheduled import Program

FASTEST = 1.875
"""The greatest slope of the quintic passage between two turning points, over its mean."""
STILL = 1e-12
"""Of the farthest place: a drive that moves by less in a step stands still."""
MOST_STEPS = 100_000_000


def smooth(x: np.ndarray) -> np.ndarray:
    """Quintic rise from 0 to 1 over [0, 1] with zero slope and curvature at both ends."""
    x = np.clip(x, 0.0, 1.0)
    return x**3 * (10.0 + x * (6.0 * x - 15.0))


def rise(settle: int, steps: int) -> np.ndarray:
    """Share of the dead loads at each step 0..n: they rise over the first half of `settle`, if there is one."""
    return smooth(np.arange(steps + 1) / (0.5 * settle)) if settle else np.zeros(steps + 1)


def require_few(steps: float, dt: float, where: str = "drive", advice: str = "") -> None:
    """SceneError where a program, that of a key of the scene, would take more steps than anybody waits for."""
    if steps > MOST_STEPS:
        raise SceneError(
            f"{where}: this would take {steps:.2g} steps of {dt:.3g} s; at most {MOST_STEPS:.0e} are allowed: "
            f"{advice or 'raise drive.rate, or give drive.steps'}"
        )


def program(dt: float, settle: int, displacement: float, steps: int | None, rate: float | None, ramp: float) -> Program:
    """Dead loads rise over the first half of `settle`; then the drive makes exactly `displacement` (m, signed).

    Either the number of steps or the rate (m/s) after the ramp is given; the ramp takes a share of the steps.
    """
    if displacement == 0.0:
        count = 0
    elif steps is not None:
        count = steps
    else:
        assert rate is not None
        count = max(1, ceil(min(abs(displacement) / (rate * dt * (1.0 - 0.5 * ramp)), 1e18)))
    if count and settle == 0:
        count = max(count, 2)  # the first step starts at rest and cannot move anything
    require_few(settle + count, dt)
    k = np.arange(settle + count + 1)
    shape: np.ndarray = np.where(
        k < settle, 0.0, smooth((k - settle + 0.5) / (ramp * count)) if ramp * count > 0 else 1.0
    )
    shape[[0, -1]] = 0.0  # the first step starts at rest; what is set after the last step moves nothing
    speed = shape * (displacement / (dt * shape.sum())) if count else np.zeros(len(k))
    return Program(rise(settle, settle + count), speed, settle, int(np.ceil(ramp * count)))


def followed(dt: float, settle: int, places: np.ndarray, varying: np.ndarray | None = None) -> Program:
    """Dead loads rise over the first half of `settle`; then the drive comes to places (n,) m, signed, one a step.

    varying  (H, settle + n + 1) share of each varying load, at each step
    The first step starts at rest and moves nothing, so `places` begins with 0.
    """
    count = len(places)
    speed = np.zeros(settle + count + 1)
    speed[settle + 1 : -1] = np.diff(places) / dt
    return Program(rise(settle, settle + count), speed, settle, 0, varying, settle + 1 + landmarks(places))


def landmarks(places: np.ndarray) -> np.ndarray:
    """Which of places (n,) rows must not miss: those where the drive turns, and both between which it crosses its
    start. Changes that are rounding count for nothing."""
    made = np.diff(places)
    moving = np.flatnonzero(np.abs(made) > STILL * float(np.abs(places).max()))
    reversal = np.flatnonzero(made[moving[1:]] * made[moving[:-1]] < 0.0)
    crossed = np.flatnonzero((places[1:] > 0.0) != (places[:-1] > 0.0))
    return np.unique(np.concatenate([moving[reversal + 1], moving[reversal] + 1, crossed, crossed + 1]))


def passage(reversals: tuple[float, ...], steps: int) -> np.ndarray:
    """(steps,) m: from 0 through the turning points, at rest at each, by quintics; steps shared out by the lengths."""
    stops = np.array([0.0, *reversals])
    lengths = np.abs(np.diff(stops))
    at = np.round(np.concatenate([[0.0], np.cumsum(lengths)]) / lengths.sum() * (steps - 1))
    if np.any(np.diff(at) < 1.0):
        raise SceneError(
            f"drive: {steps} steps are too few for {len(reversals)} turning points; give more, or a lower rate"
        )
    k = np.arange(steps)
    leg = np.minimum(np.searchsorted(at, k, side="right"), len(lengths)) - 1
    fraction = smooth((k - at[leg]) / (at[leg + 1] - at[leg]))
    places: np.ndarray = (1.0 - fraction) * stops[leg] + fraction * stops[leg + 1]
    return places


def steps_at(rate: float, dt: float, reversals: tuple[float, ...]) -> int:
    """Steps of a passage whose greatest velocity is `rate` (m/s)."""
    travel = float(np.abs(np.diff(reversals, prepend=0.0)).sum())
    return 1 + ceil(min(FASTEST * travel / (rate * dt), 1e18))
