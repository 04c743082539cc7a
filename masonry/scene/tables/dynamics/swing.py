"""Table of a scene for damping after its dead loads have settled: none, of the mass, of the stiffness of contacts."""

from math import pi
from typing import Annotated, Any

from pydantic import BeforeValidator, PlainSerializer, model_validator

from masonry.quantity import convert
from masonry.scene.tables.types import Damping, KeyedError, Table, refuse_both

RATES, TIMES, FREQUENCIES = "(0, 1e9]", "(0, 1e6]", "[1e-6, 1e9]"
WIDEST = 1e4
"""The upper end of a band over the lower one, at most."""


def _ratio(value: Any) -> float:
    """A share of critical damping, or a percentage: 0.05 or "5 %"."""
    if isinstance(value, str) and value.rstrip().endswith("%"):
        return convert(value.rstrip()[:-1], "number", "ratio", "(0, 50]") / 100
    return convert(value, "number", "ratio", "(0, 0.5]")


def _frequency(value: Any) -> float:
    return convert(value, "frequency", "frequency", FREQUENCIES)


def _band(value: Any) -> tuple[float, float]:
    if not isinstance(value, list | tuple) or len(value) != 2:
        raise ValueError("between takes two frequencies, for example ['2 Hz', '10 Hz']")
    low, high = (_frequency(one) for one in value)
    if not low < high <= WIDEST * low:
        raise ValueError(f"between takes a lower frequency, then a higher one, no more than {WIDEST:g} times as high")
    return low, high


def _at_frequency(value: dict[str, Any], key: str) -> tuple[float, float]:
    """A ratio, and the angular frequency (rad/s) at which it holds."""
    if set(value) != {"ratio", "at"}:
        raise ValueError(f"{key} takes a quantity, or {{ratio = '5 %', at = '2 Hz'}}")
    return _ratio(value["ratio"]), 2.0 * pi * _frequency(value["at"])


def _mass(value: Any) -> float | None:
    if isinstance(value, dict):
        ratio, omega = _at_frequency(value, "mass")
        return 2.0 * ratio * omega
    return value if value is None else convert(value, "rate", "mass", RATES)


def _stiffness(value: Any) -> float | None:
    if isinstance(value, dict):
        ratio, omega = _at_frequency(value, "stiffness")
        return 2.0 * ratio / omega
    return value if value is None else convert(value, "time", "stiffness", TIMES)


def _written(unit: str) -> PlainSerializer:
    return PlainSerializer(lambda value: f"{value!r} {unit}", when_used="unless-none")


Ratio = Annotated[float, BeforeValidator(_ratio)]
Between = Annotated[
    tuple[float, float],
    BeforeValidator(_band),
    PlainSerializer(lambda band: [f"{frequency!r} Hz" for frequency in band]),
]


MOST_FLAT = 0.1
"""The largest ratio of Maxwell's branches: they would be stiffer than the contacts that they damp."""


class FrequencyBand(Table):
    """A ratio of damping between two frequencies (Hz)."""

    ratio: Ratio
    between: Between


class DampingTable(Table):
    """Damping once the dead loads have settled; an empty table stands for none.

    mass       a0 (1/s) of Rayleigh's damping: a force of -a0 m v
    stiffness  a1 (s): dashpots of a1 times the stiffness of the closed contacts
    rayleigh   both of them, of a ratio at two frequencies
    maxwell    a ratio that is the same all over a band: branches of a spring and a dashpot in closed contacts
    local      xi of local damping, eq. (3)
    """

    mass: Annotated[float | None, BeforeValidator(_mass), _written("s^-1")] = None
    stiffness: Annotated[float | None, BeforeValidator(_stiffness), _written("s")] = None
    rayleigh: FrequencyBand | None = None
    maxwell: FrequencyBand | None = None
    local: Damping | None = None

    @property
    def mass_rate(self) -> float:
        """a0, 1/s."""
        if self.rayleigh is None:
            return self.mass or 0.0
        low, high = (2.0 * pi * frequency for frequency in self.rayleigh.between)
        return 2.0 * self.rayleigh.ratio * low * high / (low + high)

    @property
    def brakes_all(self) -> str | None:
        """The key of what brakes all motion relative to the ground; None without any."""
        if not self.mass_rate:
            return None
        return "rayleigh" if self.mass is None else "mass"

    @property
    def stiffness_time(self) -> float:
        """a1, s."""
        if self.rayleigh is None:
            return self.stiffness or 0.0
        return 2.0 * self.rayleigh.ratio / (2.0 * pi * sum(self.rayleigh.between))

    @property
    def flat(self) -> tuple[float, float, float] | None:
        """The ratio of Maxwell's branches, and the ends of their band in Hz; None without."""
        return None if self.maxwell is None else (self.maxwell.ratio, *self.maxwell.between)

    @model_validator(mode="after")
    def _is_given_once(self) -> "DampingTable":
        for key, others in {"rayleigh": ("mass", "stiffness"), "local": ("mass", "rayleigh")}.items():
            for other in others:
                refuse_both(self, other, key)
        if self.maxwell is not None and self.maxwell.ratio > MOST_FLAT:
            raise KeyedError("maxwell.ratio", f"must be {100 * MOST_FLAT:g} % at most")
        return self
