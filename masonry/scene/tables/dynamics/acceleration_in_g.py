"""Accelerations of the ground, in which people write g for that of gravity: "0.4 g" is 0.4 times 9.80665 m/s^2."""

import re
from typing import Annotated, Any

from pydantic import BeforeValidator, PlainSerializer, ValidationInfo

from masonry.quantity import convert

_IN_G = re.compile(r"\s*([+-]?[\d.]+(?:[eE][+-]?\d+)?)\s*g\s*", re.ASCII)


def in_m_s2(value: Any, name: str, allowed: str) -> float:
    """An acceleration in m/s^2; `name` is its key. Raises ValueError."""
    match = _IN_G.fullmatch(value) if isinstance(value, str) and len(value) < 60 else None
    return convert(f"{match[1]} g_n" if match else value, "acceleration", name, allowed)


def _read(value: Any, info: ValidationInfo) -> Any:
    return value if value is None else in_m_s2(value, info.field_name or "this", "(0, 1e6]")


AccelerationInG = Annotated[float, BeforeValidator(_read), PlainSerializer(lambda value: f"{value!r} m/s^2")]
