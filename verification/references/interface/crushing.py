"""Strength of a joint in compression, and the return to it: a cap (Lourenco and Rots 1997), or a plain cut-off.

  cap      p^2 + Css t^2 = sb(k)^2 with p = max(-sigma, 0); closing and slip flow along its normal (p, Css t), and k is
           the length of that path; sb from fm/3 along a quarter of an ellipse to fm at kp, down a parabola to fm/2 at
           km, then exponentially to fm/10; km = kp + 75/67 G_c/fm, so that G_c is the area above fm/10 behind the peak
  cut-off  p = fc(k), k the closing; fc falls along a line from fm to 0 within 2 G_c/fm

Implicit: the flow at the end of the step, together with whatever the joint does in shear under the stress there. One
number a point is unknown, the multiplier L of the cap: closing L p, slip L Css t; it is the root of the cap's equation.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

Array = np.ndarray
ROUNDS, SECANTS = 80, 30
EXACT, ROUNDING = 4e-16, 1e-14


@dataclass(frozen=True)
class Compression:
    """Strength fm Pa; G_c N/m (infinite: no softening); kp m and Css of a cap, or both None: a cut-off."""

    fm: float
    G_c: float = np.inf
    kp: float | None = None
    css: float | None = None

    @property
    def least(self) -> float:
        """Pa, below which the strength never falls."""
        if np.isinf(self.G_c):
            return self.fm / 3.0 if self.kp is not None else self.fm
        return 0.1 * self.fm if self.kp is not None else 0.0


def bears(law: Compression, k: Array) -> Array:
    """Strength (Pa) at the hardening variable k (m)."""
    k = np.maximum(k, 0.0)
    if law.kp is None:
        return law.fm * np.maximum(1.0 - 0.5 * k * law.fm / law.G_c, 0.0)
    initial, middle, last = law.fm / 3.0, law.fm / 2.0, law.fm / 10.0
    ratio = np.minimum(k / law.kp, 1.0)
    rising = initial + (law.fm - initial) * np.sqrt(np.maximum(ratio * (2.0 - ratio), 0.0))
    if np.isinf(law.G_c):
        return rising
    length = 75.0 / 67.0 * law.G_c / law.fm
    past = (k - law.kp) / length
    falling = law.fm + (middle - law.fm) * past**2
    slope = 2.0 * (middle - law.fm) / length
    far = last + (middle - last) * np.exp(slope * np.maximum(k - law.kp - length, 0.0) / (middle - last))
    return np.where(past < 0.0, rising, np.where(past < 1.0, falling, far))


def cut_off(law: Compression, kn: float, k: Array, pressed: Array) -> Array:
    """Closing (m) of the step that brings an elastic compression (Pa) back to the strength left after it."""
    yielding = pressed > bears(law, k)

    def excess(closing: Array) -> Array:
        return pressed - kn * closing - bears(law, k + closing)

    maximum = np.where(yielding, pressed / kn, 0.0)
    return np.where(yielding, root(excess, maximum, law.fm), 0.0)


def cap(
    law: Compression,
    kn: float,
    ks: float,
    k: Array,
    pressed: Array,
    size: Array,
    answer: Callable[[Array, Array], Array],
) -> tuple[Array, Array, Array]:
    """Closing (m), slip (m) and change of k (m) in the step, by the flow of the cap.

    pressed, size  Pa, the elastic trial: compression (below 0: tension) and shear
    answer         the shear strength (Pa) of the joint under a compression and an elastic shear stress: Coulomb
    """
    assert law.css is not None
    css = law.css

    def flow(multiplier: Array) -> tuple[Array, Array]:
        """Compression and shear stress at the end of the step."""
        p = np.where(pressed > 0.0, pressed / (1.0 + kn * multiplier), pressed)
        weight = ks * css * multiplier
        elastic = size / (1.0 + weight)
        before, t = 0.9 * elastic, elastic
        error_before, error = answer(p, size - weight * before) - before, answer(p, elastic) - elastic
        slides = error < 0.0
        for _ in range(SECANTS):
            if np.all(np.abs(error[slides]) <= EXACT * size[slides]):
                break
            rise = np.where(error != error_before, error - error_before, np.inf)
            change = np.where(slides, error * (t - before) / rise, 0.0)
            before, t = t, np.where(slides, np.clip(t - change, 0.0, elastic), elastic)
            error_before, error = error, answer(p, size - weight * t) - t
        return np.maximum(p, 0.0), t

    def excess(multiplier: Array) -> Array:
        p, t = flow(multiplier)
        return np.sqrt(p**2 + css * t**2) - bears(law, k + multiplier * np.sqrt(p**2 + (css * t) ** 2))

    yielding = excess(np.zeros_like(pressed)) > 0.0
    if not yielding.any():
        return np.zeros_like(pressed), np.zeros_like(pressed), np.zeros_like(pressed)
    trial = np.sqrt(np.maximum(pressed, 0.0) ** 2 + css * size**2)
    stiffness = min(kn, ks * css) if css > 0.0 else kn
    multiplier = np.where(yielding, root(excess, np.where(yielding, trial / law.least / stiffness, 0.0), law.fm), 0.0)
    p, t = flow(multiplier)
    return multiplier * p, multiplier * css * t, multiplier * np.sqrt(p**2 + (css * t) ** 2)


def root(function: Callable[[Array], Array], upper: Array, size: float) -> Array:
    """Where a function of each entry crosses 0 from above, between 0 and `upper`: Ridders' method, up to the rounding
    of a `size`."""
    low, high = np.zeros_like(upper), upper.copy()
    at_low, at_high = function(low), function(high)
    for _ in range(ROUNDS):
        middle = 0.5 * (low + high)
        at_middle = function(middle)
        under = np.sqrt(np.maximum(at_middle**2 - at_low * at_high, 1e-300))
        guess = np.clip(middle + (middle - low) * at_middle / under, low, high)
        at_guess = function(guess)
        for place, value in ((middle, at_middle), (guess, at_guess)):
            inside = (place >= low) & (place <= high)
            up, down = inside & (value > 0.0), inside & (value <= 0.0)
            low, at_low = np.where(up, place, low), np.where(up, value, at_low)
            high, at_high = np.where(down, place, high), np.where(down, value, at_high)
        if np.all((high - low <= EXACT * high) | (np.minimum(at_low, -at_high) <= ROUNDING * size)):
            break
    return np.where(at_low < -at_high, low, high)
