"""The errors of a scene as a key of summary.json, `numerical_error`, of the run whose numbers they are."""

from collections.abc import Sequence
from math import isfinite
from pathlib import Path

from masonry.results.records.convergence_record import NUMERICAL_ERROR, RefinedNumber, RefinedNumbers
from masonry.results.store import summary_json
from masonry.results.summary import Summary, read_summary
from masonry.runtime.folder import writing
from masonry.runtime.folders.own_files import RUNS, ResultFiles
from masonry.sweeps.convergence.refinement.numerical_errors import Ended, NumericalError
from masonry.sweeps.work import OK

SUMMARY = "summary.json"


def record_of(errors: Sequence[NumericalError], runs: Ended) -> RefinedNumbers:
    """The numbers without end, and how many times finer than the scene its runs were, by name of a resolution."""
    numbers = {
        error.answer.key: RefinedNumber(
            error.limit, error.half_width, error.order, {name: part + 0.0 for name, part in error.parts.items()}
        )
        for error in errors
        if isfinite(error.half_width)
    }
    refined = {name: 1.0 for error in errors for name in error.parts}
    for trial, row in runs:
        if row["status"] == OK:
            for name, factor in trial.members or ((trial.name, trial.factor),):
                refined |= {name: max(refined[name], factor)} if name in refined else {}
    return RefinedNumbers(numbers, refined)


def record_in_base(folder: Path, errors: Sequence[NumericalError], runs: Ended) -> None:
    """Have the run of the scene as it is, if it left a summary, hold its errors. Raises SceneError."""
    base = folder / RUNS / runs[0][1]["key"]
    if errors and runs[0][1]["status"] == OK and (base / SUMMARY).is_file():
        write_record(base, record_of(errors, runs))


def write_record(folder: Path, record: RefinedNumbers) -> None:
    """Put it into summary.json of a folder of results, and change nothing else there. Raises SceneError."""
    with writing(folder), ResultFiles(folder) as files:
        summary = Summary.read(read_summary(folder / SUMMARY)) | {NUMERICAL_ERROR: record}
        files.text(SUMMARY, summary_json(summary))
