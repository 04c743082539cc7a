"""Response of a law, measured on one contact: curves with a way back and forth, and energies by integration."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from masonry.drawings.crushing_portrait import CrushingPortrait, crushing_portrait
from masonry.drawings.one_contact import Path, follow
from masonry.laws.law_dispatch import beside
from masonry.laws.state import JointProperties

COMPRESSIONS = (0.1e6, 0.5e6, 1.0e6)
"""Pa, of the couplets of the paper."""
LEFT = 0.02
"""Share of the strength that is left where a picture ends."""
NEAREST, FARTHEST = 1e-9, 1e5
"""Where energies are integrated beyond the peak: from and to, over energy by strength."""
FINEST = 1e-13
"""m beyond the peak, over the way to the peak: nearer there is only rounding."""
LEAST, MOST = 1e-30, 1e200
"""m: no energy over strength is taken to be less or more."""
POINTS = 280
"""Points for each factor of ten of the way."""
LOST = 1e-12
"""Share of the strength that is rounding."""
WITHOUT_STRENGTH = 20e-6
"""m, how far a contact without strength is drawn."""


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
    """Paths for a picture, and energies; both of shear by compression (Pa). No energies where nothing softens; no
    crushing where that is not modelled."""

    tension: Path
    shear: dict[float, Path]
    mode_1: Energy | None
    mode_2: dict[float, Energy]
    crushing: CrushingPortrait | None = None


def portrait(parameters: Any, joint: JointProperties) -> Portrait:
    """Take contacts along paths: opened, closed and opened again; slid and back under three compressions.

    Dilation is left out: it would press the faces, and a curve of shear then has no one compression. So is crushing but
    in a curve of its own.
    """
    joint = joint._replace(tan_dilation=None, dilation_cutoff=None)
    crushes = crushing_portrait(parameters, joint)
    joint = joint._replace(compressive_strength=None, crushing_energy=None, closing_at_peak=None, cap_shear_factor=None)
    strength = joint.tensile_strength
    at_peak = (strength or 0.0) / joint.normal_stiffness
    if strength:
        opened = _pull(parameters, joint, _displacements(at_peak, _given(parameters, 1, 0.0), strength, 0.0))
        mode_1 = _energy(opened, opened.opening, opened.sigma, 0.0)
        end = _end(opened.opening, opened.sigma / strength, at_peak)
    else:
        mode_1, end = None, WITHOUT_STRENGTH
    reversal = at_peak + 0.25 * (end - at_peak)
    tension = _pull(parameters, joint, _through(0.0, reversal, -0.1 * (at_peak or reversal), reversal, end))
    shear, mode_2 = {}, {}
    for compression in (0.0, *COMPRESSIONS):
        peak, last = _strengths(joint, compression)
        at_peak = peak / joint.shear_stiffness if peak else 0.0
        end = 3.0 * at_peak or WITHOUT_STRENGTH
        if peak > last:
            displacements = _displacements(at_peak, _given(parameters, 2, compression), peak, last)
            slid = _push(parameters, joint, compression, displacements)
            end = _end(slid.slip, (slid.tau - last) / (peak - last), at_peak)
            if strength is not None:
                mode_2[compression] = _energy(slid, slid.slip, slid.tau, last)
        if compression:
            reversal = at_peak + 0.3 * (end - at_peak)
            shear[compression] = _push(parameters, joint, compression, _through(0.0, reversal, -0.5 * reversal, end))
    return Portrait(tension, shear, mode_1, mode_2, crushes)


def _given(parameters: Any, mode: int, compression: float) -> float | None:
    """Fracture energy (N/m) that the law was given for a mode at a compression (Pa); None where it knows none."""
    keys = beside(type(parameters), "PARAMETERS", {})
    given = {key: getattr(parameters, field) or 0.0 for field, key in keys.items()}
    energy = given.get(f"fracture_energy_mode_{mode}")
    return energy and energy + given.get(f"fracture_energy_mode_{mode}_slope", 0.0) * compression


def _strengths(joint: JointProperties, compression: float) -> tuple[float, float]:
    """Peak and residual shear strength (Pa) of an untouched contact; zeros where there is no strength."""
    cohesion, last = joint.cohesion or 0.0, joint.residual_cohesion or 0.0
    peak = cohesion + compression * (joint.tan_friction or 0.0)
    return peak, min(last + compression * (joint.tan_residual_friction or 0.0), peak)


def _pull(parameters: Any, joint: JointProperties, opening: np.ndarray) -> Path:
    return follow(parameters, joint, opening, np.zeros(len(opening)))


def _push(parameters: Any, joint: JointProperties, compression: float, slip: np.ndarray) -> Path:
    return follow(parameters, joint, np.full(len(slip), -compression / joint.normal_stiffness), slip)


def _through(*corners: float) -> np.ndarray:
    """(N,) straight from corner to corner."""
    legs = [np.linspace(a, b, 400)[1:] for a, b in zip(corners[:-1], corners[1:], strict=True)]
    return np.concatenate([[corners[0]], *legs])


def _displacements(at_peak: float, energy: float | None, peak: float, last: float) -> np.ndarray:
    """(N,) m: rest, the peak, and ever further beyond, each step a little longer than the one before.

    at_peak     m
    energy      N/m, given; the elastic one counts where there is none
    peak, last  Pa
    """
    energy = energy or at_peak * peak
    nearest = max(NEAREST * min(max(energy / peak, LEAST), MOST), FINEST * at_peak)
    farthest = max(FARTHEST * min(max(energy / (peak - last), LEAST), MOST), 100.0 * nearest, at_peak)
    count = round(POINTS * np.log10(farthest / nearest))
    return np.concatenate([[0.0, at_peak], at_peak + np.geomspace(nearest, farthest, count)])


def _end(displacements: np.ndarray, left: np.ndarray, at_peak: float) -> float:
    """m: where the share LEFT of the strength is left, and no less than three times the way to the peak."""
    gone = displacements[(left <= LEFT) & (displacements > at_peak)]
    return max(float(gone[0]) if len(gone) else 40.0 * at_peak, 3.0 * at_peak)


def _energy(path: Path, displacements: np.ndarray, stress: np.ndarray, last: float) -> Energy:
    """Of a path whose second point is the peak; `last` (Pa) is the residual. What is lost at once leaves no area."""
    above = stress - last
    above[2:] = np.where(np.abs(above[2:]) <= LOST * stress[1], 0.0, above[2:])
    work = 0.5 * (above[1:] + above[:-1]) * np.diff(displacements)
    if above[2] == 0.0:
        work[1] = 0.0
    beyond = work[1:].sum()
    return Energy(
        float(work.sum() + last * displacements[-1] - path.friction[-1] - path.stored[-1] + path.stored[0]),
        float(beyond),
        float(path.fracture[-1]),
    )
