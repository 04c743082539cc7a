"""curve.png of a load that grew until it fell: its factor over displacements, as rests and falls, or behind the
collapse; the energy ledger."""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from masonry.curves.error_bars import draw_band
from masonry.curves.ledger import draw_ledger
from masonry.curves.settling_curve import COLOURS, movements
from masonry.pictures.labels import PointLabel, key_beside, place_labels
from masonry.pictures.style import MILLI, heading, plain, tidy
from masonry.results.records.convergence_record import RefinedNumber
from masonry.results.summary import CollapseLoad
from masonry.rows.columns import FACTOR
from masonry.rows.peak import before_a_fall

if TYPE_CHECKING:
    from masonry.results.data import ResultData

BEYOND = 0.5
"""How far a fall is shown, over all that was moved before it: how far a run follows it is chance."""
ROOM = 1.2
"""Height of the ledger over the largest work up to there."""
RED = "#b2182b"
FACTOR_LABEL = "load factor [1]"


class FactorLine(NamedTuple):
    """One line: a name, steps (n,), displacements (n,) in mm, factors (n,), and how many of them are rests."""

    name: str
    steps: np.ndarray
    across: np.ndarray
    factor: np.ndarray
    rests: int

    @property
    def extent(self) -> float:
        """mm, of the rests."""
        return float(np.ptp(self.across[: self.rests]))


def is_collapse_curve(result: "ResultData") -> bool:
    """Whether a result is drawn as the factor of a load that grew."""
    return result.summary.collapse_load is not None and FACTOR in result.history.rows and not result.has_drive


def collapse_figure(result: "ResultData") -> Any:
    """A figure of 1200 x 960 pixels: the load factor over displacements; the energy ledger below it."""
    from masonry.pictures.figure import ShownFigure

    grown = result.summary.collapse_load
    assert grown is not None, "a load grew"
    figure = ShownFigure(figsize=(7.5, 6), layout="constrained")
    curve, ledger = figure.subplots(2, 1, sharex=True, height_ratios=[3, 2])
    heading(figure, result)
    for axes in (curve, ledger):
        tidy(axes)
    paths = factor_paths(result)
    main = max(paths, key=lambda path: path.extent)
    led = grown.branch is not None and grown.branch.led
    for path, colour in zip(paths, len(paths) * COLOURS, strict=False):
        _draw_path(curve, path, colour, led, len(paths) > 1)
    _limit_fall(curve, paths, led)
    curve.axhline(0.0, color="0.6", linewidth=0.8)
    draw_band(curve, number := _without_end(result))
    curve.set_ylabel(FACTOR_LABEL)
    energies = _energies(result, main)
    draw_ledger(ledger, energies, main.across)
    ledger.set_ylim(*_ledger_limits(energies, main.rests, ledger) if not led else ledger.get_ylim())
    ledger.set_ylabel("energy [J]")
    several = f"; energies over that of {main.name}" if len(paths) > 1 else ""
    ledger.set_xlabel(plain(f"displacement [mm]{several}" if several else f"{main.name} [mm]"))
    for axes in (curve, ledger):
        key_beside(axes)
    end = (float(main.across[main.rests - 1]), grown.borne)
    words = factor_words(grown, result) + (f"\nwithout end {number.interval()}" if number is not None else "")
    place_labels(figure, curve, [PointLabel(words, end, RED)])
    return figure


def _without_end(result: "ResultData") -> RefinedNumber | None:
    """The load factor, refined without end; None where the run was not refined."""
    refined = result.summary.numerical_error
    return None if refined is None else refined.of("collapse_load.borne")


def factor_words(grown: CollapseLoad, result: "ResultData") -> str:
    """Which factor is borne and which is not."""
    if grown.falls is not None:
        return f"{grown.borne:.4g} is borne,\n{grown.falls:.4g} is not"
    return f"{grown.borne:.4g} is borne:\n" + ("interrupted" if result.summary.interrupted else "the load ends here")


def factor_paths(result: "ResultData") -> list[FactorLine]:
    """Of the gauge that was led; else of that of the curve, or of all; without gauges of the block that moves most as
    it falls, or of the top."""
    grown, rows = result.summary.collapse_load, result.history.rows
    assert grown is not None, "a load grew"
    if grown.branch is not None and grown.branch.led:
        rests = int(np.searchsorted(rows["step"], rows["step"][-1] - grown.branch.steps, side="right"))
        return [FactorLine(grown.branch.gauge, rows["step"], MILLI * rows[grown.branch.gauge], rows[FACTOR], rests)]
    last = before_a_fall(rows, grown.falls)["step"][-1]
    curve = result.scene_table.get("curve", {})
    named = curve.get("x") if isinstance(curve, dict) else None
    moved = movements(result) or {"displacement": (rows["step"], 0.0 * rows["step"])}
    moved = {named: moved[named]} if named in moved else moved
    if not any(name in rows for name in moved) and grown.falls is not None:
        moved = first_to_fall(result, grown.first, grown.sets)
    return [
        FactorLine(
            name, steps, MILLI * path, np.interp(steps, rows["step"], rows[FACTOR]), max(int((steps <= last).sum()), 1)
        )
        for name, (steps, path) in moved.items()
    ]


def first_to_fall(result: "ResultData", block: int, sets: list[str]) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """By name, steps and displacements (m) of the middle of the corners of a block along the axis on which it moves
    most, at every frame, to the side to which it moves."""
    frames, blocks = result.history.frames, result.specimen.blocks
    faces = slice(blocks.block_face_start[block], blocks.block_face_start[block + 1] + 1)
    start = blocks.face_start[faces]
    corners = np.unique(blocks.face_points[start[0] : start[-1]])
    paths = np.array([np.zeros(3), *(frame.corners[corners].mean(axis=0) for frame in frames)])
    axis = int(np.argmax(np.abs(paths[-1])))
    sign = -1.0 if paths[-1, axis] < 0.0 else 1.0
    where = f" of '{sets[0]}'" if sets else ""
    name = f"block {block}{where}, {'-' if sign < 0.0 else ''}{'xyz'[axis]}"
    return {name: (np.array([0.0, *(frame.step for frame in frames)]), sign * paths[:, axis])}


def _draw_path(axes: Any, path: FactorLine, colour: str, led: bool, several: bool) -> None:
    """Rests, then the fall or what is behind the collapse; a dot where they meet."""
    rests, after = slice(path.rests), slice(path.rests - 1, None)
    label = path.name if several else "at rest"
    axes.plot(
        path.across[rests], path.factor[rests], "o-", color=colour, markersize=3, linewidth=1.6, label=plain(label)
    )
    if len(path.across) > path.rests:
        word, style = ("behind the collapse", "-") if led else ("falls", "--")
        known = axes.get_legend_handles_labels()[1]
        axes.plot(
            path.across[after],
            path.factor[after],
            style,
            color="#e07b00" if led else "0.4",
            linewidth=2.0 if led else 1.2,
            label=None if word in known else word,
        )
    axes.plot(path.across[path.rests - 1], path.factor[path.rests - 1], "o", color=RED, markersize=6)


def _limit_fall(axes: Any, paths: list[FactorLine], led: bool) -> None:
    """Limits of the axes: the part that was borne fills the picture; a fall goes out of it."""
    axes.margins(y=0.12)
    shown = np.concatenate([path.across if led else path.across[: path.rests] for path in paths])
    falls = not led and any(len(path.across) > path.rests for path in paths)
    low, high = float(shown.min()), float(shown.max())
    size = high - low or max(float(np.ptp(path.across)) for path in paths) or 1.0
    ends = [path.across[-1] for path in paths] if falls else [low]
    margin = BEYOND if falls and min(ends) < low else 0.05
    right = BEYOND if falls and max(ends) > high else 0.05
    axes.set_xlim(low - margin * size, high + right * size)


def _energies(result: "ResultData", main: FactorLine) -> dict[str, np.ndarray]:
    """The rows at the steps of a line."""
    rows = result.history.rows
    return {name: np.interp(main.steps, rows["step"], values) for name, values in rows.items()}


def _ledger_limits(energies: dict[str, np.ndarray], rests: int, axes: Any) -> tuple[float, float]:
    """J, of what was borne: the energy of a fall goes out of the picture."""
    low, high = axes.get_ylim()
    return min(low, 0.0), min(high, ROOM * float(energies["external_work"][:rests].max())) or high
