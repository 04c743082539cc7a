"""The shape of a stress-displacement curve in numbers: how steeply it falls, how far two of them differ."""

import numpy as np

from masonry.laboratory.result import Result

POINTS = 400
"""At so many equal displacements two curves are compared."""


def stress_at(result: Result, displacement: float | np.ndarray) -> np.ndarray:
    """Stress in Pa at displacements of the drive in m; the last one beyond the end of the run."""
    rows = result.history.rows
    return np.asarray(np.interp(displacement, rows["displacement"], rows["stress"]))


def peak_place(result: Result) -> float:
    """Displacement (m) of the drive at the peak."""
    return float(result.summary["displacement_at_peak_m"])


def left_after(result: Result, times: float) -> float:
    """Stress at so many times the displacement of the peak, over the peak."""
    return float(stress_at(result, times * peak_place(result)) / result.summary["peak_stress_pa"])


def fall_to(result: Result, fraction: float) -> float:
    """Displacement (m) past the peak at which the stress is first a fraction of the peak; nan where it never is."""
    rows, peak = result.history.rows, float(result.summary["peak_stress_pa"])
    below = (rows["displacement"] > peak_place(result)) & (rows["stress"] <= fraction * peak)
    if not below.any():
        return float("nan")
    k = int(np.argmax(below))
    u, s = rows["displacement"][k - 1 : k + 1], rows["stress"][k - 1 : k + 1]
    return float(np.interp(fraction * peak, s[::-1], u[::-1])) - peak_place(result)


def steepest_fall(result: Result, window: float) -> float:
    """Largest fall of the stress past the peak within a window (m) of displacement, over the peak."""
    u = np.linspace(peak_place(result), float(result.history.rows["displacement"][-1]), POINTS)
    fall = stress_at(result, u) - stress_at(result, u + window)
    return float(fall[u + window <= u[-1]].max(initial=0.0) / result.summary["peak_stress_pa"])


def apart(first: Result, second: Result, begin: float = 0.0, end: float = np.inf) -> float:
    """Mean difference of two curves between two displacements (m), over the peak of the second."""
    last = min(end, *(float(r.history.rows["displacement"][-1]) for r in (first, second)))
    u = np.linspace(begin, last, POINTS)
    return float(np.abs(stress_at(first, u) - stress_at(second, u)).mean() / second.summary["peak_stress_pa"])


def energy_per_section(result: Result) -> dict[str, float]:
    """Energy by where it went, over the section of the specimen, in N/m: mode I, mode II, friction, fracture in all."""
    energy, section = result.summary["energy_j"], result.summary["section_m2"]
    dissipated = {
        "mode I": energy["fracture_mode_1"] / section,
        "mode II": energy["fracture_mode_2"] / section,
        "friction": energy["friction"] / section,
    }
    return dissipated | {"fracture": dissipated["mode I"] + dissipated["mode II"]}


def tail(result: Result) -> float:
    """Mean stress (Pa) over the last third of the way."""
    end = float(result.history.rows["displacement"][-1])
    return float(stress_at(result, np.linspace(2.0 * end / 3.0, end, POINTS)).mean())
