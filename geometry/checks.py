"""Requirements of every specimen on its sizes, with messages that name the nearest valid choice."""

from collections.abc import Sequence

import numpy as np

from geometry.blocks import GeometryError


def require_lengths(specimen: str, lengths: dict[str, float], zero_allowed: Sequence[str] = ()) -> None:
    """Every length (m) finite and above zero, or GeometryError; those named in zero_allowed may also be zero."""
    for name, value in lengths.items():
        if not np.isfinite(value) or value < 0 or (value == 0 and name not in zero_allowed):
            limit = "0 m or more" if name in zero_allowed else "greater than 0 m"
            nearest = f"; {-value:g} m would be" if np.isfinite(value) and value < 0 else ""
            raise GeometryError(f"{specimen}: {name} is {value:g} m, it must be {limit}{nearest}")


def require_counts(specimen: str, name: str, counts: Sequence[float], axes: str) -> None:
    """One whole number of at least 1 for each axis, or GeometryError."""
    if len(counts) != len(axes):
        raise GeometryError(f"{specimen}: {name} has {len(counts)} numbers, allowed: {len(axes)} ({', '.join(axes)})")
    for axis, count in zip(axes, counts, strict=True):
        if count != int(count) or count < 1:
            nearest = max(1, round(count))
            raise GeometryError(
                f"{specimen}: {name} along {axis} is {count:g}, it must be a whole number of at least 1; "
                f"nearest: {nearest}"
            )
