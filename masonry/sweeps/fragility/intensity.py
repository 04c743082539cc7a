"""How strongly each run of a sweep is shaken: by a key that is varied, or by its motion itself."""

import tomllib
from collections.abc import Sequence

import numpy as np

from masonry.errors import SceneError
from masonry.sweeps.fragility.request import OF_MOTION, FragilityRequest
from masonry.sweeps.planned_runs import Planned
from masonry.sweeps.points import si


def intensities(request: FragilityRequest, planned: Sequence[Planned]) -> tuple[np.ndarray, str]:
    """(n,) intensities of the runs in SI, and their unit. Raises SceneError where one is none, or not above 0."""
    if request.intensity in OF_MOTION:
        values = [_of_motion(request, run) for run in planned]
        return np.array(values), OF_MOTION[request.intensity]
    numbers, unit = [], ""
    for run in planned:
        value, unit = _number(run.values.get(request.intensity), request.intensity)
        numbers.append(value)
    if min(numbers) <= 0.0:
        raise SceneError(f"fragility: {request.intensity}: an intensity must be above 0, not {min(numbers):g}")
    return np.array(numbers), unit


def _number(value: object, key: str) -> tuple[float, str]:
    from masonry.scene.tables.dynamics.acceleration_in_g import in_m_s2

    try:
        if key.endswith("peak"):
            return in_m_s2(value, key, "(0, 1e6]"), "m/s^2"
        return si(value, f"fragility: {key}")
    except ValueError:
        raise SceneError(f"fragility: {key}: {value!r:.60} is no number") from None


def _of_motion(request: FragilityRequest, run: Planned) -> float:
    """The largest of all components."""
    from masonry.ground.spectrum import response_spectrum
    from masonry.scene.tables.dynamics.ground import Ground, as_tables

    grounds = as_tables(tomllib.loads(run.job.resolved).get("ground", ()))
    motions = [motion for table in grounds for motion in Ground.model_validate(table).motions.values()]
    if not motions:
        raise SceneError(f"fragility: {request.intensity}: the scene has no [ground]")
    if request.period is not None:
        period = np.array([request.period])
        spectra = [response_spectrum(motion.time, motion.acceleration, period) for motion in motions]
        return max(float(spectrum.pseudo_acceleration[0]) for spectrum in spectra)
    return max(float(getattr(motion, request.intensity)) for motion in motions)
