"""Cycles of a drive or a load that turns back: where each begins and ends, what it dissipated, bore and left open."""

from itertools import pairwise
from typing import Any

import numpy as np

from masonry.rows.columns import FACTOR, dissipated_in
from masonry.rows.peak import borne, turns_back

HOME = 1e-9
"""Fraction of the farthest travel within which the drive, or the factor of a load, counts as back at its start."""
TOUCH = 1e-4
"""The same for a place where the drive turns or ends: a step may just miss the start there."""


def bounds(place: np.ndarray) -> list[float]:
    """Rows, with fractions, at which cycles begin, and the last row; the first begins where the drive sets out.

    A cycle ends where the drive is back at its start, and leaves it the way it left it first. One that the run does
    not end stays as the last. A turn at the start ends one too. Where the drive never comes back, cycles go from one
    turn to the next of the same kind, behind the way to the first of them.
    """
    place = _touching(place)
    near = HOME * float(np.abs(place).max())
    away = np.flatnonzero(np.abs(place) > near)
    if not len(away):
        return [0.0, float(len(place) - 1)]
    x = place * np.sign(place[away[0]])
    out = np.flatnonzero((x[:-1] <= near) & (x[1:] > near))
    crossings = [k + max(-x[k], 0.0) / (x[k + 1] - min(x[k], 0.0)) for k in out[1:]]
    returns = crossings if len(out) > 1 or x[-1] <= near else _turns(x)
    return [float(out[0]), *map(float, returns), float(len(place) - 1)]


def _turns(x: np.ndarray) -> list[int]:
    """Rows at which places (n,) turn back, of those that leave their start upwards for good; none where there is but
    one. Where they end at the place of the last such turn, that closes a cycle as well."""
    direction = np.sign(np.diff(x))
    moving = np.flatnonzero(direction)
    tops = [int(after) for before, after in pairwise(moving) if direction[before] > 0.0 > direction[after]]
    back = bool(tops) and abs(x[-1] - x[tops[-1]]) <= TOUCH * float(np.abs(x).max())
    return tops if len(tops) > 1 or back else []


def table(rows: dict[str, np.ndarray], widest: np.ndarray, gauge: str | None = None) -> list[dict[str, Any]]:
    """One entry a cycle, in SI; widest (n,) m, the widest opening at each row. Empty where nothing turns back.

    Of the drive, or, where a load goes to and fro, of its factor, whose loops are those over a gauge, by its name.
    Energies are differences between the cycle's ends (between rows in proportion), the rest is of its rows.
    What dead loads do while they settle is in no cycle.
    """
    place = rows["displacement" if gauge is None else FACTOR]
    if not turns_back(place):
        return []
    ends, at, cycles = bounds(place), _touching(place), []
    for begin, end in zip(ends[:-1], ends[1:], strict=True):
        inner = slice(int(np.ceil(begin)), int(np.floor(end)) + 1)
        dissipated = {key: _between(rows[key], begin, end) for key in dissipated_in(rows)}
        cycles.append(
            {
                "closed": bool(abs(_at(at, end) - _at(at, begin)) <= TOUCH * float(np.abs(at).max())),
                "dissipated_j": sum(dissipated.values()),
                **{f"{key}_j": value for key, value in dissipated.items()},
                "external_work_j": _between(rows["external_work"], begin, end),
                **(
                    _of_drive(place[inner], rows["stress"][inner], borne(rows, "stress")[inner])
                    if gauge is None
                    else _of_load(place[inner], rows[gauge][inner], _at(rows[gauge], end))
                ),
                "widest_opening_m": float(widest[inner].max()),
                "opening_left_m": _at(widest, end),
            }
        )
    return cycles


def _of_drive(place: np.ndarray, stress: np.ndarray, at_rest: np.ndarray) -> dict[str, float | None]:
    """Stresses, places and stiffness met by the drive in the rows of a cycle; at_rest (n,) Pa, so much as is borne."""
    far, near = int(np.argmax(place)), int(np.argmin(place))
    return {
        "highest_stress_pa": float(at_rest.max()),
        "lowest_stress_pa": float(at_rest.min()),
        "farthest_m": float(place[far]),
        "farthest_back_m": float(place[near]),
        "stiffness_pa_per_m": _slope(stress[far] - stress[near], place[far] - place[near]),
    }


def _of_load(factor: np.ndarray, reading: np.ndarray, left: float) -> dict[str, float | None]:
    """How a gauge read in the rows of a cycle of a load, and what is left of that at its end."""
    most, least = int(np.argmax(factor)), int(np.argmin(factor))
    return {
        "highest_factor": float(factor[most]),
        "lowest_factor": float(factor[least]),
        "farthest_m": float(reading.max()),
        "farthest_back_m": float(reading.min()),
        "left_m": left,
        "stiffness_per_m": _slope(factor[most] - factor[least], reading[most] - reading[least]),
    }


def _slope(rise: float, run: float) -> float | None:
    return float(rise / run) if run != 0.0 else None


def _touching(place: np.ndarray) -> np.ndarray:
    """Places (n,) of the drive; turns, stops there and the end are put on the start where they touch it."""
    near = TOUCH * float(np.abs(place).max())
    direction = np.sign(np.diff(place))
    moving = np.flatnonzero(direction)
    touching = np.zeros(len(place), dtype=bool)
    for before, after in zip(moving[:-1], moving[1:], strict=True):
        touching[before + 1 : after + 1] = direction[before] != direction[after]
    if len(moving):
        touching[moving[-1] + 1 :] = True
    return np.where(touching & (np.abs(place) <= near), 0.0, place)


def _between(values: np.ndarray, begin: float, end: float) -> float:
    """By how much values grow between two rows, with fractions."""
    return _at(values, end) - _at(values, begin)


def _at(values: np.ndarray, row: float) -> float:
    """A value at a row with a fraction."""
    return float(np.interp(row, np.arange(len(values)), values))
