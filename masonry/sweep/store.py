"""The folder that many runs leave their results in: one folder a run, named by its key, there whole or not at all."""

import contextlib
import fcntl
import json
import os
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from masonry.errors import SceneError
from masonry.folder import WholeFiles
from masonry.sweep.work import OK, Ended
from masonry.text_files import json_of

Row = dict[str, Any]
LOCK = ".lock"


@contextlib.contextmanager
def sole(folder: Path) -> Iterator[None]:
    """Make the folder, and keep all others from it for a while. Raises SceneError where another process has it."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        handle = os.open(folder / LOCK, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK, 0o644)
    except OSError as error:
        raise SceneError(
            f"cannot write results to '{folder}': {error.strerror or error}; name a folder that you may write to"
        ) from None
    try:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise SceneError(
                f"'{folder}' is in use: process {_text(handle) or 'unknown'} runs a sweep into it; wait for its end,"
                " or name another folder"
            ) from None
        try:
            os.truncate(handle, 0)
            os.pwrite(handle, str(os.getpid()).encode(), 0)
        except OSError as error:
            raise SceneError(f"'{folder / LOCK}' cannot be written: {error.strerror or error}; remove it") from None
        yield
    finally:
        os.close(handle)


def _text(handle: int) -> str:
    return os.pread(handle, 20, 0).decode(errors="replace")


class Store:
    """`folder/runs/KEY/`, a folder for each run that ended."""

    def __init__(self, folder: Path) -> None:
        self.runs = folder / "runs"
        try:
            self.runs.mkdir(parents=True, exist_ok=True)
            self.sweep_up()
        except OSError as error:
            raise SceneError(f"cannot write results to '{folder}': {error.strerror or error}") from None

    def sweep_up(self) -> None:
        """Remove what a killed process left half-written."""
        for left in self.runs.glob(".unfinished-*"):
            shutil.rmtree(left, ignore_errors=True)

    def row(self, key: str) -> Row | None:
        """The row of a run that ended; None if there is none."""
        folder = self.runs / key
        try:
            failure, numbers = _read(folder / "failure.json"), _read(folder / "summary.json")
        except (OSError, SceneError):
            return None
        if failure is None and (numbers is None or not (folder / "history.h5").is_file()):
            return None
        seconds = (numbers or {}).pop("seconds", None)
        how = failure or {"status": OK, "reason": "", "seconds": seconds}
        return {"key": key, **{name: how.get(name) for name in ("status", "reason", "seconds")}, **flat(numbers or {})}

    def keep(self, key: str, ended: Ended) -> Row:
        """Write what a run left; returns its row. Raises SceneError where it cannot be written."""
        unfinished, place = self.runs / f".unfinished-{key}", self.runs / key
        try:
            with WholeFiles(unfinished) as files:
                for name, content in ended.files.items():
                    files.new(name).write_bytes(content)
                if ended.status != OK:
                    failure = {"status": ended.status, "reason": ended.reason, "seconds": ended.seconds}
                    files.text("failure.json", json.dumps(failure, indent=2) + "\n")
            if place.exists():  # a run that ended in an error, and was tried again
                shutil.rmtree(place)
            os.rename(unfinished, place)
        except OSError as error:
            raise SceneError(
                f"cannot write results to '{place}': {error.strerror or error}; what is done stays"
            ) from None
        row = self.row(key)
        assert row is not None
        return row


def _read(path: Path) -> dict[str, Any] | None:
    if not path.is_file():
        return None
    content = json_of(path)
    if not isinstance(content, dict):
        raise SceneError(f"'{path}': not a table of keys and values")
    return content


def flat(numbers: dict[str, Any], above: str = "") -> Row:
    """The numbers of a summary by dotted name, such as `energy_j.friction`; words and lists are left out."""
    found: Row = {}
    for name, value in numbers.items():
        if isinstance(value, dict):
            found |= flat(value, f"{above}{name}.")
        elif isinstance(value, bool | int | float):
            found[f"{above}{name}"] = value
    return found
