"""Response spectra of a run: of the ground, and of every gauge of an acceleration."""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from masonry.errors import SceneError
from masonry.ground.spectrum import ResponseSpectrum, response_spectrum
from masonry.rows.accelerations import regular
from masonry.rows.columns import GROUND

if TYPE_CHECKING:
    from masonry.results.data import ResultData

DAMPING = 0.05
PERIODS = np.geomspace(0.02, 4.0, 231)
"""s, 100 a decade; 0.02 s stands for the peak of the acceleration itself."""
RESOLVED = 5.0
"""Rows a period, at least, of what the accelerations of gauges show."""


class GaugeSpectrum(NamedTuple):
    """Of one acceleration: its name, the answers of oscillators to it, and the shortest period (s) that rows show."""

    name: str
    answers: ResponseSpectrum
    shortest: float


def spectra_of(
    result: "ResultData", names: tuple[str, ...] = (), damping: float = DAMPING, periods: np.ndarray = PERIODS
) -> list[GaugeSpectrum]:
    """Of the ground and of all gauges of an acceleration, or of some columns by name, since the settling; the
    acceleration is straight between rows. Raises SceneError where there is none."""
    history = result.history
    known = [name for name in history.rows if name in GROUND.values() or history.unit(name) == "m/s2"]
    if not known:
        raise SceneError(
            "this result has no acceleration: its scene has no [ground], and no [[gauge]] with "
            "quantity = 'acceleration'"
        )
    for name in names:
        if name not in known:
            raise SceneError(f"'{name[:60]}' is no acceleration of this result; allowed: {', '.join(known)}")
    time = history.rows["time"] - settled_time(result)
    rows = regular(time, 0.0)
    time = time[rows]
    if len(time) < 3:
        raise SceneError("this result has fewer than three rows at equal steps in time; there is no spectrum of so few")
    shortest = RESOLVED * (time[-1] - time[0]) / (len(time) - 1)
    return [
        GaugeSpectrum(name, response_spectrum(time, history.rows[name][rows], periods, damping), shortest)
        for name in (names or known)
    ]


def settled_time(result: "ResultData") -> float:
    """s, when the settling ended."""
    settle = result.scene_table.get("settle", {})
    return (settle.get("steps", 0) if isinstance(settle, dict) else 0) * (result.summary.time_step_s or 0.0)


def spectra_csv(spectra: list[GaugeSpectrum]) -> str:
    """Periods (s) and the pseudo-accelerations (m/s2) of each, as CSV."""
    head = ["period [s]", *(f"{spectrum.name} [m/s2]" for spectrum in spectra)]
    columns = [spectra[0].answers.periods, *(spectrum.answers.pseudo_acceleration for spectrum in spectra)]
    return "\n".join([",".join(head), *(",".join(map(repr, row)) for row in np.column_stack(columns).tolist())]) + "\n"
