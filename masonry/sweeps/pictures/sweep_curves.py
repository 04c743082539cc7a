"""sweep.png: the curves of all runs in one picture, coloured by what was varied."""

import csv
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geometry.files.atomic import WholeFiles
from masonry.errors import SceneError
from masonry.pictures.style import MEGA, MILLI, plain, write_picture
from masonry.results.validate import MOST
from masonry.runtime.text_files import text_of
from masonry.sweeps.job import short_text
from masonry.sweeps.pictures.varied_keys import keys_that_vary
from masonry.sweeps.planned_runs import Planned
from masonry.sweeps.run_store import Row
from masonry.sweeps.sweep_table import swept
from masonry.sweeps.work import OK

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PICTURE = "sweep.png"
LARGEST = 1 << 30
"""Bytes of a curve."""
ONE_COLOUR, FEW = "#1f3b5c", 10


def draw(folder: Path, title: str, planned: Sequence[Planned], rows: Sequence[Row]) -> None:
    """Write sweep.png. Raises OSError."""
    figure = curves_figure(folder, title, planned, rows)
    with WholeFiles(folder) as files:
        write_picture(figure, files.new(PICTURE))


def curves_figure(folder: Path, title: str, planned: Sequence[Planned], rows: Sequence[Row]) -> "Figure":
    """A line for every run that came to its end, along the axes that the first of them has."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10, 6), layout="constrained")
    axes = figure.subplots()
    shown = [n for n, row in enumerate(rows) if row["status"] == OK]
    label, values = coloured_by(planned)
    colours, bar = _colours([values[n] for n in shown]) if shown and label else ([ONE_COLOUR] * len(shown), None)
    if bar is not None and _differing(values) <= FEW:
        key, bar = label.partition(" [")[0], None
        label, values = key, [short_text(run.values.get(key)) for run in planned]
    names: set[str] = set()
    pair = _axes_of(planned[shown[0]]) if shown else PUSHED
    for n, colour in zip(shown, colours, strict=True):
        across, up = _curve(folder / "runs" / rows[n]["key"] / "curve.csv", pair)
        name = f"{values[n]}" if label and bar is None else ""
        axes.plot(
            across * pair[0].factor,
            up * pair[1].factor,
            color=colour,
            linewidth=1.2,
            label="" if name in names else name,
        )
        names.add(name)
    if bar is not None:
        figure.colorbar(bar, ax=axes, label=plain(label))
    elif label and shown:
        axes.legend(title=plain(label), loc="upper left", bbox_to_anchor=(1.01, 1.0), frameon=False, fontsize=9)
    axes.set_xlabel(plain(pair[0].label))
    axes.set_ylabel(plain(pair[1].label))
    axes.grid(color="0.9", linewidth=0.8)
    axes.spines[["top", "right"]].set_visible(False)
    left_out = f", {len(rows) - len(shown)} without a curve" if len(shown) < len(rows) else ""
    axes.set_title(plain(f"{title}: {len(shown)} runs{left_out}"))
    return figure


def coloured_by(planned: Sequence[Planned]) -> tuple[str, list[Any]]:
    """Name and values of the column that was varied, in SI if it has a unit; of keys that change together (a row of a
    list, a multiple of another) the first. Where several were varied, all of them, as they were given, for up to ten
    combinations; of more the column with the most values. No name where nothing was varied.
    """
    rows = swept(planned)
    keys = list(dict.fromkeys(key for run in planned for key in run.values))
    columns = {name: [row.get(name) for row in rows] for name in (_in_si(key, rows) for key in keys)}
    varied = {name: values for name, values in columns.items() if _differing(values) > 1}
    if not varied:
        return "", []
    first = max(varied, key=lambda name: _differing(varied[name]))
    together = {tuple(map(str, pairs)) for pairs in zip(*varied.values(), strict=True)}
    if len(keys_that_vary(planned)) == 1:
        return first, varied[first]
    if len(together) > FEW:
        return f"{first} (other keys vary too)", varied[first]
    keys = [key for key in keys if _differing([row.get(key) for row in rows]) > 1]
    return ", ".join(keys), [", ".join(short_text(row.get(key)) for key in keys) for row in rows]


def _in_si(key: str, rows: list[dict[str, Any]]) -> str:
    """The column of a key, in SI where there is one."""
    return next((name for row in rows for name in row if name.startswith(f"{key} [")), key)


def _differing(values: list[Any]) -> int:
    """How many values there are that are not alike."""
    return len(set(map(str, values)))


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
    """What is drawn against what: the stress of a drive over its displacement, the factor of a load that grows over the
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
