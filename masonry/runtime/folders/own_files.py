"""The files that masonry wrote into a folder of results: none but these is ever replaced or deleted there.

A picture or a page holds our mark. All others stand in a list in the folder, with a mark of what they hold: what
another program put there under a name of ours, what was changed since, and a link, is not ours. A folder of an earlier
version has no list: it is known by the tables that it holds, and then its files are ours by their names.
"""

import hashlib
import json
import os
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from geometry.files.atomic import WholeFiles, is_unfinished
from masonry.errors import SceneError
from masonry.runtime.named_file import FORMATS, is_marked
from masonry.runtime.text_files import json_of

LIST = ".masonry-files.json"
RUNS = "runs"
MARKED = tuple(f".{form}" for form in (*FORMATS, "html"))
"""Suffixes of files that hold our mark."""
PICTURES = (
    *("curve", "cracks", "mechanism", "thrust", "envelope", "modes", "sweep", "sweep-map", "sensitivity"),
    *("fragility", "spectrum", "convergence"),
)
NUMBERS = (
    *("summary.json", "curve.csv", "resultants.csv", "history.h5", "scene.toml", "run.log", "fields.vtkhdf"),
    *("joints.vtkhdf", "limit.json", "envelope.csv", "modes.json", "sensitivity.json", "sensitivity.csv"),
    *("sweep.toml", "sweep.csv", "sweep.parquet", "fragility.csv", "fragility.json", "spectrum.csv"),
    *("convergence.csv", "convergence.json", "converged.toml"),
)
WRITTEN = (*NUMBERS, *(f"{picture}.{form}" for picture in PICTURES for form in FORMATS), "report.html")
"""What commands write into a folder of results, but for its folders."""
TABLES = {
    "summary.json": {"scene", "law", "kinematics", "blocks", "steps"},
    "limit.json": {"scene", "factor", "mechanism"},
    "modes.json": {"scene", "freedoms", "closed_contacts"},
    "sensitivity.json": {"sentence", "runs"},
    "convergence.json": {"numbers", "runs"},
}
"""Some keys of each table, by which the results of an earlier version are known."""
ENDS = 65_536
"""Bytes at both ends of a file, of which and of its size its mark is made."""
GENERATIONS = 2
"""Marks of one file that the list keeps: a process may die between the list and the file."""


class ResultFiles(WholeFiles):
    """Files of a folder of results, each whole or not at all, in place of files of ours only, and entered in its list.

    Raises SceneError where another file is in the place of one, and then none is written.
    """

    def settle(self, files: Mapping[str, Path]) -> None:
        require_own(self.folder, files)
        enter(self.folder, {name: _mark(path) for name, path in files.items() if not _holds_mark(name)})


def require_own(folder: Path, names: Iterable[str] = WRITTEN) -> None:
    """Raise SceneError where a folder holds a file of such a name that is not ours."""
    there = [name for name in names if os.path.lexists(folder / name)]
    entries = _entries(folder) if there else {}
    for name in there:
        if not _is_own(folder, name, entries):
            raise SceneError(
                f"'{folder / name}' was not written by masonry, or was changed since, and would be replaced: move it, "
                "or name another folder"
            )


def remove_own(folder: Path, *names: str) -> None:
    """Remove files of ours; what is not ours stays. Raises OSError."""
    entries = _entries(folder)
    for name in names:
        if _is_own(folder, name, entries):
            (folder / name).unlink()


def enter(folder: Path, marks: dict[str, str]) -> None:
    """Put files into the list of a folder. Raises OSError, and SceneError where a list there is not ours."""
    if not marks:
        return
    path, entries = folder / LIST, _entries(folder)
    if os.path.lexists(path) and _listed(path) is None:
        raise SceneError(f"'{path}' is no list of masonry: move it, or name another folder")
    entries |= {name: [*entries.get(name, []), mark][-GENERATIONS:] for name, mark in marks.items()}
    with WholeFiles(folder) as files:
        says = "written by masonry, which replaces these files, as long as they are as it left them, and no others"
        files.text(LIST, json.dumps({"is": says, "files": entries}, indent=1) + "\n")


def is_folder_of_runs(folder: Path) -> bool:
    """Whether a folder is one in which a sweep keeps its runs: no link, and all in it are folders called by keys."""
    if folder.is_symlink() or not folder.is_dir():
        return False
    there = [path for path in folder.iterdir() if not is_unfinished(path.name)]
    return all(re.fullmatch(r"[0-9a-f]{20}", path.name) and path.is_dir() and not path.is_symlink() for path in there)


def _holds_mark(name: str) -> bool:
    return name.endswith(MARKED)


def _is_own(folder: Path, name: str, entries: dict[str, list[str]]) -> bool:
    path = folder / name
    if path.is_symlink() or not path.is_file():
        return False
    try:
        return is_marked(path) if _holds_mark(name) else _mark(path) in entries.get(name, ())
    except OSError:
        return False


def _entries(folder: Path) -> dict[str, list[str]]:
    """The marks of each file of ours by its name."""
    listed = _listed(folder / LIST)
    if listed is not None:
        return listed
    if not _is_of_earlier_version(folder):
        return {}
    paths = [folder / name for name in NUMBERS]
    return {path.name: [_mark(path)] for path in paths if path.is_file() and not path.is_symlink()}


def _listed(path: Path) -> dict[str, list[str]] | None:
    """Entries of a list of files; None where there is no list, or one that is not ours."""
    content = _table(path)
    entries = content.get("files") if content is not None else None
    if not isinstance(entries, dict) or not all(isinstance(marks, list) for marks in entries.values()):
        return None
    return entries


def _is_of_earlier_version(folder: Path) -> bool:
    """Whether a folder without a list holds results."""
    if any(keys <= (_table(folder / name) or {}).keys() for name, keys in TABLES.items()):
        return True
    return (folder / "sweep.toml").is_file() and is_folder_of_runs(folder / RUNS)


def _table(path: Path) -> dict[str, Any] | None:
    """The table of a JSON file; None where it is none, or a link."""
    if path.is_symlink() or not path.is_file():
        return None
    try:
        content = json_of(path)
    except SceneError:
        return None
    return content if isinstance(content, dict) else None


def _mark(path: Path) -> str:
    """Mark that tells a file from others: its size, and a hash of both of its ends. Raises OSError."""
    size, digest = path.stat().st_size, hashlib.blake2b(digest_size=16)
    with path.open("rb") as file:
        digest.update(file.read(ENDS))
        file.seek(max(size - ENDS, 0))
        digest.update(file.read(ENDS))
    return f"{size}-{digest.hexdigest()}"
