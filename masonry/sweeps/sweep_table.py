"""The table of a sweep: one row a run, in sweep.csv, and in sweep.parquet for programs where pyarrow is installed."""

import csv
import io
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from masonry.errors import SceneError
from masonry.judgement.catalogue import criteria
from masonry.judgement.doubt import STOPPED, VERDICTS
from masonry.runtime.folders.own_files import ResultFiles
from masonry.sweeps.planned_runs import Planned
from masonry.sweeps.points import si
from masonry.sweeps.run_store import Row

TABLE, PARQUET = "sweep.csv", "sweep.parquet"
HOW = ("status", "verdict", "doubts", "warnings", "reason", "seconds")
FIRST = ("peak_stress_pa", "displacement_at_peak_m", "final_stress_pa", "energy_imbalance", "reaction_mismatch_max")
"""The numbers that one looks at first; the others follow by name."""
ERROR_BAR = "error_bar"
"""The column that says how a run has come to its bars, where a sweep has some."""


def swept(planned: Sequence[Planned]) -> list[dict[str, Any]]:
    """Values set by the sweep in each run: `KEY` as given, `KEY [unit]` in SI where it has a unit, `KEY times` where it
    was told as a factor; and `KEY used [Pa]` of tensile strengths, where some run uses less than it was told.
    """
    cut = {key for run in planned for key, strength in run.job.tensile_strengths.items() if strength.is_cut}
    keys = list(dict.fromkeys(key for run in planned for key in run.values))
    rows = []
    for run in planned:
        row: dict[str, Any] = {}
        for key in keys:
            value = row[key] = run.values.get(key)
            if key in run.times:
                row[f"{key} times"] = run.times[key]
            if isinstance(value, str):
                number, unit = _in_si(value)
                if unit:
                    row[f"{key} [{unit}]"] = number
        used = run.job.tensile_strengths
        row |= {f"{key} used [Pa]": used[key].of_law for key in sorted(cut) if key in used}
        rows.append(row)
    return rows


def _in_si(text: str) -> tuple[float, str]:
    try:
        return si(text, "")
    except SceneError:
        return 0.0, ""


def table_of(planned: Sequence[Planned], rows: Sequence[Row]) -> dict[str, list[Any]]:
    """Columns by name, in the order of the runs: index, key, what was set, HOW it went, then all numbers.

    A column holds None where a run has no such value. Only columns whose name begins with `seconds` depend on when
    and where it was run.
    """
    heads = [
        {"index": number, "key": row["key"], **values, **{name: row.get(name) for name in HOW}}
        for number, (values, row) in enumerate(zip(swept(planned), rows, strict=True))
    ]
    numbers = {name for row in rows for name in row} - {"key", *HOW}
    names = dict.fromkeys(name for head in heads for name in head if name not in HOW)
    order = (*names, *HOW, *(name for name in FIRST if name in numbers), *sorted(numbers - set(FIRST)))
    return {name: [(head | row).get(name) for head, row in zip(heads, rows, strict=True)] for name in order}


def verdicts_text(rows: Sequence[Row]) -> str:
    """How many runs have which verdict, the doubt that most of them have, and why one was stopped; "" where none has a
    verdict."""
    verdicts = Counter(row.get("verdict") for row in rows)
    words = [f"{verdicts[verdict]} {verdict}" for verdict in VERDICTS if verdicts[verdict]]
    doubts = Counter(name for row in rows if row.get("doubts") for name in row["doubts"].split(", "))
    doubts -= Counter({criterion.name: len(rows) for criterion in criteria() if criterion.verdict == STOPPED})
    most = [f"most frequent doubt: {name} ({count} of {len(rows)} runs)" for name, count in doubts.most_common(1)]
    reasons = Counter(row["reason"] for row in rows if row.get("verdict") == STOPPED and row.get("reason"))
    why = [f"stopped, for one: {reason}" for reason, _ in reasons.most_common(1)]
    return "; ".join(filter(None, [", ".join(words), *most, *why]))


def bars_text(columns: dict[str, list[Any]]) -> str:
    """How many runs were refined, and the largest error of the first number that its bars allow; "" without bars."""
    words = [word for word in columns.get(ERROR_BAR, ()) if word is not None]
    name = next((name.removesuffix(" limit") for name in columns if name.endswith(" limit")), None)
    if not words or name is None:
        return ""
    bars = zip(*(columns[key] for key in (name, f"{name} limit", f"{name} half_width")), strict=True)
    errors = [(abs(value - limit) + half) / abs(value) for value, limit, half in bars if value and limit is not None]
    largest = f"; {name} is off by up to {100 * max(errors):.2g} % (95 %)" if errors else ""
    return f"error bars: {words.count('refined')} of {len(words)} runs are refined{largest}"


def write_table(folder: Path, columns: dict[str, list[Any]]) -> tuple[str, ...]:
    """Write sweep.csv, and sweep.parquet where pyarrow is installed, all or none; their names. Raises OSError."""
    columns = {name: _of_one_type(values) for name, values in columns.items()}
    with ResultFiles(folder) as files:
        files.text(TABLE, csv_text(columns))
        try:
            import pyarrow
            from pyarrow import parquet
        except ImportError:
            return (TABLE,)
        parquet.write_table(pyarrow.table(columns), files.new(PARQUET))
    return PARQUET, TABLE


def csv_text(columns: dict[str, list[Any]]) -> str:
    """The same table as CSV, floats to full precision, nothing where there is no value."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(zip(*columns.values(), strict=True))
    return text.getvalue()


def _of_one_type(values: list[Any]) -> list[Any]:
    """Numbers, or truth values, or else texts: a column has one type."""
    present = [value for value in values if value is not None]
    if all(isinstance(value, bool) for value in present):
        return values
    if all(isinstance(value, int) and not isinstance(value, bool) for value in present):
        return values
    if all(isinstance(value, int | float) and not isinstance(value, bool) for value in present):
        return [None if value is None else float(value) for value in values]
    return [None if value is None else str(value) for value in values]
