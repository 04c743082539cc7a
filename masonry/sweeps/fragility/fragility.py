"""Share of falls by intensity: shares with their bands, the lognormal curve through them, the measure.

A run has fallen where a block fell (`collapse` in its summary), or its measure reached the limit. One that was stopped,
refused or lost before is left out, and counted.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from masonry.errors import SceneError, nearest
from masonry.sweeps.fragility.intensity import intensities
from masonry.sweeps.fragility.lognormal_fit import LognormalFit, lognormal_fit
from masonry.sweeps.fragility.request import FragilityRequest
from masonry.sweeps.planned_runs import Planned
from masonry.sweeps.run_store import Row
from masonry.sweeps.work import OK, STOPPED

FELL = "collapse.time_s"
"""Column of the table that a run has where a block fell."""
MOST_LEVELS, BINS = 15, 8
"""Intensities that are levels of their own; into how many classes of as many runs more are put."""
ALIKE = 9
"""Digits to which two intensities are one."""
QUANTILES = (0.16, 0.5, 0.84)


@dataclass(frozen=True)
class Level:
    """The runs of one intensity, or of a class of intensities, whose median it is.

    low, high  of the share, at the confidence (Clopper and Pearson, Biometrika 26, 1934)
    quantiles  of the measure, at QUANTILES, a run that fell counting as more than all others; None without a measure
    """

    intensity: float
    runs: int
    fallen: int
    low: float
    high: float
    quantiles: tuple[float, ...] | None

    @property
    def share(self) -> float:
        """That fell."""
        return self.fallen / self.runs


@dataclass(frozen=True)
class Fragility:
    """intensity, fallen, measure, record  (n,) of the runs that count: SI; bool; SI, inf where a block fell; which
    runs differ in intensity only
    unit      of the intensity
    levels    from the weakest intensity to the strongest
    fit       of all runs, or None, and then why there is none
    left_out  how many runs do not count
    """

    request: FragilityRequest
    unit: str
    intensity: np.ndarray
    fallen: np.ndarray
    measure: np.ndarray | None
    record: np.ndarray
    levels: tuple[Level, ...]
    fit: LognormalFit | None
    why_no_fit: str
    left_out: int

    @property
    def sentence(self) -> str:
        """Result, in a line."""
        runs = f"{int(self.fallen.sum())} of {len(self.fallen)} runs fell"
        left = f", {self.left_out} do not count" if self.left_out else ""
        if self.fit is None:
            return f"fragility: {runs}{left}; no curve: {self.why_no_fit}"
        low, high = self.fit.median_band(self.request.confidence)
        half = f"{self.request.intensity} {self.fit.median:.4g} {self.unit}".strip()
        return (
            f"fragility: {runs}{left}; half of all fall at {half}"
            f" ({low:.4g} to {high:.4g} at {self.request.confidence:.0%}), dispersion {self.fit.dispersion:.3g}"
        )


def fragility_of(request: FragilityRequest, planned: Sequence[Planned], rows: Sequence[Row]) -> Fragility:
    """The fragility of the runs of a sweep. Raises SceneError where the table has no such measure."""
    intensity, unit = intensities(request, planned)
    if request.measure is not None and all(row.get(request.measure) is None for row in rows):
        known = sorted({name for row in rows for name, value in row.items() if isinstance(value, float)})
        raise SceneError(f"fragility: measure: no run has '{request.measure}'; {nearest(request.measure, known)}")
    collapsed = np.array([row.get(FELL) is not None for row in rows])
    measured = [_measure(request, row) for row in rows]
    fallen = collapsed | (np.array(measured) >= (np.inf if request.limit is None else request.limit))
    counts = np.array([row["status"] == OK for row in rows]) | (fallen & np.array([_has_numbers(row) for row in rows]))
    if request.measure is not None:
        counts &= collapsed | ~np.isnan(measured)
    records = _records(request, planned)[counts]
    intensity, fallen = intensity[counts], fallen[counts]
    measure = np.where(collapsed, np.inf, measured)[counts] if request.measure is not None else None
    fit, why = None, "no run counts"
    if len(fallen):
        try:
            fit, why = lognormal_fit(intensity, fallen, records.tolist()), ""
        except ValueError as error:
            why = str(error)
    levels = _levels(intensity, fallen, measure, request.confidence)
    left_out = int(len(rows) - counts.sum())
    return Fragility(request, unit, intensity, fallen, measure, records, levels, fit, why, left_out)


def _measure(request: FragilityRequest, row: Row) -> float:
    value = row.get(request.measure) if request.measure is not None else None
    return np.nan if value is None else abs(float(value))


def _has_numbers(row: Row) -> bool:
    return row["status"] in (OK, STOPPED)


def _records(request: FragilityRequest, planned: Sequence[Planned]) -> np.ndarray:
    """(n,) a number a run: the same where all but the scale of the motion is."""
    scales = {request.intensity, "ground.scale", "ground.peak"}
    others = [str({key: value for key, value in run.values.items() if key not in scales}) for run in planned]
    return np.unique(others, return_inverse=True)[1]


def _levels(
    intensity: np.ndarray, fallen: np.ndarray, measure: np.ndarray | None, confidence: float
) -> tuple[Level, ...]:
    from scipy.stats import beta

    rounded = np.array([float(f"{value:.{ALIKE}g}") for value in intensity])
    distinct = np.unique(rounded)
    if len(distinct) <= MOST_LEVELS:
        members = [np.flatnonzero(rounded == value) for value in distinct]
    else:
        members = np.array_split(np.argsort(intensity, kind="stable"), BINS)
    levels = []
    for group in members:
        runs, down = len(group), int(fallen[group].sum())
        rest = 0.5 * (1.0 - confidence)
        low = float(beta.ppf(rest, down, runs - down + 1)) if down else 0.0
        high = float(beta.ppf(1.0 - rest, down + 1, runs - down)) if down < runs else 1.0
        quantiles = None
        if measure is not None:
            quantiles = tuple(float(np.quantile(measure[group], q, method="higher")) for q in QUANTILES)
        levels.append(Level(float(np.median(intensity[group])), runs, down, low, high, quantiles))
    return tuple(levels)
