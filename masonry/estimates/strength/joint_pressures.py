"""How a normal force and a moment press on a joint whose section stays plane: by any points of it."""

from typing import NamedTuple

import numpy as np

ROUNDS, NEAR = 40, 1e-3
"""Rounds of Newton; how near a force is balanced, over it."""
HALVES, WHOLE = 6, 0.999
"""Halvings of the share of a moment that is borne; share of a strength up to which a force is."""
STEEP = 1e-9
"""Of an elastic stiffness: what holds a section of which nothing bears any more."""


class StressBounds(NamedTuple):
    """Stiffness Pa/m; tension and compression Pa that are borne at most."""

    stiffness: float
    tension: float
    compression: float


def pressures(
    place: np.ndarray, area: np.ndarray, bounds: StressBounds, force: float, moment: np.ndarray
) -> np.ndarray:
    """Pa at places (n, 2) m from the middle, of areas (n,) m2; force N that pulls, moment (2,) N m along each axis.

    Where the points cannot bear the moment, or the force, as much of it as they bear.
    """
    length = float(np.sqrt(area.sum()))
    rows = np.column_stack([np.ones(len(area)), place / length])
    most = (bounds.tension if force > 0.0 else bounds.compression) * float(area.sum())
    force *= min(1.0, WHOLE * most / max(abs(force), 1e-300))
    if (pressed := _balanced(rows, area, bounds, np.array([force, *(moment / length)]))) is not None:
        return pressed
    low, high, pressed = 0.0, 1.0, np.zeros(len(area))
    for _ in range(HALVES):
        share = 0.5 * (low + high)
        tried = _balanced(rows, area, bounds, np.array([force, *(share * moment / length)]))
        low, high, pressed = (low, share, pressed) if tried is None else (share, high, tried)
    return pressed


def _balanced(rows: np.ndarray, area: np.ndarray, bounds: StressBounds, load: np.ndarray) -> np.ndarray | None:
    """Pa that balance a force and two moments over a length (3,) N; None where the points do not bear them."""
    elastic = bounds.stiffness * (rows.T * area) @ rows
    plane = np.linalg.lstsq(elastic, load, rcond=None)[0]
    for _ in range(ROUNDS):
        stress = _stress(bounds, rows @ plane)
        off = load - (area * stress) @ rows
        if np.linalg.norm(off) <= NEAR * np.linalg.norm(load):
            return -stress
        bears = (stress > -bounds.compression) & (stress < bounds.tension)
        tangent = bounds.stiffness * (rows.T * (area * bears)) @ rows + STEEP * elastic
        step = np.linalg.lstsq(tangent, off, rcond=None)[0]
        plane = plane + _shortened(rows, area, bounds, load, plane, step) * step
    return None


def _stress(bounds: StressBounds, opening: np.ndarray) -> np.ndarray:
    return np.clip(bounds.stiffness * opening, -bounds.compression, bounds.tension)


def _shortened(
    rows: np.ndarray, area: np.ndarray, bounds: StressBounds, load: np.ndarray, plane: np.ndarray, step: np.ndarray
) -> float:
    """The share of a step that lowers the energy less the work of the load most, of halves of it."""
    shares = 0.5 ** np.arange(24)
    opening = (plane + shares[:, None] * step) @ rows.T
    stress = _stress(bounds, opening)
    energy = stress * (opening - 0.5 * stress / bounds.stiffness)
    potential = energy @ area - (plane + shares[:, None] * step) @ load
    return float(shares[int(np.argmin(potential))])
