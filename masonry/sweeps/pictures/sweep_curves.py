"""sweep.png: the curves of all runs in one picture, coloured by what was varied."""

import csv
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from masonry.errors import SceneError
from masonry.pictures.labels import WIDEST, wrapped
from masonry.pictures.style import MEGA, MILLI, plain, write_picture
from masonry.results.validate import MOST
from masonry.runtime.folders.own_files import ResultFiles
from masonry.runtime.named_file import remove_pictures
from masonry.runtime.text_files import text_of
from masonry.sweeps.pictures.varied_keys import keys_that_vary
from masonry.sweeps.planned_runs import Planned
from masonry.sweeps.run_store import Row
from masonry.sweeps.work import OK

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PICTURE = "sweep"
LARGEST = 1 << 30
"""Bytes of a curve."""
ONE_COLOUR, FEW = "#1f3b5c", 10
WIDEST_BAR = 60
"""Letters of a line beside a bar of colours."""


def draw(folder: Path, title: str, planned: Sequence[Planned], rows: Sequence[Row], form: str) -> str:
    """Write sweep.png, or .pdf or .svg; its name. Raises OSError."""
    figure = curves_figure(folder, title, planned, rows)
    remove_pictures(folder, PICTURE)
    with ResultFiles(folder) as files:
        write_picture(figure, files.new(f"{PICTURE}.{form}"))
    return f"{PICTURE}.{form}"


def curves_figure(folder: Path, title: str, planned: Sequence[Planned], rows: Sequence[Row]) -> "Figure":
    """A line for every run that came to its end, along the axes that the first of them has."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10, 6), layout="constrained")
    axes = figure.subplots()
    shown = [n for n, row in enumerate(rows) if row["status"] == OK]
    key = colour_key(planned)
    colours, bar = _colours([key.values[n] for n in shown]) if shown and key else ([ONE_COLOUR] * len(shown), None)
    pair = _axes_of(planned[shown[0]]) if shown else PUSHED
    names: set[str] = set()
    for n, colour in zip(shown, colours, strict=True):
        across, up = _curve(folder / "runs" / rows[n]["key"] / "curve.csv", pair)
        name = key.names[n] if key and key.names else ""
        label = "" if name in names else name
        axes.plot(across * pair[0].factor, up * pair[1].factor, color=colour, linewidth=1.2, label=label)
        names.add(name)
    if key and key.names and shown:
        words = wrapped(key.words, WIDEST)
        axes.legend(title=words, loc="upper left", bbox_to_anchor=(1.01, 1.0), frameon=False, fontsize=9)
    elif key and bar is not None:
        figure.colorbar(bar, ax=axes, label=wrapped(key.words, WIDEST_BAR))
    axes.set_xlabel(plain(pair[0].label))
    axes.set_ylabel(plain(pair[1].label))
    axes.grid(color="0.9", linewidth=0.8)
    axes.spines[["top", "right"]].set_visible(False)
    left_out = f", {len(rows) - len(shown)} without a curve" if len(shown) < len(rows) else ""
    axes.set_title(plain(f"{title}: {len(shown)} runs{left_out}"))
    return figure


class ColourKey(NamedTuple):
    """Meaning of the colours: in words, by run its value, which has a colour, and its name in the legend; no names
    where a bar of colours takes the place of a legend."""

    words: str
    values: list[Any]
    names: list[str]


def colour_key(planned: Sequence[Planned]) -> ColourKey | None:
    """The key that was varied; of keys that change together (a row of a list, a multiple of another) the first. Where
    several were varied, all of them, for up to ten combinations; of more the key with the most values. None where
    nothing was varied.
    """
    keys = keys_that_vary(planned)
    if not keys:
        return None
    first = max(keys, key=lambda one: len(one.distinct))
    combinations = [", ".join(texts) for texts in zip(*(one.texts for one in keys), strict=True)]
    if len(keys) > 1 and len(set(combinations)) <= FEW:
        return ColourKey(", ".join(one.words for one in keys), combinations, combinations)
    others = "; other keys vary too" if len(keys) > 1 else ""
    if first.numbers is None:
        return ColourKey(f"{first.words}{others}", first.texts, first.texts)
    if len(first.distinct) <= FEW:
        return ColourKey(f"{first.words}{others}", first.numbers, first.texts)
    numbers, label = first.scaled()
    return ColourKey(f"{label}{others}", numbers, [])


def _colours(values: list[Any]) -> tuple[list[Any], Any]:
    """A colour for each value; with numbers, what a colour bar is drawn from as well."""
    import matplotlib
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import LogNorm, Normalize

    if all(isinstance(value, int | float) and not isinstance(value, bool) for value in values):
        low, high = min(values), max(values)
        wide = low > 0 and high > 20 * low
        bar = ScalarMappable(LogNorm(low, high) if wide else Normalize(low, high), "viridis")
        return [bar.to_rgba(value) for value in values], bar
    known = list(dict.fromkeys(map(str, values)))
    palette = matplotlib.colormaps["tab10" if len(known) <= FEW else "viridis"]
    shades = palette(range(len(known))) if len(known) <= FEW else palette(np.linspace(0.0, 1.0, len(known)))
    return [shades[known.index(str(value))] for value in values], None


class _Axis(NamedTuple):
    """The name of a column of curve.csv, without its unit, and how it is shown."""

    column: str
    label: str
    factor: float


TIME, STEP = _Axis("time", "time [s]", 1.0), _Axis("step", "step", 1.0)
PUSHED = _Axis("displacement", "displacement [mm]", MILLI), _Axis("stress", "stress [MPa]", MEGA)
FACTOR, KINETIC = _Axis("load_factor", "load factor", 1.0), _Axis("kinetic", "kinetic energy [J]", 1.0)


def _axes_of(run: Planned) -> tuple[_Axis, _Axis]:
    """Axes of the curve of a run: the stress of a drive over its displacement, the factor of a load that grows over the
    first gauge; else the first gauge over time. Without gauges, steps and the kinetic energy take its place."""
    scene = tomllib.loads(run.job.resolved)
    gauges, shaken = scene.get("gauge", []), "ground" in scene
    if "drive" in scene and not (shaken and gauges):
        return PUSHED
    if "limit" in scene and not shaken:
        return (_of_gauge(gauges[0]) if gauges else STEP), FACTOR
    return TIME, (_of_gauge(gauges[0]) if gauges else KINETIC)


def _of_gauge(gauge: dict[str, Any]) -> _Axis:
    quantity = gauge.get("quantity", "displacement")
    unit, factor = {"displacement": ("mm", MILLI), "velocity": ("m/s", 1.0)}.get(quantity, ("m/s2", 1.0))
    return _Axis(gauge["name"], f"{gauge['name']} [{unit}]", factor)


def _curve(path: Path, pair: tuple[_Axis, _Axis]) -> tuple[np.ndarray, np.ndarray]:
    """Two columns (rows,) of a curve.csv, SI."""
    try:
        lines = text_of(path, LARGEST).splitlines()
        names = [name.rpartition(" [")[0] for name in next(csv.reader(lines[:1]))]
        places = [names.index(axis.column) for axis in pair]
        table = np.loadtxt(lines, delimiter=",", skiprows=1, usecols=places, ndmin=2)
    except ValueError as error:
        raise SceneError(f"'{path}' is damaged ({f'{error}'[:200]}); remove its folder, and it is run again") from None
    if not np.all(np.abs(table) <= MOST):
        raise SceneError(f"'{path}' is damaged (numbers that are not finite); remove its folder, and it is run again")
    return table[:, 0], table[:, 1]
