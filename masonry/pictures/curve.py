"""curve.png: stress (or force) against displacement (or a gauge), and the energy ledger below it."""

from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from masonry.loading.cycles import peak_row
from masonry.pictures.curve_axes import CurveAxes, curve_axes

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from masonry.results.data import Result

MILLI, MEGA = 1e3, 1e-6
NOISE = 1e-9
"""What is smaller than this share of the largest value is written as 0."""

LEDGER = {
    "elastic_blocks": ("elastic, blocks", "#9ecae1"),
    "elastic_contacts": ("elastic, contacts", "#4a90c2"),
    "fracture_mode_1": ("fracture, mode I", "#d7301f"),
    "fracture_mode_2": ("fracture, mode II", "#fc8d59"),
    "friction": ("friction", "#fdcc8a"),
    "damping": ("damping", "#bdbdbd"),
    "kinetic": ("kinetic", "#78c679"),
}
"""The terms that together make up the external work: label and colour."""


class Peak(NamedTuple):
    """Displacement of the drive (m) and stress (Pa) there."""

    displacement: float
    stress: float


def drawn(figure: "Figure", path: Path | str | None) -> "Figure":
    """The figure, which is also written to a PNG file where one is named."""
    if path is not None:
        write_png(figure, path)
    return figure


def write_png(figure: Any, path: Path | str, dpi: float = 120.0) -> None:
    """Draw a figure to a PNG file without a display."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    canvas = FigureCanvasAgg(figure)
    figure.set_dpi(dpi)
    if (engine := figure.get_layout_engine()) is not None:
        engine.execute(figure)
        figure.set_layout_engine("none")
    canvas.print_png(path, pil_kwargs={"compress_level": 3})  # savefig would draw once more, to lay it out


LONGEST_TITLE = 300
"""Letters of a title that are drawn: laying out a long one takes longer than the run."""


def plain(title: str) -> str:
    """A title as it was written: no control characters, no dollar sign that would begin a formula."""
    short = title if len(title) <= LONGEST_TITLE else title[: LONGEST_TITLE - 3] + "..."
    return "".join(c if c.isprintable() else " " for c in short).replace("$", r"\$")


def without_noise(value: float, values: np.ndarray) -> float:
    """A value as it is written beside others; 0, never -0, where it is but their rounding."""
    return value if abs(value) > NOISE * float(np.abs(values).max(initial=0.0)) else 0.0


def peak_point(result: "Result") -> Peak:
    """The peak: of the summary, which looks at every step, else of the rows."""
    at, stress = (result.summary.get(key) for key in ("displacement_at_peak_m", "peak_stress_pa"))
    if isinstance(at, float) and isinstance(stress, float):
        return Peak(at, stress)
    row = peak_row(result.history.rows)
    return Peak(float(result.history.rows["displacement"][row]), float(result.history.rows["stress"][row]))


def curve_figure(result: "Result") -> Any:
    """A figure of 1200 x 960 pixels at 120 dpi: stress at drive and support over the ledger; loops and cycles
    of a drive that turns back; movements and reactions where there is none."""
    if result.summary.get("cycles"):
        from masonry.pictures.hysteresis import hysteresis_figure

        return hysteresis_figure(result)
    if not result.has_drive and len(result.history.rows.get("step", ())):
        from masonry.pictures.settling import settling_figure

        return settling_figure(result)
    from masonry.pictures.figure import ShownFigure

    figure = ShownFigure(figsize=(10, 8), layout="constrained")
    curve, ledger = figure.subplots(2, 1, sharex=True, height_ratios=[3, 2])
    heading(figure, result)
    ledger.set_ylabel("energy [J]")
    for axes in (curve, ledger):
        tidy(axes)
    rows = result.history.rows
    if not len(rows.get("displacement", ())):
        curve.text(0.5, 0.5, "no rows were recorded", transform=curve.transAxes, ha="center")
        return figure
    drawn = curve_axes(result)
    curve.set_ylabel(f"{drawn.name} [{drawn.unit}]")
    ledger.set_xlabel(drawn.label)
    _draw_curve(curve, rows, drawn, *peak_point(result))
    draw_ledger(ledger, rows, drawn.across)
    for axes in (curve, ledger):
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0, frameon=False, fontsize=10)
    return figure


def heading(figure: Any, result: "Result") -> None:
    """Title of the scene, its laws and kinds of motion."""
    words = [result.title, *(_words(result.summary.get(key)) for key in ("law", "kinematics"))]
    figure.suptitle(plain(", ".join(filter(None, words))), fontsize=13, wrap=True)


def tidy(axes: Any) -> None:
    """A light grid behind the curves, no frame at the top and right."""
    axes.grid(color="0.9", linewidth=0.8)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)


def _words(value: Any) -> str:
    """A word of the summary, or the different ones of a table of them: `elastic + exponential`."""
    return " + ".join(sorted(set(map(str, value.values())))) if isinstance(value, dict) else str(value or "")


def _draw_curve(axes: Any, rows: dict[str, np.ndarray], drawn: CurveAxes, peak_at: float, peak: float) -> None:
    displacement, unit = drawn.across, drawn.unit
    peak_at, peak = drawn.place(rows, peak_at), peak * drawn.factor
    stress, support = rows["stress"] * drawn.factor, rows["support_stress"] * drawn.factor
    axes.plot(displacement, stress, color="#1f3b5c", linewidth=2.0, label="at the drive")
    axes.plot(displacement, support, "--", color="#e07b00", linewidth=1.0, label="at the support")
    if not rows["displacement"].any():
        return
    axes.plot(peak_at, peak, "o", color="#b2182b", markersize=7, label="peak")
    late = peak_at > displacement.min() + 2 / 3 * np.ptp(displacement)
    axes.annotate(
        f"peak {peak:.4g} {unit} at {without_noise(peak_at, displacement):.4g} mm",
        (peak_at, peak),
        xytext=(-12 if late else 12, 4 if peak >= 0 else -14),
        ha="right" if late else "left",
        textcoords="offset points",
        color="#b2182b",
        fontsize=11,
    )
    axes.margins(y=0.12)
    if peak_row(rows) < len(stress) - 1:
        right = displacement[-1] >= displacement.mean()
        axes.annotate(
            f"at the end {without_noise(float(stress[-1]), stress):.3g} {unit}",
            (displacement[-1], stress[-1]),
            xytext=(-4 if right else 4, 30 if stress[-1] >= 0 and not late else -38),
            textcoords="offset points",
            ha="right" if right else "left",
            color="0.25",
            fontsize=11,
            arrowprops={"arrowstyle": "-", "color": "0.6", "linewidth": 0.8, "shrinkA": 0.0},
            bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.0},
        )


def draw_ledger(axes: Any, rows: dict[str, np.ndarray], displacement: np.ndarray) -> None:
    """Stacked areas of the terms that there are; one that is clearly negative somewhere is drawn as a line."""
    terms = {name: rows[name] for name in LEDGER if name in rows and rows[name].any()}
    size = max((float(np.abs(values).max()) for values in terms.values()), default=0.0)
    floor = -1e-3 * size
    stacked = [name for name, values in terms.items() if values.min() >= floor]
    if stacked:
        areas = axes.stackplot(
            displacement,
            [np.maximum(terms[name], 0.0) for name in stacked],
            colors=[LEDGER[name][1] for name in stacked],
            labels=[LEDGER[name][0] for name in stacked],
        )
        for area in areas:
            area.set_linewidth(0.0)
    for name in terms:
        if name not in stacked:
            label, colour = LEDGER[name]
            axes.plot(displacement, terms[name], ":", color=colour, linewidth=2.0, label=f"{label} (not stacked)")
    if "external_work" in rows:
        axes.plot(displacement, rows["external_work"], color="black", linewidth=1.4, label="external work")
