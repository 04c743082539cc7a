"""What a scene says of damping after its dead loads have settled: none, of the mass, or local."""

from math import pi
from typing import Annotated, Any

from pydantic import BeforeValidator, PlainSerializer, model_validator

from masonry.quantity import convert
from masonry.scene.tables.types import Damping, KeyedError, Table

RATES, FREQUENCIES = "(0, 1e9]", "[1e-6, 1e9]"


def _ratio(value: Any) -> float:
    """A share of critical damping, or a percentage: 0.05 or "5 %"."""
    if isinstance(value, str) and value.rstrip().endswith("%"):
        return convert(value.rstrip()[:-1], "number", "ratio", "(0, 50]") / 100
    return convert(value, "number", "ratio", "(0, 0.5]")


def _frequency(value: Any) -> float:
    return convert(value, "frequency", "frequency", FREQUENCIES)


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


def _written(unit: str) -> PlainSerializer:
    return PlainSerializer(lambda value: f"{value!r} {unit}", when_used="unless-none")


class DampingTable(Table):
    """What damps once the dead loads have settled; an empty table stands for nothing.

    mass       a0 (1/s) of Rayleigh's damping: a force of -a0 m v
    local      xi of local damping, eq. (3)
    """

    mass: Annotated[float | None, BeforeValidator(_mass), _written("s^-1")] = None
    local: Damping | None = None

    @property
    def mass_rate(self) -> float:
        """a0, 1/s."""
        return self.mass or 0.0

    @model_validator(mode="after")
    def _is_given_once(self) -> "DampingTable":
        if self.local is not None and self.mass is not None:
            raise KeyedError("local", "mass and local exclude each other; keep one of them")
        return self
