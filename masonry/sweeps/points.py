"""The points of a sweep: each row of its list with each combination of its grid with each of its samples."""

import itertools
import math
from typing import Any

from masonry.errors import SceneError, nearest
from masonry.quantity import KINDS, convert, is_unit_weight
from masonry.sweeps.read import Sweep, is_number, value_of

MOST, MOST_VALUES = 100_000, 5_000_000
"""Runs of one sweep, and values that it sets in all of them together."""
Point = dict[str, Any]
WORDS, SCALES = ("from", "to", "scale", "values", "times"), ("linear", "log")
RANGE = (
    "write {from = '0.1 MPa', to = '0.4 MPa'}, with scale = 'log' if you like, {values = [...]}, or {times = {...}} of "
    "these"
)


def points(sweep: Sweep) -> list[Point]:
    """Dotted key -> value (or Times) for each run, settings left out; what comes last in the file's order varies first.

    Raises SceneError for a table that cannot be read, or for more than MOST runs.
    """
    axes: list[list[Point]] = [sweep.parts["list"]] if "list" in sweep.parts else []
    for key, entry in sweep.parts.get("grid", {}).items():
        axes.append([{key: value} for value in _grid_values(entry, f"{sweep.name}: grid: {key}")])
    if "latin_hypercube" in sweep.parts:
        axes.append(_samples(sweep.parts["latin_hypercube"], f"{sweep.name}: latin_hypercube"))
    count = math.prod(map(len, axes))
    if count > MOST:
        many = f"{count}" if count < 1e15 else "far too many"
        raise SceneError(f"{sweep.name}: {many} runs; a sweep may have {MOST}")
    _require_few(count * sum(max(map(len, axis)) for axis in axes), sweep.name)
    return [{key: value for part in parts for key, value in part.items()} for parts in itertools.product(*axes)]


def _grid_values(entry: Any, where: str) -> list[Any]:
    """`[a, b]` or `{times = [0.5, 2]}`, with `of` if need be."""
    if isinstance(entry, list) and entry:
        return [value_of(value, where) for value in entry]
    if isinstance(entry, dict) and isinstance(entry.get("times"), list) and entry["times"]:
        return [value_of(entry | {"times": factor}, where) for factor in entry["times"]]
    raise SceneError(
        f"{where}: must be a list of values, or {{times = [0.5, 1, 2]}}; dotted keys stand in quotes, "
        "'contact.unit_unit.cohesion' = [...]"
    )


def _samples(table: dict[str, Any], where: str) -> list[Point]:
    """The points of a Latin hypercube: each axis is cut into as many equal parts as there are samples, each part is
    met once; scipy's `qmc.LatinHypercube`, whose points depend on the seed, their number and the number of axes.
    """
    from scipy.stats import qmc

    count = _whole(table.get("samples"), f"{where}: samples", 1, MOST)
    seed = _whole(table.get("seed", 1), f"{where}: seed", 0, 2**63)
    axes = {key: _axis(entry, f"{where}: {key}") for key, entry in table.items() if key not in ("samples", "seed")}
    if not axes:
        raise SceneError(f"{where}: no dotted key; {RANGE}")
    _require_few(count * len(axes), where)
    places = qmc.LatinHypercube(len(axes), rng=seed).random(count)
    return [{key: axes[key](place) for key, place in zip(axes, row, strict=True)} for row in places.tolist()]


def _axis(entry: Any, where: str) -> Any:
    """A function from a place in [0, 1) to a value of this axis."""
    if not isinstance(entry, dict):
        raise SceneError(f"{where}: {RANGE}")
    if isinstance(entry.get("times"), dict):
        factor = _axis(entry["times"], f"{where}: times")
        return lambda place: value_of(entry | {"times": factor(place)}, where)
    if isinstance(entry.get("values"), list) and entry["values"] and len(entry) == 1:
        values = entry["values"]
        return lambda place: value_of(values[int(place * len(values))], where)
    for word in entry:
        if word not in WORDS:
            raise SceneError(f"{where}: {word}: unknown key; {nearest(word, WORDS)}")
    if not {"from", "to"} <= set(entry) <= {"from", "to", "scale"} or entry.get("scale", "linear") not in SCALES:
        raise SceneError(f"{where}: {RANGE}")
    return _between(entry["from"], entry["to"], entry.get("scale") == "log", where)


def _between(low: Any, high: Any, log: bool, where: str) -> Any:
    """Places between two numbers or two quantities; between two whole numbers whole ones, both ends included."""
    (a, unit), (b, other) = si(low, where), si(high, where)
    if unit != other:
        raise SceneError(f"{where}: from {low!r} to {high!r}: not of one kind; write both with a unit of the same kind")
    if not a < b or (log and a <= 0.0):
        need = " and more than 0" if log else ""
        raise SceneError(f"{where}: from {low!r} to {high!r}: from must be less than to{need}")
    if isinstance(low, int) and isinstance(high, int) and not log:
        return lambda place: low + int(place * (high - low + 1))

    def value(place: float) -> Any:
        value = a * (b / a) ** place if log else a + place * (b - a)
        return f"{value!r} {unit}" if unit else value

    return value


def si(value: Any, where: str) -> tuple[float, str]:
    """A number, or a quantity such as "0.5 MPa", as an SI value and its unit ("" for a number). Raises SceneError.

    A stress per length has the unit of a unit weight and is none: where a density is wanted, it will be read as one.
    """
    if is_number(value):
        return float(value), ""
    for kind, (_, unit, _) in KINDS.items():
        if kind == "density" and is_unit_weight(value):
            continue
        try:
            return convert(value, kind, "this"), unit
        except ValueError:
            continue
    raise SceneError(f"{where}: {value!r:.60} is no number and no quantity such as '0.5 MPa'")


def _require_few(values: int, where: str) -> None:
    if values > MOST_VALUES:
        raise SceneError(f"{where}: sets {values:.3g} values in all runs together; {MOST_VALUES} are allowed")


def _whole(value: Any, where: str, least: int, most: int) -> int:
    if not isinstance(value, int) or isinstance(value, bool) or not least <= value <= most:
        raise SceneError(f"{where}: must be a whole number from {least} to {most}, not {value!r:.60}")
    return value
