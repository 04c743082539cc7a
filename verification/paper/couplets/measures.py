"""Measures of the curves of couplets: strength line, work, plateau, stiffness; and of a bed of mortar: cracks."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from masonry.laboratory.result import Result
from masonry.laboratory.summary.cracks import BROKEN

Rows = Mapping[str, np.ndarray]


def strength_line(confinements: Sequence[float], peaks: Sequence[float]) -> tuple[float, float]:
    """(cohesion in Pa, tangent of the friction angle) of the straight line through peaks (Pa) by least squares."""
    tangent, cohesion = np.polyfit(confinements, peaks, 1)
    return float(cohesion), float(tangent)


def driven(rows: Rows) -> tuple[np.ndarray, np.ndarray]:
    """(displacement in m, stress in Pa) while the drive moves."""
    moving = rows["displacement"] > 0.0
    return rows["displacement"][moving], rows["stress"][moving]


def work_to(rows: Rows, displacement: float) -> float:
    """Work per area (J/m2) of the stress up to a displacement (m): the area under the curve, from the origin."""
    u, tau = driven(rows)
    inside = u < displacement
    u_all = np.concatenate([[0.0], u[inside], [displacement]])
    tau_all = np.concatenate([[0.0], tau[inside], [np.interp(displacement, u, tau)]])
    return float(np.trapezoid(tau_all, u_all))


def plateau(rows: Rows, fraction: float = 0.2) -> float:
    """Mean stress (Pa) over the last fraction of the way."""
    return mean_late(*driven(rows), fraction)


def mean_late(u: np.ndarray, tau: np.ndarray, fraction: float = 0.2) -> float:
    """Mean of a stress (Pa) over the last fraction of displacements (m) that grow."""
    last = u >= (1.0 - fraction) * u[-1]
    return float(np.trapezoid(tau[last], u[last]) / np.ptp(u[last]))


def initial_stiffness(rows: Rows, fraction: float = 0.3) -> float:
    """Slope (Pa/m) of the curve up to a fraction of its peak, by least squares through the origin."""
    u, tau = driven(rows)
    rising = slice(0, int(np.argmax(tau >= fraction * tau.max())))
    return float(u[rising] @ tau[rising] / (u[rising] @ u[rising]))


def spread(values: Sequence[float]) -> float:
    """Largest less smallest, over the mean."""
    return float(np.ptp(values) / np.mean(values))


def apart(first: Result, second: Result) -> float:
    """The largest distance between two curves, in shares of the peak."""
    u, tau = (first.history.rows[key] for key in ("displacement", "stress"))
    v, sigma = (second.history.rows[key] for key in ("displacement", "stress"))
    at = np.union1d(u, v)
    return float(np.abs(np.interp(at, u, tau) - np.interp(at, v, sigma)).max() / tau.max())


@dataclass(frozen=True)
class Cracks:
    """Broken areas of a couplet with a bed of mortar, as shares of its section.

    lower, upper  of the two interfaces       bed      within the mortar
    bed_tension   share of the broken area within the mortar that tension damaged more
    """

    lower: float
    upper: float
    bed: float
    bed_tension: float


def cracks(result: Result) -> Cracks:
    """Where a couplet with a bed of mortar is broken at the end: contacts with as much damage as the summary counts."""
    joints, frame = result.joints, result.history.frames[-1]
    broken = frame.damage >= BROKEN
    at_interface = result.joint_group == result.joint_groups.index("unit_mortar")
    height = joints.point[:, 2]
    upper = height > 0.5 * (height[at_interface].min() + height[at_interface].max())
    led = frame.damage_tension >= frame.damage_shear

    def area(chosen: np.ndarray) -> float:
        return float(joints.area[broken & chosen].sum())

    section, bed = result.summary["section_m2"], area(~at_interface)
    return Cracks(
        area(at_interface & ~upper) / section,
        area(at_interface & upper) / section,
        bed / section,
        area(~at_interface & led) / bed if bed > 0.0 else 0.0,
    )


@dataclass(frozen=True)
class Interfaces:
    """Both interfaces of a couplet with a bed of mortar at its peak.

    scatter    Pa, standard deviation of the normal stress, by area
    tension    share of their area in tension    softened  share that has softened in shear
    """

    scatter: float
    tension: float
    softened: float


def interfaces(result: Result) -> Interfaces:
    """How evenly the interfaces work at the peak, in the frame nearest to it."""
    at = result.summary["displacement_at_peak_m"]
    frame = min(result.history.frames, key=lambda candidate: abs(candidate.displacement - at))
    chosen = result.joint_group == result.joint_groups.index("unit_mortar")
    weight = result.joints.area[chosen] / result.joints.area[chosen].sum()
    normal = frame.normal_stress[chosen]
    scatter = float(np.sqrt(weight @ (normal - weight @ normal) ** 2))
    softened = frame.damage_shear[chosen] > 0.0
    return Interfaces(scatter, float(weight @ (normal > 0.0)), float(weight @ softened))
