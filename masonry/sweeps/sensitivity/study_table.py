"""The table of a study: for a person, as CSV and as JSON; and a sentence on what the answer rests on."""

import csv
import io
import json
import textwrap
from collections.abc import Sequence
from typing import Any

from masonry.errors import visible
from masonry.runtime.progress import duration
from masonry.runtime.tables import WIDTH, columns
from masonry.sweeps.sensitivity.study import FIGURES, Figure, word_of

Row = dict[str, Any]
SMALL = 0.01
"""Deviation up to which a variant gives the same answer."""
OF_LITTLE = 0.01
"""Share of the peak: an end stress below it is compared with the peak in the sentence, not with itself."""


def text(rows: Sequence[Row]) -> str:
    """The table in columns, a line a run, and the sentence below it."""
    figures = [figure for figure in FIGURES if any(row.get(figure.key) is not None for row in rows)]
    heads = [f"{figure.name} [{figure.unit}]" if figure.unit else figure.name for figure in figures]
    lines = [["run", "verdict", *heads, "time", "doubts"], *(_words(row, figures) for row in rows)]
    lost = [f"{row['variant']}: {word_of(row)}, {row['trust_sentence']}" for row in rows if row["status"] != "OK"]
    below = [line for words in (sentence(rows), *lost) for line in textwrap.wrap(visible(words), WIDTH)]
    return "\n".join([*columns(lines), "", *below])


def _words(row: Row, figures: Sequence[Figure]) -> list[str]:
    seconds = duration(row["seconds"]) if row["seconds"] is not None else "-"
    numbers = [_figure(row, figure) for figure in figures]
    return [visible(row["variant"]), word_of(row), *numbers, seconds, visible(row["doubts"] or "")]


def _figure(row: Row, figure: Figure) -> str:
    """A number, and its deviation where it is not the base's: `0.971 +1.2 %`."""
    value, deviation = row[figure.key], row[f"{figure.key}_deviation"]
    if value is None:
        return "-"
    if row["kind"] == "base" or deviation is None:
        return f"{value * figure.factor:.4g}"
    return f"{value * figure.factor:.4g} {_percent(deviation)}"


def _percent(deviation: float) -> str:
    percent = 100.0 * deviation
    if abs(percent) < 0.005:
        return "="
    return f"{percent:+.2g} %" if abs(percent) < 100.0 else f"{percent:+.0f} %"


def sentence(rows: Sequence[Row]) -> str:
    """Sensitivity of the answer in a sentence: of each figure the largest deviation, and of which variant."""
    base, others = rows[0], [row for row in rows[1:] if row["status"] == "OK"]
    lost = [row for row in rows[1:] if row["status"] != "OK"]
    if base["status"] != "OK":
        return f"The scene as it is did not come to its end ({base['trust_sentence']}), so there is nothing to compare."
    left = f" Not compared: {_listed(lost)}." if lost else ""
    if not others:
        return f"There is nothing to compare with.{left}"
    worst = {figure: max(others, key=lambda row: _distance(row, base, figure)) for figure in FIGURES}
    moved = [
        f"the {_name(figure)} by {_told(row, base, figure)} ({row['variant']})"
        for figure, row in worst.items()
        if _distance(row, base, figure) > SMALL
    ]
    if not moved:
        return f"No variant moves any of these by more than {100 * SMALL:g} %: the answer does not rest on them.{left}"
    return f"The answer rests on these choices: they move {', '.join(moved)}.{left}"


def _name(figure: Figure) -> str:
    names = {"at": "displacement there", "end": "end stress", "dissipated": "dissipated energy"}
    return names.get(figure.name, figure.name)


def _distance(row: Row, base: Row, figure: Figure) -> float:
    """How far a figure is from the base, for the sentence."""
    deviation = row.get(f"{figure.key}_deviation")
    return abs(deviation) * _weight(base, figure) if deviation is not None else 0.0


def _weight(base: Row, figure: Figure) -> float:
    """1; of an end stress that is next to nothing beside the peak, its share of the peak."""
    end, peak = base["final_stress_pa"], base["peak_stress_pa"]
    small = figure.name == "end" and peak and abs(end) < OF_LITTLE * abs(peak)
    return abs(end / peak) if small else 1.0


def _told(row: Row, base: Row, figure: Figure) -> str:
    weight = _weight(base, figure)
    return f"{_percent(row[f'{figure.key}_deviation'] * weight)}{' of the peak' if weight < 1.0 else ''}"


def _listed(rows: Sequence[Row]) -> str:
    return ", ".join(f"{row['variant']} ({word_of(row)})" for row in rows)


def as_csv(rows: Sequence[Row]) -> str:
    """One row a run, in SI, with the settings as TOML-like words; nothing where there is no value."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(rows[0])
    for row in rows:
        settings = "; ".join(f"{key} = {value!r}" for key, value in row["settings"].items())
        writer.writerow(settings if key == "settings" else value for key, value in row.items())
    return file.getvalue()


def as_json(rows: Sequence[Row]) -> str:
    """The rows and the sentence."""
    return json.dumps({"sentence": sentence(rows), "runs": list(rows)}, indent=2) + "\n"
