"""curve.png of a motion in time: gauges over it, those of one quantity in one panel, and the energy ledger."""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from masonry.curves.fall_mark import mark_fall
from masonry.curves.ledger import draw_ledger
from masonry.curves.settling_curve import COLOURS, SETTLED_TIME, movements
from masonry.pictures.labels import key_beside
from masonry.pictures.style import heading, plain, tidy
from masonry.results.frame_choice import uncaught_fall
from masonry.rows.columns import GRAVITY, RATES, gauges_of

if TYPE_CHECKING:
    from masonry.results.data import ResultData

SHOWN = {
    "m": ("displacement [mm]", 1e3),
    "m/s": ("velocity [m/s]", 1.0),
    "m/s2": ("acceleration [g]", 1.0 / GRAVITY),
    "N": ("force of bars [kN]", 1e-3),
}
"""By unit of a gauge or of a bar that has a name: the label of its panel, and the factor from SI to what that says."""
FALLING = 0.5
"""s for which a fall is drawn that no floor ends."""


class TimeLine(NamedTuple):
    """One line: its name, the steps (n,) at which it is known, and values (n,) in SI; the unit of its panel."""

    name: str
    steps: np.ndarray
    values: np.ndarray
    unit: str


def is_over_time(result: "ResultData") -> bool:
    """Whether a result is drawn over the time: the scene says so, the ground moves, or it has gauges of velocities or
    accelerations."""
    asks = asks_for_time(result) and (not result.has_drive or bool(drawn_gauges(result)))
    has_rates = not set(RATES.values()).isdisjoint(result.history.units.values())
    return asks or (not result.has_drive and (result.is_shaken or has_rates))


def asks_for_time(result: "ResultData") -> bool:
    """Whether the scene has the time across."""
    curve = result.scene_table.get("curve", {})
    return isinstance(curve, dict) and curve.get("x") == "time"


def drawn_gauges(result: "ResultData") -> tuple[str, ...]:
    """The gauges that the scene's curve names upwards, of those that there are."""
    curve = result.scene_table.get("curve", {})
    up = curve.get("y", ()) if isinstance(curve, dict) else ()
    names = (up,) if isinstance(up, str) else tuple(up)
    return tuple(name for name in names if name in gauges_of(result.history.rows))


def time_lines(result: "ResultData") -> list[TimeLine]:
    """Lines over time: gauges and bars that the scene's curve names, else all; the top of the specimen where no gauge
    is."""
    history, named = result.history, drawn_gauges(result)
    lines = [
        TimeLine(name, history.rows["step"], history.rows[name], history.unit(name))
        for name in named or gauges_of(history.rows)
    ]
    if named or any(line.unit != "N" for line in lines):
        return lines
    return [*(TimeLine(name, steps, path, "m") for name, (steps, path) in movements(result).items()), *lines]


def since(result: "ResultData", steps: np.ndarray) -> np.ndarray:
    """(n,) s at steps (n,), from the end of the settling on."""
    rows, settle = result.history.rows, result.scene_table.get("settle", {})
    settled = settle.get("steps", 0) if isinstance(settle, dict) else 0
    return np.asarray(np.interp(steps, rows["step"], rows["time"]) - settled * (result.summary.time_step_s or 0.0))


def time_label(result: "ResultData") -> str:
    """Of the axis of `since`."""
    return SETTLED_TIME if result.scene_table.get("settle") else "time [s]"


def shown_until(result: "ResultData") -> float:
    """s, from the end of the settling on: of a fall that no floor ends its beginning is drawn, beside whose end nothing
    before could be seen; else all."""
    fallen = uncaught_fall(result)
    return np.inf if fallen is None else float(since(result, np.array([fallen]))[0]) + FALLING


def time_figure(result: "ResultData") -> Any:
    """A figure of 1200 pixels in width, over the time: a panel for each quantity, the energy ledger."""
    from masonry.pictures.figure import ShownFigure

    until, lines = shown_until(result), time_lines(result)
    units = [unit for unit in SHOWN if any(line.unit == unit for line in lines)]
    figure = ShownFigure(figsize=(7.5, 2.3 + 1.9 * len(units)), layout="constrained")
    *panels, ledger = np.atleast_1d(figure.subplots(len(units) + 1, 1, sharex=True))
    heading(figure, result)
    for axes in (*panels, ledger):
        tidy(axes)
    for axes, unit in zip(panels, units, strict=True):
        label, factor = SHOWN[unit]
        panel_lines = [line for line in lines if line.unit == unit]
        for line, colour in zip(panel_lines, len(panel_lines) * COLOURS, strict=False):
            time = since(result, line.steps)
            shown = time <= until
            axes.plot(time[shown], factor * line.values[shown], color=colour, linewidth=1.2, label=plain(line.name))
        axes.set_ylabel(label)
    mark_fall([*panels, ledger], result, lambda steps: since(result, steps))
    time = since(result, result.history.rows["step"])
    rows = {name: column[time <= until] for name, column in result.history.rows.items()}
    draw_ledger(ledger, rows, time[time <= until])
    ledger.set_ylabel("energy [J]")
    ledger.set_xlabel(time_label(result))
    ledger.set_xlim(0.0, float(time[time <= until][-1]) or None)
    for axes in (*panels, ledger):
        key_beside(axes)
    return figure
