"""The folder that a run writes to: claimed by one run only, and filled with whole files or none."""

import contextlib
import os
import re
import shutil
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

from geometry.files.atomic import is_unfinished
from geometry.operating_system import SYSTEM
from masonry.errors import SceneError
from masonry.runtime.folders.own_files import LIST, require_own
from masonry.runtime.lock import LOCKS, is_lock, sole

RESULTS = Path("results")
"""Where folders go that the user does not name."""
CHECKPOINT, HOW_TO = "checkpoint", "HOW-TO-GO-ON.txt"
"""The folder of checkpoints within, and the file that tells that it is ours, by the words with which it begins."""
UNFINISHED = b"This run is not finished."


def scene_name(scene: str) -> str:
    """The name of a scene given by name or by path, fit for a folder: `my/wall 1.toml` -> `wall-1`."""
    stem = Path(scene).stem if scene.endswith(".toml") else Path(scene).name
    return re.sub(r"[^\w.+-]+", "-", stem).strip("-.") or "scene"


@contextlib.contextmanager
def writing(place: Path, what: str = "results", more: str = "") -> Iterator[None]:
    """Raises SceneError, with the reason and `more`, where the system refuses what is written in the block."""
    try:
        yield
    except OSError as error:
        raise SceneError(f"cannot write {what} to '{place}': {error.strerror or error}{more}") from None


def claim(
    scene: str, out: Path | None = None, *, overwrite: bool = False, ours: bool = False, results: Path = RESULTS
) -> Path:
    """The folder for this run: `out`, or the next free `results/<scene>-<n>`, made so that no two runs share it.

    ours  `out` holds the beginning of what is to be written there: it is gone on with
    Raises SceneError if `out` is a file, holds something (without `overwrite`) or, in the place of results, something
    that is not ours (with it), or cannot be written to.
    """
    with writing(results if out is None else out, more="; give --out a folder that you may write to"):
        folder = _next_free(results, scene_name(scene)) if out is None else _named(out, overwrite, ours)
        require_writable(folder)
    return folder


def claim_for_many(
    name: str,
    out: Path | None,
    overwrite: bool,
    difference: Callable[[Path], str | None],
    table: str,
    results: Path = RESULTS,
) -> Path:
    """The folder for many runs, which go on where they ended: `out`, or the last `results/NAME-N` if it holds their
    beginning, else the next free one.

    difference  what a folder holds instead of these runs, in words; "" where it holds them, None where neither
    table       the file that is there once all runs are done
    Raises SceneError as `claim` does, and where `out` holds other runs (without `overwrite`).
    """
    if out is None:
        last = _numbered(results, name)
        folder = results / f"{name}-{max(last)}" if last else None
        begun = folder is not None and not (folder / table).exists() and difference(folder) == ""
        return folder if folder is not None and begun else claim(name, results=results)
    other = difference(out)
    if other and not overwrite:
        raise SceneError(f"--out '{out}' holds {other}; name another folder, or add --overwrite to replace its table")
    return claim(name, out, overwrite=overwrite, ours=other == "")


def require_writable(folder: Path) -> None:
    """Raise OSError where no file can be made in a folder; none is left there, and none is touched."""
    with tempfile.TemporaryFile(dir=folder):
        pass


@contextlib.contextmanager
def claimed(scene: str, out: Path | None = None, *, overwrite: bool = False) -> Iterator[Path]:
    """As `claim`, and no other process may write there for as long; a folder that was made and stays empty goes.

    Raises SceneError as `claim` does, and where another process is at work in the folder.
    """
    existed = out is not None and out.exists()
    if out is not None and existed and not out.is_dir():
        raise SceneError(f"--out '{out}' is a file; results need a folder")
    if out is not None and not SYSTEM.is_name(str(out)):
        raise SceneError(f"--out '{out}': no folder can have this name")
    folder = claim(scene) if out is None else out
    try:
        with sole(folder, "runs a scene into it"):
            sweep_up(folder)
            if is_checkpoint(folder / CHECKPOINT):
                sweep_up(folder / CHECKPOINT)
            yield folder if out is None else claim(scene, out, overwrite=overwrite)
    finally:
        if not existed:
            with contextlib.suppress(OSError):  # it holds something
                folder.rmdir()


def sweep_up(folder: Path) -> None:
    """Remove what a killed process left unfinished in a folder; for who holds its lock."""
    for entry in folder.glob(".masonry-*"):
        if not is_unfinished(entry.name):
            continue
        if entry.is_dir() and not entry.is_symlink():
            shutil.rmtree(entry, ignore_errors=True)
        else:
            with contextlib.suppress(OSError):
                entry.unlink()


def _next_free(results: Path, name: str) -> Path:
    results.mkdir(parents=True, exist_ok=True)
    number = max(_numbered(results, name), default=0) + 1
    while True:
        folder = results / f"{name}-{number}"
        try:
            os.mkdir(folder)
            return folder
        except FileExistsError:
            number += 1


def _numbered(results: Path, name: str) -> list[int]:
    """The numbers of the folders `results/NAME-N`."""
    entries = results.iterdir() if results.is_dir() else ()
    matches = [re.fullmatch(re.escape(name) + r"-(\d+)", entry.name) for entry in entries]
    return [int(match[1]) for match in matches if match]


def _named(out: Path, overwrite: bool, ours: bool) -> Path:
    if out.exists() and not out.is_dir():
        raise SceneError(f"--out '{out}' is a file; results need a folder")
    out.mkdir(parents=True, exist_ok=True)
    there = {entry.name for entry in out.iterdir()} - {name for name in LOCKS if is_lock(out / name)}
    if not there - {LIST, CHECKPOINT} and not _holds_something(out / CHECKPOINT):
        return out  # or begun by a process that was killed
    if not (ours or overwrite):
        raise SceneError(_not_empty(out))
    require_own(out)
    if CHECKPOINT in there and not is_checkpoint(out / CHECKPOINT):
        raise SceneError(foreign_checkpoint(out / CHECKPOINT))
    return out


def _not_empty(out: Path) -> str:
    if is_checkpoint(out / CHECKPOINT) and (out / CHECKPOINT / "scene.toml").is_file():
        return (
            f"--out '{out}' holds a run that is not finished: continue it with `masonry resume {out}`, name a new "
            "folder, or add --overwrite to start again"
        )
    return f"--out '{out}' is not empty; name a new folder, or add --overwrite to replace its results"


def _holds_something(folder: Path) -> bool:
    return folder.is_symlink() or (folder.is_dir() and any(folder.iterdir())) or folder.is_file()


def is_checkpoint(folder: Path) -> bool:
    """Whether a folder is one of checkpoints that was made here: no link, and empty or with our word in it."""
    if folder.is_symlink() or not folder.is_dir():
        return False
    if all(is_unfinished(entry.name) for entry in folder.iterdir()):
        return True
    word = folder / HOW_TO
    try:
        return not word.is_symlink() and word.is_file() and word.read_bytes().startswith(UNFINISHED)
    except OSError:
        return False


def foreign_checkpoint(folder: Path) -> str:
    """Message on something in the place of checkpoints that is not ours."""
    what = "is a link" if folder.is_symlink() else "holds things and is no checkpoint of a run"
    return f"'{folder}' {what}: move it, or name another folder for the results"
