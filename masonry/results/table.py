"""The rows of a run as a table: as CSV, as a table of pandas, or as one that needs nothing but numpy."""

from collections.abc import Iterator
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from masonry.rows.columns import UNITS, unit_of
from masonry.runtime.tables import columns

if TYPE_CHECKING:
    from pandas import DataFrame

SHOWN = 5
"""Rows that are printed at each end of a long table."""


def column_names(rows: dict[str, np.ndarray]) -> list[str]:
    """Displacement, stress and gauges first, then the other columns of a history."""
    first = ("displacement", "stress", *(name for name in rows if name not in UNITS))
    return [name for name in (*first, *(name for name in UNITS if name not in first)) if name in rows]


def csv_text(rows: dict[str, np.ndarray]) -> str:
    """The rows as CSV in SI units, displacement, stress and gauges first, floats to full precision."""
    names = column_names(rows)
    lines = [",".join(f"{name} [{unit_of(name)}]" for name in names)]
    columns = [np.asarray(rows[name]).tolist() for name in names]
    lines += [",".join(map(repr, values)) for values in zip(*columns, strict=True)]
    return "\n".join(lines) + "\n"


def table_of(rows: dict[str, np.ndarray]) -> "DataFrame | Table":
    """A `pandas.DataFrame` where pandas is installed, else a `Table`; both have the units in `attrs["units"]`."""
    columns = {name: np.array(rows[name]) for name in column_names(rows)}
    units = {name: unit_of(name) for name in columns}
    try:
        import pandas
    except ImportError:
        return Table(columns, units)
    frame = pandas.DataFrame(columns)
    frame.attrs["units"] = units
    return frame


class Table:
    """Columns of numbers by name, as much of `pandas.DataFrame` as a curve needs.

    `table["stress"]` is an array (n,); `columns`, `len(table)` (rows) and iteration (names) are those of pandas.
    """

    def __init__(self, columns: dict[str, np.ndarray], units: dict[str, str]) -> None:
        self._columns = columns
        self.attrs: dict[str, Any] = {"units": units}

    @property
    def columns(self) -> list[str]:
        """Their names."""
        return list(self._columns)

    def __getitem__(self, name: str) -> np.ndarray:
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(next(iter(self._columns.values()), ()))

    def _cells(self) -> list[list[str]]:
        """Heads, units and the first and last rows, in words."""
        count, dots = len(self), ["..."] * len(self._columns)
        short = count <= 2 * SHOWN + 1
        shown = range(count) if short else [*range(SHOWN), *range(count - SHOWN, count)]
        rows = [[f"{values[row]:.6g}" for values in self._columns.values()] for row in shown]
        heads = [self.columns, [f"[{unit}]" for unit in self.attrs["units"].values()]]
        return [*heads, *(rows if short else [*rows[:SHOWN], dots, *rows[SHOWN:]])]

    def __repr__(self) -> str:
        cells = self._cells()
        return "\n".join([*columns(cells, right=range(len(cells[0]))), f"{len(self)} rows"])

    def _repr_html_(self) -> str:
        names, units, *rows = ([escape(cell) for cell in line] for line in self._cells())
        head = "".join(f"<th>{name}<br>{unit}</th>" for name, unit in zip(names, units, strict=True))
        body = "".join(f"<tr>{''.join(f'<td>{cell}</td>' for cell in row)}</tr>" for row in rows)
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table><p>{len(self)} rows</p>"
