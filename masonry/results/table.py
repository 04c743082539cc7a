"""The rows of a run as a table: as CSV, or as a table of pandas."""

from typing import TYPE_CHECKING

import numpy as np

from masonry.errors import SceneError, extra
from masonry.rows.columns import UNITS, unit_of

if TYPE_CHECKING:
    from pandas import DataFrame


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


def table_of(rows: dict[str, np.ndarray]) -> "DataFrame":
    """A table of pandas, units of its columns in `attrs["units"]`. Raises SceneError where there is no pandas."""
    try:
        import pandas
    except ImportError:
        raise SceneError(
            f"result.curve needs pandas; {extra('notebook')}; result.history.rows has the same columns as arrays"
        ) from None
    columns = {name: np.array(rows[name]) for name in column_names(rows)}
    frame = pandas.DataFrame(columns)
    frame.attrs["units"] = {name: unit_of(name) for name in columns}
    return frame
