"""What a law does, measured on one contact: curves with a way back and forth, and energies by integration."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from masonry.laws.interface import Interface
from masonry.one_contact import Path, follow

COMPRESSIONS = (0.1e6, 0.5e6, 1.0e6)
"""Pa, of the couplets of the paper."""
LEFT = 0.02
"""Share of the strength that is left where a picture ends."""
NEAREST, FARTHEST, POINTS = 1e-9, 1.0, 2500
"""m beyond the peak, and how many points between: where energies are integrated."""


@dataclass(frozen=True)
class Energy:
    """Energies (N/m) of a curve, integrated until nothing is left.

    whole   the work taken up, less friction and what is stored
    beyond  the area beyond the peak, above the residual
    booked  what the program books as spent on the way: `whole`, if the law's functions agree with each other
    """

    whole: float
    beyond: float
    booked: float


@dataclass(frozen=True)
class Portrait:
    """Paths for a picture, and energies; both of shear by compression (Pa). No energies where nothing softens."""

    tension: Path
    shear: dict[float, Path]
    mode_1: Energy | None
    mode_2: dict[float, Energy]


def portrait(shape: Any, interface: Interface) -> Portrait:
    """Take contacts along paths: opened, closed and opened again; slid and back under three compressions.

    Dilation is left out: it would press the faces, and a curve of shear then has no one compression.
    """
    interface = interface._replace(tan_dilation=None, dilation_cutoff=None)
    strength = interface.tensile_strength
    at_peak = (strength or 0.0) / interface.normal_stiffness
    opened = _pull(shape, interface, _way(at_peak))
    end = _end(opened.opening, opened.sigma / strength, at_peak) if strength else 20e-6
    turn = at_peak + 0.25 * (end - at_peak)
    tension = _pull(shape, interface, _through(0.0, turn, -0.1 * at_peak, turn, end))
    mode_1 = _energy(opened, opened.opening, opened.sigma, 0.0) if strength else None
    shear, mode_2 = {}, {}
    for compression in (0.0, *COMPRESSIONS):
        peak, last = _strengths(interface, compression)
        at_peak = peak / interface.shear_stiffness
        slid = _push(shape, interface, compression, _way(at_peak))
        end = _end(slid.slip, (slid.tau - last) / (peak - last), at_peak) if peak > last else 3.0 * at_peak or 20e-6
        if compression:
            turn = at_peak + 0.3 * (end - at_peak)
            shear[compression] = _push(shape, interface, compression, _through(0.0, turn, -0.5 * turn, end))
        if strength is not None and peak > last:
            mode_2[compression] = _energy(slid, slid.slip, slid.tau, last)
    return Portrait(tension, shear, mode_1, mode_2)


def _strengths(interface: Interface, compression: float) -> tuple[float, float]:
    """Peak and residual shear strength (Pa) of an untouched contact; zeros where there is no strength."""
    cohesion, last = interface.cohesion or 0.0, interface.residual_cohesion or 0.0
    peak = cohesion + compression * (interface.tan_friction or 0.0)
    return peak, min(last + compression * (interface.tan_residual_friction or 0.0), peak)


def _pull(shape: Any, interface: Interface, opening: np.ndarray) -> Path:
    return follow(shape, interface, opening, np.zeros(len(opening)))


def _push(shape: Any, interface: Interface, compression: float, slip: np.ndarray) -> Path:
    return follow(shape, interface, np.full(len(slip), -compression / interface.normal_stiffness), slip)


def _through(*corners: float) -> np.ndarray:
    """(N,) straight from corner to corner."""
    legs = [np.linspace(a, b, 400)[1:] for a, b in zip(corners[:-1], corners[1:], strict=True)]
    return np.concatenate([[corners[0]], *legs])


def _way(at_peak: float) -> np.ndarray:
    """(N,) m: rest, the peak, and ever further beyond, each step a little longer than the one before."""
    return np.concatenate([[0.0, at_peak], at_peak + np.geomspace(NEAREST, FARTHEST, POINTS)])


def _end(way: np.ndarray, left: np.ndarray, at_peak: float) -> float:
    """m: where the share LEFT of the strength is left, and no less than three times the way to the peak."""
    gone = way[(left <= LEFT) & (way > at_peak)]
    return max(float(gone[0]) if len(gone) else 40.0 * at_peak, 3.0 * at_peak)


def _energy(path: Path, way: np.ndarray, stress: np.ndarray, last: float) -> Energy:
    """Of a path whose second point is the peak; `last` (Pa) is the residual."""
    work = 0.5 * (stress[1:] + stress[:-1]) * np.diff(way)
    beyond = work[1:].sum() - last * (way[-1] - way[1])
    return Energy(
        float(work.sum() - path.friction[-1] - path.stored[-1] + path.stored[0]),
        float(beyond),
        float(path.fracture[-1]),
    )
