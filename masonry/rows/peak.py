"""The peak of a curve, and the rows that count for it."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from masonry.rows.columns import EXCESS, FACTOR

AT_PEAK = 1e-3
"""On a plateau the place of the highest value is chance: the peak counts as reached within this share of it."""


def only_rises(place: np.ndarray) -> bool:
    """Whether places (n,) of the drive only rise: then nothing is a cycle."""
    return bool(np.all(np.diff(place) >= 0.0))


def turns_back(place: np.ndarray) -> bool:
    """Whether places (n,) of the drive go to and fro."""
    return not (only_rises(place) or only_rises(-place))


def before_a_fall(rows: dict[str, np.ndarray], falls: float | None) -> dict[str, np.ndarray]:
    """Rows up to the last one at which a load was borne, where it falls at a factor: how far a fall is followed is
    chance."""
    if falls is None:
        return rows
    borne = int(np.flatnonzero(rows[FACTOR] != falls)[-1]) + 1
    return {key: values[:borne] for key, values in rows.items()}


def before_a_collapse(rows: dict[str, np.ndarray], step: float | None) -> dict[str, np.ndarray]:
    """Rows up to the step at which the first block had fallen, where one has: what hits the drive later is no
    strength."""
    if step is None or "step" not in rows:
        return rows
    standing = rows["step"] <= step
    return {key: values[standing] for key, values in rows.items()}


def borne(rows: Mapping[str, Any], column: str) -> Any:
    """So much of the `stress` or `force` of the drive (a column) as is borne at rest, where that is known: of a row, or
    of all."""
    if EXCESS not in rows:
        return rows[column]
    return rows[column] * (1.0 - rows[EXCESS] / np.maximum(np.abs(rows["force"]), 1e-300))


def peak_row(rows: dict[str, np.ndarray]) -> int:
    """The first row at which the stress, positive along the drive, is within AT_PEAK of the highest of all rows from
    the last one on before the drive moves; of a drive that turns back the highest row itself."""
    begun = _before_the_drive(rows)
    stress = borne(rows, "stress")[begun:]
    if turns_back(rows["displacement"]):
        return begun + int(np.argmax(stress))
    return begun + int(np.argmax(stress >= reached(float(stress.max()))))


def lowest_row(rows: dict[str, np.ndarray]) -> int:
    """The row of the lowest stress, of the same rows."""
    begun = _before_the_drive(rows)
    return begun + int(np.argmin(borne(rows, "stress")[begun:]))


def _before_the_drive(rows: dict[str, np.ndarray]) -> int:
    """The last row before the drive moves."""
    moved = np.flatnonzero(rows["displacement"] != 0.0)
    return max(int(moved[0]) - 1, 0) if len(moved) else 0


def reached(peak: float) -> float:
    """The least value that counts as the peak."""
    return peak - AT_PEAK * abs(peak)


def at_peak(rows: dict[str, np.ndarray], values: np.ndarray, displacement: float) -> float:
    """A value (one a row) at the peak: between the rows round its displacement (m), or in the row of the peak
    where the drive turns back and passes the same place more than once."""
    for sign in (1.0, -1.0):
        if only_rises(place := sign * rows["displacement"]):
            return float(np.interp(sign * displacement, place, values))
    return float(values[peak_row(rows)])
