"""Acceleration records that are made by seed: of a stated spectrum, with an envelope in time, at rest at their end.

Sines of all frequencies with phases drawn from the seed are added up and taken times an envelope. For a response
spectrum their amplitudes are corrected some times by the ratio of target and response, and then wavelets are added
where the oscillators peak (`matching.py`). The samples are rounded to DIGIT, so that another processor, whose sums
differ in their last digit, has the same record.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from masonry.ground.matching import match
from masonry.ground.resting import at_rest, rounded
from masonry.ground.spectrum import ResponseSpectrum, periods_between, response_spectrum
from masonry.ground.target_spectrum import Eurocode8, FilteredNoise, TableSpectrum

DIGIT = 1e-6
"""m/s^2, what all samples are multiples of."""
AN_OCTAVE = 24
"""Periods an octave at which a record is matched; it is judged at twice as many."""
TRIES, ENOUGH = 6, 0.7
"""Draws of phases until one is matched within its tolerance; the share of it within which matching ends."""
END = 0.05
"""Share of the envelope that is left where the last second of the record brings it to nothing."""


@dataclass(frozen=True)
class Recipe:
    """Parameters from which a record is made; the seed apart.

    spectrum   of which response spectrum, or of which power spectrum
    duration   s, of the whole record
    step       s, from sample to sample
    rise       s, in which the envelope grows, as the square of the time
    strong     s, for which it stays; then it falls exponentially
    peak       m/s^2, the largest acceleration, for a power spectrum
    shortest   s, between which periods the record is matched
    longest    s
    tolerance  largest share by which its response spectrum may be off
    """

    spectrum: Eurocode8 | TableSpectrum | FilteredNoise
    duration: float
    step: float
    rise: float
    strong: float
    peak: float | None = None
    shortest: float = 0.05
    longest: float = 4.0
    tolerance: float = 0.1

    @property
    def intervals(self) -> int:
        """How many steps there are."""
        return round(self.duration / self.step)

    def require(self) -> None:
        """Raise ValueError, "key: what is wrong", where it cannot be followed."""
        if abs(self.intervals * self.step - self.duration) > 1e-9 * self.duration or self.intervals < 64:
            raise ValueError("duration: must be a whole number of steps, 64 or more")
        if self.rise + self.strong >= self.duration:
            raise ValueError("strong: rise and strong must be shorter together than duration")
        if self.shortest < 4.0 * self.step * (1.0 - 1e-9) or self.longest > 0.5 * self.duration:
            raise ValueError("longest: periods must lie between four steps and half of the duration")
        if self.shortest >= self.longest:
            raise ValueError("shortest: must be less than longest")


@dataclass(frozen=True)
class MadeRecord:
    """A record, and how well it is what was asked for.

    time          (m,) s, from 0
    acceleration  (m,) m/s^2, multiples of DIGIT, straight between them, 0 at both ends
    spectrum      its response spectrum where it is judged
    target        (n,) m/s^2, pseudo-accelerations that were asked for there; None for a power spectrum
    mismatch      largest share by which the spectrum is off the target; None for a power spectrum
    """

    time: np.ndarray
    acceleration: np.ndarray
    spectrum: ResponseSpectrum
    target: np.ndarray | None
    mismatch: float | None


@lru_cache(maxsize=256)
def make_record(recipe: Recipe, seed: int, component: int = 0) -> MadeRecord:
    """The record of a recipe and a seed; `component` is for several that are independent of each other.

    Raises ValueError where a recipe cannot be followed, or the record is further off than its tolerance.
    """
    recipe.require()
    time = np.arange(recipe.intervals + 1) * recipe.step
    envelope = _envelope(recipe, time)
    draws = np.random.Generator(np.random.PCG64([seed, component]))
    best = _made(recipe, time, envelope, draws)
    for _ in range(TRIES - 1):
        if best.mismatch is None or best.mismatch <= recipe.tolerance:
            break
        best = min(best, _made(recipe, time, envelope, draws), key=lambda record: record.mismatch or 0.0)
    if best.mismatch is not None and best.mismatch > recipe.tolerance:
        raise ValueError(
            f"tolerance: {recipe.tolerance:g} is not reached; the spectrum of the record of seed {seed} is off by "
            f"{best.mismatch:.2g}. Allow that much, or make the record longer, or match it up to a shorter period"
        )
    return best


def _made(recipe: Recipe, time: np.ndarray, envelope: np.ndarray, draws: np.random.Generator) -> MadeRecord:
    waves = _Waves(recipe, draws, envelope)
    if not isinstance(recipe.spectrum, FilteredNoise):
        return _judged(recipe, time, rounded(_matched(recipe, recipe.spectrum, time, envelope, waves), DIGIT))
    if recipe.peak is None:
        raise ValueError("peak: missing; a power spectrum has a shape only")
    acceleration = at_rest(time, waves.acceleration(np.sqrt(recipe.spectrum.power(waves.rates))), envelope)
    return _judged(recipe, time, rounded(acceleration * (recipe.peak / np.abs(acceleration).max()), DIGIT))


def _envelope(recipe: Recipe, time: np.ndarray) -> np.ndarray:
    """The square of time, then 1, then an exponential to END, and the square root of nothing at the end (Jennings)."""
    remaining = recipe.duration - recipe.rise - recipe.strong
    after = np.maximum(0.0, time - recipe.rise - recipe.strong) / remaining
    growing = np.clip(time / recipe.rise, 0.0, 1.0) ** 2 if recipe.rise > 0.0 else np.ones_like(time)
    last = min(1.0, 0.5 * remaining)
    ending = np.clip((recipe.duration - time) / last, 0.0, 1.0)
    envelope: np.ndarray = growing * END**after * np.sin(0.5 * np.pi * ending) ** 2
    envelope[0] = envelope[-1] = 0.0
    return envelope


class _Waves:
    """Sines of fixed phases, whose amplitudes can be chosen."""

    def __init__(self, recipe: Recipe, draws: np.random.Generator, envelope: np.ndarray) -> None:
        self.count = len(envelope) - 1
        self.envelope = envelope
        numbers = np.arange(self.count // 2 + 1)
        self.rates = 2.0 * np.pi * numbers / recipe.duration
        self.phases = 2.0 * np.pi * draws.random(len(numbers))
        slowest = 0.5 / recipe.longest
        self.passing = np.clip(numbers / recipe.duration / slowest - 1.0, 0.0, 1.0)  # nothing below the slowest

    def acceleration(self, amplitudes: np.ndarray) -> np.ndarray:
        """(m,) their sum times the envelope, for amplitudes (k,) at `rates`."""
        transform = amplitudes * self.passing * np.exp(1j * self.phases)
        transform[0] = 0.0
        sines = np.fft.irfft(transform, self.count) * self.count
        return np.append(sines, sines[0]) * self.envelope


def _matched(
    recipe: Recipe, spectrum: Eurocode8 | TableSpectrum, time: np.ndarray, envelope: np.ndarray, waves: _Waves
) -> np.ndarray:
    octaves = np.log2(recipe.longest / recipe.shortest)
    periods = periods_between(recipe.shortest, recipe.longest, 1 + int(np.ceil(AN_OCTAVE * octaves)))
    target = spectrum.at(periods)
    rates = np.maximum(waves.rates, waves.rates[1])
    its_periods = 2.0 * np.pi / rates
    amplitudes = spectrum.at(np.maximum(its_periods, recipe.shortest / 4.0)) / np.sqrt(rates)
    for _ in range(6):
        acceleration = at_rest(time, waves.acceleration(amplitudes), envelope)
        response = response_spectrum(time, acceleration, periods, spectrum.damping).pseudo_acceleration
        amplitudes = amplitudes * np.interp(its_periods, periods, target / response)
    acceleration = at_rest(time, waves.acceleration(amplitudes), envelope)
    return match(time, acceleration, envelope, periods, target, spectrum.damping, ENOUGH * recipe.tolerance)


def _judged(recipe: Recipe, time: np.ndarray, acceleration: np.ndarray) -> MadeRecord:
    octaves = np.log2(recipe.longest / recipe.shortest)
    periods = periods_between(recipe.shortest, recipe.longest, 1 + 2 * int(np.ceil(AN_OCTAVE * octaves)))
    if isinstance(recipe.spectrum, FilteredNoise):
        return MadeRecord(time, acceleration, response_spectrum(time, acceleration, periods), None, None)
    spectrum = response_spectrum(time, acceleration, periods, recipe.spectrum.damping)
    target = recipe.spectrum.at(periods)
    mismatch = float(np.abs(spectrum.pseudo_acceleration / target - 1.0).max())
    return MadeRecord(time, acceleration, spectrum, target, mismatch)
