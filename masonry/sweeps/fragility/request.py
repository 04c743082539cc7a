"""The table [fragility] of a sweep: against which intensity, by which measure, and what counts as fallen."""

from dataclasses import dataclass
from typing import Any

from masonry.errors import SceneError, nearest
from masonry.quantity import parse
from masonry.sweeps.read import is_number

OF_MOTION = {"peak_acceleration": "m/s^2", "peak_velocity": "m/s", "pseudo_acceleration": "m/s^2"}
"""Intensities of the motion itself, and their units."""
KEYS = ("intensity", "period", "measure", "limit", "confidence")


@dataclass(frozen=True)
class FragilityRequest:
    """Request for a fragility curve.

    intensity   one of OF_MOTION, or a dotted key that the sweep varies
    period      s, of the pseudo-acceleration (damping 5 %)
    measure     column of the table, such as "rotation_max_rad"; None: only what falls is looked at
    limit       SI, from which value of the measure on a run counts as fallen; None: where a block fell
    confidence  of the bands
    """

    intensity: str
    period: float | None = None
    measure: str | None = None
    limit: float | None = None
    confidence: float = 0.9


def read_request(table: Any, where: str, varied: list[str]) -> FragilityRequest:
    """The request of a table; `varied` are the keys of the sweep. Raises SceneError."""
    if not isinstance(table, dict):
        raise SceneError(f"{where}: must be a table [fragility]")
    for key in table:
        if key not in KEYS:
            raise SceneError(f"{where}: {key}: unknown key; {nearest(key, KEYS)}")
    intensity = table.get("intensity")
    known = [*OF_MOTION, *varied]
    if not isinstance(intensity, str) or intensity not in known:
        missing = "missing" if intensity is None else f"{intensity!r:.60} is not varied here"
        raise SceneError(f"{where}: intensity: {missing}; {nearest(str(intensity), known)}")
    period = table.get("period")
    if (intensity == "pseudo_acceleration") != (period is not None):
        raise SceneError(f"{where}: period: goes with intensity = 'pseudo_acceleration', and only with it")
    measure, limit, confidence = table.get("measure"), table.get("limit"), table.get("confidence", 0.9)
    if measure is not None and (not isinstance(measure, str) or not measure):
        raise SceneError(f"{where}: measure: the name of a column of the table, such as 'rotation_max_rad'")
    if limit is not None and (measure is None or not is_number(limit)):
        raise SceneError(f"{where}: limit: a number in SI, which goes with a measure")
    if not is_number(confidence) or not 0.5 <= confidence < 1.0:
        raise SceneError(f"{where}: confidence: a number in [0.5, 1)")
    seconds = None if period is None else parse(period, "time", f"{where}: period", "[0.001, 100]")
    return FragilityRequest(intensity, seconds, measure, limit, float(confidence))
