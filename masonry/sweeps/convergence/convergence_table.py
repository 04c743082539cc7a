"""The errors of a scene as a table: for a person, as CSV and as JSON."""

import csv
import io
import json
import textwrap
from collections.abc import Sequence
from math import hypot
from typing import Any

from masonry.errors import visible
from masonry.results.records.convergence_record import LIMITS_OF_USE
from masonry.runtime.progress import duration
from masonry.runtime.tables import WIDTH, columns
from masonry.sweeps.convergence.beside_resolution import BesideResolution
from masonry.sweeps.convergence.refinement.answers import BORNE
from masonry.sweeps.convergence.refinement.campaign import BASE, DRAWN, RIGID, SCATTER, TOGETHER, Refinement
from masonry.sweeps.convergence.refinement.numerical_errors import Ended, NumericalError
from masonry.sweeps.job import short_text
from masonry.sweeps.run_store import Row
from masonry.sweeps.work import OK

HEADS = ("number", "as it is", "without end", "error", "95 % bar", "order", "made up of")
NOT_IN_IT = f"{' '.join(LIMITS_OF_USE)} masonry sensitivity and masonry sweep vary these."
BOUND = "\u00a0"
"""A blank at which no line ends."""
NEGLIGIBLE = 1e-4
"""Relative error of which no more is said."""
SMALL = 0.1
"""Fraction of the whole error below which a part of it is not named."""


def text(errors: Sequence[NumericalError], runs: Ended, remarks: Sequence[str]) -> str:
    """The table in columns, a line a number, and sentences below it."""
    base = runs[0][1]
    if base["status"] != OK:
        return f"The scene as it is did not come to its end: {visible(base['reason'])}"
    lines = columns([HEADS, *(_line(error) for error in errors)]) if errors else []
    lost = [
        f"Not counted: {trial.label}, which was {row['status'].lower()}." for trial, row in runs if row["status"] != OK
    ]
    none = [] if errors else ["The run has none of the numbers that were asked for."]
    said = [*none, *map(sentence, errors[:1]), *advice(errors[:1], runs), *lost, *remarks, NOT_IN_IT]
    below = [line for words in said for line in _wrapped(visible(words))]
    return "\n".join([*lines, "", *_run_lines(runs), "", *below])


def _wrapped(words: str) -> list[str]:
    """Lines of a sentence, none of which begins with a sign of per cent."""
    return [line.replace(BOUND, " ") for line in textwrap.wrap(words.replace(" %", f"{BOUND}%"), WIDTH)]


def _line(error: NumericalError) -> list[str]:
    answer = error.answer
    name = f"{answer.words} [{answer.unit}]" if answer.unit else answer.words
    numbers = [f"{number * answer.factor:.4g}" for number in (error.value, error.limit)]
    parts = [f"{name} {_relative(part, error)}" for name, part in ranked(error)]
    hidden = error.order is None or error.at_most <= NEGLIGIBLE * abs(error.value)
    order = "-" if hidden else f"{error.order:.1f}"
    return [
        name,
        *numbers,
        _relative(error.error, error),
        f"\u00b1{_relative(error.half_width, error).lstrip('+')}",
        order,
        ", ".join(parts) or "-",
    ]


def ranked(error: NumericalError) -> list[tuple[str, float]]:
    """Parts of an error that count, the largest first, scatter among them."""
    parts = sorted(error.parts.items(), key=lambda part: -abs(part[1]))
    whole = max(SMALL * hypot(*error.parts.values()), NEGLIGIBLE * abs(error.value))
    return [(name, part) for name, part in parts if abs(part) > whole]


def _relative(part: float, error: NumericalError) -> str:
    """In per cent of the number of the scene, with two digits."""
    if not error.value:
        return f"{part * error.answer.factor:+.2g}"
    percent = 100.0 * part / abs(error.value)
    if abs(percent) < 0.005:
        return "0 %"
    return f"{percent:+.2g} %" if abs(percent) < 100.0 else f"{percent:+.0f} %"


def sentence(error: NumericalError) -> str:
    """The error of one number, in words."""
    words = error.answer.words
    if error.at_most >= abs(error.value):
        return f"The resolution of this scene does not tell its {words}: its error may be as large as itself."
    if error.at_most <= NEGLIGIBLE * abs(error.value):
        return f"The {words} of this scene has no error of resolution that is worth a word."
    if abs(error.error) <= error.half_width:
        return (
            f"The {words} of this scene is within {_relative(error.at_most, error).lstrip('+')} of what the same model "
            "gives when it is refined without end (95 %)."
        )
    way = "high" if error.error > 0.0 else "low"
    ends = sorted(abs(error.error) + sign * error.half_width for sign in (-1.0, 1.0))
    between = " to ".join(_relative(end, error).lstrip("+") for end in ends)
    size = _relative(abs(error.error), error).lstrip("+")
    return (
        f"The {words} of this scene is {size} too {way}, by {between} (95 %): so far is it from what the "
        "same model gives when it is refined without end."
    )


def advice(errors: Sequence[NumericalError], runs: Ended) -> list[str]:
    """The price of a smaller error: the setting of the largest part of it, and how much longer that run took."""
    said = []
    for error in errors:
        if error.at_most <= NEGLIGIBLE * abs(error.value):
            continue
        for name, _ in ranked(error)[:1]:
            finer = [(t, row) for t, row in runs if t.name == name and t.factor > 1.0 and row["status"] == OK]
            if not finer:
                continue
            trial = finer[0][0]
            said.append(
                f"Most of that comes from {name}: {settings_words(trial)} takes about {trial.cost:.2g} times as long."
            )
        if error.interval > 0.5 * error.half_width:
            where = "between what was borne and what fell: a smaller limit.accuracy makes it narrower"
            said.append(
                f"Most of the bar is the interval {where if error.answer.key == BORNE else 'between two steps'}."
            )
        elif max(error.unseen.values(), default=0.0) > 0.5 * error.half_width:
            name = max(error.unseen, key=lambda name: error.unseen[name])
            said.append(f"Most of the bar is {name}: as yet the outermost row of joints that turn bears alone.")
        elif error.scatter > 0.5 * error.half_width:
            said.append("Most of the bar is scatter: runs that differ in nothing of meaning differ by as much.")
    return said


def settings_words(trial: Refinement) -> str:
    """Settings as a person gives them."""
    return ", ".join(f"{key} = {_value(value)}" for key, value in trial.settings.items())


def _value(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {part}" for key, part in value.items()) + "}"
    return short_text(value)


def _run_lines(runs: Ended) -> list[str]:
    lines = [["run", "sets", "verdict", "time"]]
    for trial, row in runs:
        seconds = row.get("seconds_processor_run")
        verdict = (row["verdict"] or "-") if row["status"] == OK else row["status"].lower()
        took = duration(seconds) if isinstance(seconds, float) else "-"
        lines.append([trial.label, settings_words(trial) or "-", visible(f"{verdict}"), took])
    return columns(lines)


def as_csv(errors: Sequence[NumericalError], besides: Sequence[BesideResolution] = ()) -> str:
    """One row a number, in SI; columns of what is beside its error where something is."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    others = {item.answer.key: item.as_data() for item in besides}
    heads = tuple(others[errors[0].answer.key]) if others else ()
    writer.writerow(("number", "value", "limit", "error", "half_width", "order", "scatter", "parts", *heads))
    for error in errors:
        parts = "; ".join(f"{name} = {part!r}" for name, part in error.parts.items())
        order = "" if error.order is None else error.order
        row = (error.answer.key, error.value, error.limit, error.error, error.half_width, order, error.scatter, parts)
        writer.writerow((*row, *others.get(error.answer.key, {}).values()))
    return file.getvalue()


def as_json(
    errors: Sequence[NumericalError], besides: Sequence[BesideResolution], runs: Ended, remarks: Sequence[str]
) -> str:
    """The errors, what is beside them, and the runs that they come from."""
    others = {item.answer.key: item.as_data() for item in besides}
    numbers = [
        {
            "number": error.answer.key,
            "value": error.value,
            "limit": error.limit,
            "error": error.error,
            "half_width": error.half_width,
            "order": error.order,
            "scatter": error.scatter,
            "parts": error.parts,
            "sentence": sentence(error),
            **others.get(error.answer.key, {}),
        }
        for error in errors
    ]
    table = [_of_run(trial, row) for trial, row in runs]
    return json.dumps({"numbers": numbers, "runs": table, "remarks": list(remarks)}, indent=2) + "\n"


def _of_run(trial: Refinement, row: Row) -> dict[str, Any]:
    kinds = {BASE: "base", SCATTER: "scatter", TOGETHER: "together", DRAWN: "drawn", RIGID: "rigid"}
    return {
        "name": trial.name,
        "kind": kinds.get(trial.name, "resolution"),
        "factor": trial.factor,
        "settings": trial.settings,
        "status": row["status"],
        "verdict": row["verdict"],
        "seconds_processor_run": row.get("seconds_processor_run"),
        "key": row["key"],
    }
