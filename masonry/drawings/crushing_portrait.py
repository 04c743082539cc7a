"""Response of a law in compression, measured on one contact: curve with a way back, areas, and surface of yield."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from masonry.drawings.one_contact import Path, follow, initial_history
from masonry.laws.compression_cap import INITIAL, RESIDUAL, SOFTENING, is_within, strength_left
from masonry.laws.mechanism import elastic_trial
from masonry.laws.state import JointProperties

LENGTHS, FAR = 3.0, 6.0
"""How far a picture goes, and energies are integrated, in lengths of the softening down to half of the strength."""
STRENGTHS_AT_LEAST = 4.0
"""Elastic closings at the strength that a picture shows at least."""
POINTS, ANGLES, HALVINGS = 300, 121, 50


@dataclass(frozen=True)
class Areas:
    """Work of crushing (N/m) up to the strength and behind it, there above what is left in the end; measured and by the
    closed form."""

    hardening: float
    softening: float
    hardening_wanted: float
    softening_wanted: float


@dataclass(frozen=True)
class CrushingPortrait:
    """The curve of compression with a way back; its areas, None where nothing softens; and points (N, 2) Pa of normal
    (tension positive) and shear stress at which something yields, by words."""

    curve: Path
    areas: Areas | None
    surface: dict[str, np.ndarray]


def crushing_portrait(parameters: Any, joint: JointProperties) -> CrushingPortrait | None:
    """Press a contact on and on, once with a way back; None where crushing is not modelled."""
    strength, at_peak = joint.compressive_strength, joint.closing_at_peak or 0.0
    if strength is None:
        return None
    elastic, length = strength / joint.normal_stiffness, softening_length(joint)
    end = max(at_peak + elastic + LENGTHS * length, STRENGTHS_AT_LEAST * elastic)
    turn = elastic + at_peak + 0.5 * length or 2.0 * elastic
    corners = [0.0, min(turn, 0.6 * end), min(turn, 0.6 * end) - 0.8 * elastic, min(turn, 0.6 * end), end]
    legs = [np.linspace(a, b, POINTS)[1:] for a, b in zip(corners[:-1], corners[1:], strict=True)]
    curve = _press(parameters, joint, np.concatenate([[0.0], *legs]))
    return CrushingPortrait(curve, areas(parameters, joint) if length else None, surfaces(parameters, joint))


def softening_length(joint: JointProperties) -> float:
    """m, of plastic closing, from the strength to half of it (cap) or to nothing (cut-off); 0 without softening."""
    if joint.crushing_energy is None or joint.compressive_strength is None:
        return 0.0
    area = 0.5 if joint.cap_shear_factor is None else SOFTENING
    return joint.crushing_energy / (area * joint.compressive_strength)


def areas(parameters: Any, joint: JointProperties) -> Areas:
    """By the work that the contact books, at plastic closings that are given."""
    strength, at_peak = float(joint.compressive_strength or 0.0), float(joint.closing_at_peak or 0.0)
    length, last = softening_length(joint), 0.0 if joint.cap_shear_factor is None else RESIDUAL
    k = np.concatenate(
        [at_peak * np.linspace(0.0, 1.0, POINTS) ** 3, at_peak + FAR * length * np.linspace(0.0, 1.0, 3 * POINTS)[1:]]
    )
    bears = np.array([float(strength_left(joint, np.float64(one))) for one in k])
    work = _press(parameters, joint, k + bears / joint.normal_stiffness).crushing
    hardening = float(work[POINTS - 1])
    softening = float(work[-1]) - hardening - last * strength * float(k[-1] - at_peak)
    wanted = strength * at_peak * (INITIAL + (1.0 - INITIAL) * np.pi / 4.0)
    return Areas(hardening, softening, float(wanted), float(joint.crushing_energy or 0.0))


def surfaces(parameters: Any, joint: JointProperties) -> dict[str, np.ndarray]:
    """Where an untouched contact yields, and where one would at its strength and in the end."""
    if joint.cap_shear_factor is None:
        return {"yields": surface(parameters, joint, 0.0)}
    at_peak = float(joint.closing_at_peak or 0.0)
    places = {"first yield": 0.0, "at the strength": at_peak, "in the end": at_peak + 50.0 * softening_length(joint)}
    return {words: surface(parameters, joint, k) for words, k in places.items()}


def surface(parameters: Any, joint: JointProperties, hardening: float) -> np.ndarray:
    """(ANGLES, 2) Pa, normal and shear stress in all directions at which a contact yields; hardening in m."""
    history, bears = initial_history(joint), strength_left(joint, np.float64(hardening))
    most = 3.0 * max(
        float(value or 0.0) for value in (joint.compressive_strength, joint.cohesion, joint.tensile_strength)
    )

    def stands(sigma: float, tau: float) -> bool:
        opening, squared = np.float64(sigma / joint.normal_stiffness), np.float64(tau * tau)
        trial, unchanged = elastic_trial(parameters, joint, history, opening, squared)
        return bool(unchanged and is_within(joint, bears, trial, squared))

    points = []
    with np.errstate(all="ignore"):
        for angle in np.linspace(0.0, np.pi, ANGLES):
            low, high = 0.0, most
            for _ in range(HALVINGS):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if stands(middle * np.cos(angle), middle * np.sin(angle)) else (low, middle)
            points.append((low * np.cos(angle), low * np.sin(angle)))
    return np.array(points)


def _press(parameters: Any, joint: JointProperties, closing: np.ndarray) -> Path:
    return follow(parameters, joint, -closing, np.zeros(len(closing)))
