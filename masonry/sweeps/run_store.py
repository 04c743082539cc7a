"""The folder that many runs leave their results in: one folder a run, named by its key, there whole or not at all."""

import json
from pathlib import Path
from typing import Any

from geometry.files.atomic import WholeFiles, unfinished
from geometry.operating_system import SYSTEM
from masonry.errors import SceneError
from masonry.judgement.judgement import judgement_of
from masonry.results.records.convergence_record import NUMERICAL_ERROR
from masonry.results.store import NUMBERS
from masonry.results.summary import read_summary
from masonry.runtime.folder import sweep_up, writing
from masonry.runtime.folders.own_files import RUNS
from masonry.runtime.text_files import json_of
from masonry.sweeps.work import MODES, OK, SHAPES, STATUSES, RunEnd

Row = dict[str, Any]
FAILURE = "failure.json"


class Store:
    """`folder/runs/KEY/`, a folder for each run that ended."""

    def __init__(self, folder: Path) -> None:
        self.runs = folder / RUNS
        if self.runs.is_symlink():
            raise SceneError(f"'{self.runs}' is a link, and no folder of runs: move it, or name another folder")
        with writing(folder):
            self.runs.mkdir(parents=True, exist_ok=True)
            self.sweep_up()

    def sweep_up(self) -> None:
        """Remove what a killed process left half-written."""
        sweep_up(self.runs)

    def row(self, key: str) -> Row | None:
        """The row of a run that ended; None if there is none."""
        folder = self.runs / key
        try:
            failure = _failure(folder / FAILURE)
            if failure is None and (folder / MODES).is_file():
                return _of_modes(key, folder)
            numbers = read_summary(folder / "summary.json") if (folder / "summary.json").is_file() else None
        except (OSError, SceneError):
            return None
        if failure is None and (numbers is None or not (folder / "history.h5").is_file()):
            return None
        return _row_of(key, failure, numbers or {})

    def keep(self, key: str, ended: RunEnd) -> Row:
        """Write what a run left; returns its row. Raises SceneError where it cannot be written."""
        whole, place = self.runs / unfinished(key), self.runs / key
        with writing(place, more="; what is done stays"):
            with WholeFiles(whole) as files:
                for name, content in ended.files.items():
                    files.new(name).write_bytes(content)
                if ended.status != OK:
                    failure = {"status": ended.status, "reason": ended.reason, "seconds": ended.seconds}
                    files.text(FAILURE, json.dumps(failure, indent=2) + "\n")
            _take_place(whole, place)
        row = self.row(key)
        assert row is not None
        return row


def _row_of(key: str, failure: Any, numbers: dict[str, Any]) -> Row | None:
    """The row of a run by how it failed, if it did, and its numbers; None where a file has other words than ours."""
    seconds = numbers.pop("seconds", None)
    numbers.pop(NUMERICAL_ERROR, None)  # a row is that of its run alone, whoever refined it
    how = failure or {"status": OK, "reason": "", "seconds": seconds}
    plain = isinstance(how.get("reason"), str) and isinstance(how.get("seconds"), int | float | None)
    if how.get("status") not in STATUSES or not plain:
        return None
    own = {"key": key, **{name: how.get(name) for name in ("status", "reason", "seconds")}, **_judged(numbers)}
    return own | {name: value for name, value in flat(numbers).items() if name not in own}


def _of_modes(key: str, folder: Path) -> Row | None:
    """The row of a modal analysis: the frequencies of its modes by their numbers from 1; None where it is not whole."""
    content = json_of(folder / MODES)
    modes = content.get("modes") if isinstance(content, dict) else None
    if not isinstance(modes, list) or not (folder / SHAPES).is_file():
        return None
    return {
        "key": key,
        **{"status": OK, "reason": "", "seconds": content.get("seconds")},
        **{"verdict": None, "doubts": None, "warnings": None},
        "seconds_processor_run": content.get("seconds_processor_run"),
        **{frequency_key(number): mode["frequency_hz"] for number, mode in enumerate(modes, start=1)},
    }


def frequency_key(number: int) -> str:
    """Key of the frequency of a mode in the row of a modal analysis, from 1 on."""
    return f"modes.{number}.frequency_hz"


def _take_place(whole: Path, place: Path) -> None:
    """Have a run take the place of one that ended in an error, and was tried again; what else lies there stays."""
    if place.is_symlink():
        raise SceneError(f"'{place}' is a link, and no run: move it, or name another folder")
    if place.is_dir():
        for name in (FAILURE, *NUMBERS):  # what it is known by goes first, and comes last
            (place / name).unlink(missing_ok=True)
        for name in (path.name for path in whole.iterdir() if path.name not in (FAILURE, NUMBERS[0])):
            SYSTEM.replace(whole / name, place / name)
        for name in (FAILURE, NUMBERS[0]):
            if (whole / name).exists():
                SYSTEM.replace(whole / name, place / name)
        whole.rmdir()
    else:
        SYSTEM.replace(whole, place)


def _judged(summary: dict[str, Any]) -> Row:
    """The verdict, the names of the doubts, with commas, and the warnings; None where there is no summary."""
    if not summary:
        return {"verdict": None, "doubts": None, "warnings": None}
    judgement = judgement_of(summary)
    return {
        "verdict": judgement.verdict,
        "doubts": ", ".join(dict.fromkeys(doubt.name for doubt in judgement.doubts)),
        "warnings": "; ".join(map(str, summary.get("warnings") or [])),
    }


def _failure(path: Path) -> dict[str, Any] | None:
    if not path.is_file():
        return None
    content = json_of(path)
    if not isinstance(content, dict):
        raise SceneError(f"'{path}': not a table of keys and values")
    return content


def flat(numbers: dict[str, Any], above: str = "") -> Row:
    """The numbers of a summary by dotted name, such as `energy_j.friction`; words and lists are left out."""
    row: Row = {}
    for name, value in numbers.items():
        if isinstance(value, dict):
            row |= flat(value, f"{above}{name}.")
        elif isinstance(value, bool | int | float):
            row[f"{above}{name}"] = value
    return row
