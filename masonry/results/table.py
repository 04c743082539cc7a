"""The rows of a run as a table: as CSV, or as a table of pandas."""

from typing import TYPE_CHECKING

import numpy as np

from masonry.errors import SceneError, extra
from masonry.rows.columns import UNITS
from masonry.rows.history import History

if TYPE_CHECKING:
    from pandas import DataFrame


DRIVE = ("displacement", "stress", "support_stress", "force")
"""Columns of a drive: of a run without one they hold zeros, and are left out."""


def column_names(rows: dict[str, np.ndarray], driven: bool = True) -> list[str]:
    """Displacement, stress and gauges first, then the other columns of a history; those of a drive where there is
    one."""
    if not driven:
        rows = {name: values for name, values in rows.items() if name not in DRIVE}
    first = ("displacement", "stress", *(name for name in rows if name not in UNITS))
    return [name for name in (*first, *(name for name in UNITS if name not in first)) if name in rows]


def csv_text(history: History, driven: bool = True) -> str:
    """The rows as CSV in SI units, displacement, stress and gauges first, floats to full precision."""
    rows, names = history.rows, column_names(history.rows, driven)
    lines = [",".join(f"{name} [{history.unit(name)}]" for name in names)]
    columns = [np.asarray(rows[name]).tolist() for name in names]
    lines += [",".join(map(repr, values)) for values in zip(*columns, strict=True)]
    return "\n".join(lines) + "\n"


def table_of(history: History, driven: bool = True) -> "DataFrame":
    """A table of pandas, units of its columns in `attrs["units"]`. Raises SceneError where there is no pandas."""
    try:
        import pandas
    except ImportError:
        raise SceneError(
            f"result.curve needs pandas; {extra('notebook')}; result.history.rows has the same columns as arrays"
        ) from None
    columns = {name: np.array(history.rows[name]) for name in column_names(history.rows, driven)}
    frame = pandas.DataFrame(columns)
    frame.attrs["units"] = {name: history.unit(name) for name in columns}
    return frame
