"""sweep-map.png: of a sweep in which two keys vary, the peak over both; a cell or a point a run."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from masonry.judgement.words import scale_of
from masonry.pictures.style import plain, write_picture
from masonry.runtime.folders.own_files import ResultFiles
from masonry.runtime.named_file import remove_pictures
from masonry.sweeps.pictures.varied_keys import VariedKey, keys_that_vary
from masonry.sweeps.planned_runs import Planned
from masonry.sweeps.run_store import Row
from masonry.sweeps.work import OK

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PICTURE = "sweep-map"
MEASURES = (
    ("peak_stress_pa", "peak stress", "Pa"),
    ("collapse_load.borne", "load factor that was borne", ""),
    ("final_stress_pa", "stress at the end", "Pa"),
)
"""Columns of which the first that a run has is drawn, with words and unit."""
MOST_CELLS, MOST_WORDS = 30, 150
"""Values of a key as cells; cells with their number in them."""
GREY = "0.85"


def draw_map(folder: Path, title: str, planned: Sequence[Planned], rows: Sequence[Row], form: str) -> tuple[str, ...]:
    """Write sweep-map.png, or .pdf or .svg, where there is one; the name of what was written. Raises OSError."""
    remove_pictures(folder, PICTURE)  # of an earlier sweep, which may have had two keys
    figure = map_figure(title, planned, rows)
    if figure is None:
        return ()
    with ResultFiles(folder) as files:
        write_picture(figure, files.new(f"{PICTURE}.{form}"))
    return (f"{PICTURE}.{form}",)


def map_figure(title: str, planned: Sequence[Planned], rows: Sequence[Row]) -> "Figure | None":
    """The map; None where not just two keys vary, or no run has anything to show."""
    from matplotlib.figure import Figure

    axes_of_map = keys_that_vary(planned)
    measure = next(
        (m for m in MEASURES if any(row["status"] == OK and row.get(m[0]) is not None for row in rows)), None
    )
    if len(axes_of_map) != 2 or measure is None:
        return None
    values = [row.get(measure[0]) if row["status"] == OK else None for row in rows]
    factor, unit = scale_of(max((abs(value) for value in values if value is not None), default=0.0), measure[2])
    values = [None if value is None else value / factor for value in values]
    across, up = axes_of_map
    as_cells = _are_cells(across, up)
    if not as_cells and (across.numbers is None or up.numbers is None):
        return None
    figure = Figure(figsize=(9, 6), layout="constrained")
    axes = figure.subplots()
    label = f"{measure[1]} [{unit}]" if unit else measure[1]
    (_draw_cells if as_cells else _draw_points)(figure, axes_of_map, values, rows, label)
    axes.set_title(plain(f"{title}: {measure[1]} of {sum(value is not None for value in values)} runs"))
    return figure


def _are_cells(across: VariedKey, up: VariedKey) -> bool:
    """Whether the values make a grid that is at least half full."""
    columns, lines = len(set(across.texts)), len(set(up.texts))
    there = len(set(zip(across.texts, up.texts, strict=True)))
    return max(columns, lines) <= MOST_CELLS and columns * lines <= 2 * there


def _draw_cells(
    figure: Any, pair: Sequence[VariedKey], values: Sequence[float | None], rows: Sequence[Row], label: str
) -> None:
    import numpy as np

    (axes,), (across, up) = figure.axes, pair
    columns, lines = across.distinct, up.distinct
    field = np.full((len(lines), len(columns)), np.nan)
    words: dict[tuple[int, int], str] = {}
    for text_x, text_y, value, row in zip(across.texts, up.texts, values, rows, strict=True):
        place = lines.index(text_y), columns.index(text_x)
        field[place] = np.nan if value is None else value
        words[place] = row["status"].lower() if value is None else f"{value:.3g}"
    axes.set_facecolor(GREY)
    image = axes.imshow(field, origin="lower", aspect="auto", cmap="viridis", **_limits(values))
    for (line, column), word in words.items() if field.size <= MOST_WORDS else ():
        light = np.isnan(field[line, column]) or image.norm(field[line, column]) > 0.6
        axes.text(column, line, word, ha="center", va="center", color="black" if light else "white", fontsize=9)
    axes.set_xticks(range(len(columns)), [plain(text) for text in columns], rotation=45 if len(columns) > 6 else 0)
    axes.set_yticks(range(len(lines)), [plain(text) for text in lines])
    axes.set(xlabel=plain(across.words), ylabel=plain(up.words))
    figure.colorbar(image, ax=axes, label=plain(label))


def _draw_points(
    figure: Any, pair: Sequence[VariedKey], values: Sequence[float | None], rows: Sequence[Row], label: str
) -> None:
    (axes,), scaled = figure.axes, []
    for axis, set_label, set_scale in zip(
        pair, (axes.set_xlabel, axes.set_ylabel), (axes.set_xscale, axes.set_yscale), strict=True
    ):
        numbers, label_of_axis = axis.scaled()
        scaled.append(numbers)
        set_label(plain(label_of_axis))
        set_scale("log" if min(numbers) > 0.0 and max(numbers) > 20.0 * min(numbers) else "linear")
    there = [n for n, value in enumerate(values) if value is not None]
    lacking = [n for n, value in enumerate(values) if value is None]
    chosen = [values[n] for n in there]
    points = axes.scatter(*([line[n] for n in there] for line in scaled), c=chosen, s=60, zorder=3, **_limits(values))
    if lacking:
        axes.scatter(
            *([line[n] for n in lacking] for line in scaled), marker="x", color="0.5", label="without a result"
        )
        axes.legend(frameon=False, loc="upper left", bbox_to_anchor=(0.0, -0.1), fontsize=9)
    axes.grid(color="0.9", linewidth=0.8)
    axes.spines[["top", "right"]].set_visible(False)
    figure.colorbar(points, ax=axes, label=plain(label))


def _limits(values: Sequence[float | None]) -> dict[str, float]:
    """Ends of the colours: a little apart where all values are one."""
    there = [value for value in values if value is not None]
    low, high = min(there), max(there)
    apart = 0.01 * max(abs(low), abs(high)) or 1.0
    return {"vmin": low, "vmax": high} if high - low > 1e-9 * apart else {"vmin": low - apart, "vmax": high + apart}
