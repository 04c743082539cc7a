"""Histories of loading as a scene gives them: turning points, a table over time, or an expression of time."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from masonry.quantity import KINDS, convert
from masonry.scene.tables import expression
from masonry.scene.tables.expression import LOOKS
from masonry.scene.tables.types import KeyedError

MOST_POINTS = 10_000
"""Turning points, or rows of a table, at most."""
CLOSER = 6
"""How often an expression is looked at more closely around a turning point."""
START = 1e-9
"""Share of the farthest displacement by which a history may miss 0 at its start."""
FLAT = 1e-12
"""Changes below this share of the farthest displacement are rounding, not motion."""
MOST_DISPLACEMENT = 1e5
"""m, farthest place of a drive."""
MOST_SHARE = 1e6
"""Of a load, largest share."""
FARTHEST = {"length": "[-1e5, 1e5]", "number": "[-1e6, 1e6]"}
FORMS = {
    "length": "a list of turning points, ['20 um', '-8 um'], a list of times and places, [['0 s', '0 mm'], "
    "['1 s', '2 mm']], or an expression of t, '0.1 mm * sin(2 pi t / 1 s)'",
    "number": "a list of times and shares, [['0 s', 0], ['1 s', 1]], or an expression of t, 'sin(2 pi t / 1 s)'",
}
Table = tuple[tuple[float, float], ...]
History = str | tuple[float, ...] | Table


@dataclass(frozen=True)
class Timed:
    """A value (m, or a share) over time: `at` takes times (n,) s from 0 to `duration` (s)."""

    duration: float
    at: Callable[[np.ndarray], np.ndarray]

    def turning_points(self) -> tuple[float, ...]:
        """The values at which it turns, in order, and the last one: to rounding, as long as no two turns lie closer
        than a ten thousandth of the duration."""
        t = np.linspace(0.0, self.duration, LOOKS)
        value = self.at(t)
        made, most = np.diff(value), float(np.abs(value).max())
        direction = np.sign(np.where(np.abs(made) > FLAT * most, made, 0.0))
        moving = np.flatnonzero(direction)
        reversals = moving[1:][direction[moving[1:]] != direction[moving[:-1]]]
        turns = [self._closer(t[max(k - 1, 0)], t[k + 1], direction[k] < 0) for k in reversals]
        places = np.array([0.0, *turns, float(value[-1])])
        return tuple(places[1:][np.abs(np.diff(places)) > START * most].tolist())

    def _closer(self, low: float, high: float, top: bool) -> float:
        """The greatest (or least) value between two times."""
        best = np.nan
        for _ in range(CLOSER):
            t = np.linspace(low, high, 41)
            value = self.at(t)
            k = int(np.argmax(value) if top else np.argmin(value))
            low, high, best = t[max(k - 1, 0)], t[min(k + 1, 40)], float(value[k])
        return best


def read(value: Any, kind: str) -> Any:
    """History of lengths ("length") or shares ("number") as a file gives it, checked: text, or tuples in SI."""
    if value is None:
        return value
    if isinstance(value, str):
        expression.read(value, kind)
        return value.strip()
    if not isinstance(value, (list, tuple)) or not value:
        raise ValueError(f"must be {FORMS[kind]}")
    if len(value) > MOST_POINTS:
        raise ValueError(f"{len(value)} points; at most {MOST_POINTS} are allowed")
    if all(isinstance(point, (list, tuple)) for point in value):
        return _table(value, kind)
    if kind != "length":
        raise ValueError(f"must be {FORMS[kind]}")
    return _reversals(value, "length", "the drive")


def read_factors(value: Any) -> Any:
    """Factors to which a load goes, one after the other."""
    if value is None:
        return value
    if not isinstance(value, (list, tuple)) or not 0 < len(value) <= MOST_POINTS:
        raise ValueError(f"must be a list of the factors to which the load goes, [0.3, -0.3, 0], {MOST_POINTS} at most")
    return _reversals(value, "number", "the load")


def _reversals(points: Any, kind: str, what: str) -> tuple[float, ...]:
    """The points to which something goes from 0, checked."""
    places = tuple(convert(point, kind, f"point {k}", FARTHEST[kind]) for k, point in enumerate(points))
    for k, (before, after) in enumerate(zip((0.0, *places), places, strict=False)):
        if before == after:
            raise ValueError(
                f"point {k}, {points[k]!r}, does not move {what}: it must differ from the one before (0 at the start)"
            )
    return places


def _table(rows: Any, kind: str) -> Table:
    """Times and values, from 0 s on."""
    table = []
    for k, row in enumerate(rows):
        if len(row) != 2:
            raise ValueError(f"row {k} must hold a time and a {KINDS[kind].words.split()[-1]}, as ['1 s', ...]")
        time = convert(row[0], "time", f"time of row {k}", "[0, 1e9]")
        table.append((time, float(convert(row[1], kind, f"value of row {k}", FARTHEST[kind]))))
        if (time != 0.0) if k == 0 else (time <= table[k - 1][0]):
            wanted = "be 0 s" if k == 0 else f"be later than the one before, {table[k - 1][0]:g} s"
            raise ValueError(f"time of row {k}, {row[0]!r}, must {wanted}")
    if len(table) < 2:
        raise ValueError("a table of one row; it must have two or more")
    return tuple(table)


def written(history: History, kind: str) -> Any:
    """As a file may hold it."""
    if isinstance(history, str):
        return history
    unit = f" {KINDS[kind].unit}" if KINDS[kind].unit else ""
    as_value: Callable[[float], Any] = (lambda x: f"{x!r}{unit}") if unit else float
    return [[f"{row[0]!r} s", as_value(row[1])] if isinstance(row, tuple) else as_value(row) for row in history]


def timed(history: History, duration: float | None, kind: str) -> Timed:
    """A table or an expression over its time. KeyedError where it has no finite value, or is not for so long."""
    if not isinstance(history, str):
        if duration is not None:
            raise KeyedError("duration", "belongs to an expression; a list has times of its own, or none; leave it out")
        from scipy.interpolate import PchipInterpolator

        table = np.array(history)
        return Timed(float(table[-1, 0]), PchipInterpolator(table[:, 0], table[:, 1]))
    if duration is None:
        raise KeyedError("duration", "missing; an expression needs it, for example duration = '4 s'")
    path = Timed(duration, expression.read(history, kind))
    try:
        most = float(np.abs(expression.require_finite(path.at, duration)).max())
    except ValueError as error:
        raise KeyedError("history", str(error)) from None
    if kind == "number" and most > MOST_SHARE:
        raise KeyedError("history", f"the expression reaches {most:.2g}; shares of at most {MOST_SHARE:g} are allowed")
    return path


def is_timed(history: History | None) -> bool:
    """Whether a history has times: it is a table or an expression."""
    return isinstance(history, str) or bool(history and isinstance(history[0], tuple))


def require_a_start_at_0(path: Timed) -> None:
    """KeyedError where a displacement does not start at 0, or never moves."""
    value = path.at(np.linspace(0.0, path.duration, LOOKS))
    most = float(np.abs(value).max())
    if most < 1e-9:
        raise KeyedError("history", f"the displacement never passes {most:.2g} m; at least 1e-9 m is needed")
    if most > MOST_DISPLACEMENT:
        raise KeyedError(
            "history", f"the displacement reaches {most:.2g} m; at most {MOST_DISPLACEMENT:g} m are allowed"
        )
    if abs(value[0]) > START * most:
        raise KeyedError("history", f"the displacement must be 0 at t = 0, and is {value[0]:.4g} m")


def checked(history: History | None, duration: float | None, kind: str) -> Timed | None:
    """The history over its time, or None where it has no times. KeyedError where its duration does not fit it."""
    if history is not None and is_timed(history):
        return timed(history, duration, kind)
    if duration is not None:
        raise KeyedError("duration", "belongs to a history that is an expression; leave it out")
    return None
