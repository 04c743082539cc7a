"""Abscissa and force of a curve: as the scene says, else stress against the displacement of the drive."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from masonry.rows.columns import TILT
from masonry.rows.peak import at_peak

if TYPE_CHECKING:
    from masonry.results.data import ResultData

UP = {"stress": ("stress", "MPa", 1e-6), "force": ("force", "kN", 1e-3)}
"""What a curve may show: its name, its unit in pictures and the factor to that from SI."""


@dataclass(frozen=True)
class CurveAxes:
    """Across: values (one a row) and label. Up: name, unit, and the factor from a stress in Pa."""

    across: np.ndarray
    label: str
    name: str
    unit: str
    factor: float

    @property
    def across_unit(self) -> str:
        """The unit of what is across: that in the brackets of its label."""
        return self.label.rpartition("[")[2].rstrip("]")

    def place(self, rows: dict[str, np.ndarray], displacement: float) -> float:
        """Where the displacement (m) of the drive at the peak of some rows, the first of all, lies across."""
        return at_peak(rows, self.across[: len(rows["step"])], displacement)


def curve_axes(result: "ResultData") -> CurveAxes:
    """The axes that the scene of a result asks for; time across where nothing is driven."""
    curve, rows = _curve_table(result), result.history.rows
    name, unit, factor = UP.get(str(curve.get("y")), UP["stress"])
    if name == "force":
        factor *= result.specimen.section
    across = str(curve.get("x", "displacement"))
    across = across if across in rows else "displacement"
    if across == "time" or (not rows["displacement"].any() and across == "displacement"):
        return CurveAxes(rows["time"], "time [s]", name, unit, factor)
    if across == TILT:
        sign, label = tilt_axis(rows)
        return CurveAxes(sign * np.degrees(rows[TILT]), label, name, unit, factor)
    if (of_gauge := result.history.unit(across)) != "m":
        return CurveAxes(rows[across], f"{across} [{of_gauge}]", name, unit, factor)
    return CurveAxes(rows[across] * 1e3, f"{across} [mm]", name, unit, factor)


def without_blows(result: "ResultData", *lines: np.ndarray) -> tuple[float, float] | None:
    """Limits upwards that show lines (n,), one value a row, until a block had fallen, and their ends: blows that come
    later go out of the picture. None where nothing falls."""
    count = len(result.standing_rows["step"])
    if all(count == len(line) for line in lines):
        return None
    shown = np.concatenate([np.append(line[:count], line[-1]) for line in lines])
    room = 0.12 * float(np.ptp(shown))
    return float(shown.min()) - room, float(shown.max()) + room


def tilt_axis(rows: dict[str, np.ndarray]) -> tuple[float, str]:
    """The sign with which the tilt is drawn across, so that time runs to the right, and its label."""
    return (1.0, "tilt of gravity [deg]") if rows[TILT][-1] >= 0.0 else (-1.0, "tilt of gravity, times -1 [deg]")


def _curve_table(result: "ResultData") -> dict[str, object]:
    curve = result.scene_table.get("curve", {})
    return curve if isinstance(curve, dict) else {}
