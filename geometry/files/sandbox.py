"""Files from elsewhere are read in a process of their own, so that a damaged or hostile one can do no harm here.

The reader gets limited memory (on Linux), processor time and output, no standard input and an empty folder to work in.
What comes back is plain arrays. A crash, an abort or a time-out of it becomes one GeometryError. A reader whose asker
was killed takes its folder away and ends.
"""

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
from importlib import import_module
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from geometry.blocks import Blocks, GeometryError, Imported, TetMesh
from geometry.child_python import child_command, end_with_parent
from geometry.files.atomic import require_file
from geometry.operating_system import SYSTEM

LARGEST = 500_000_000  # bytes of a file
MEMORY = 4 << 30  # bytes
SECONDS = 600
START, PER_MEGABYTE = 15, 60  # s of processor time, so that a small file cannot take long
PATIENCE = 10  # times as long by the clock, where others are at work
ANSWER, COMPLAINT = "answer.npz", "complaint.txt"
SAID, LACKS_MEMORY = 3, 4
BLOCKS = ("points", "face_start", "face_points", "block_face_start", "unit", "group")
MESH = ("nodes", "node_start", "tets", "tet_start")


def guarded(module: str, reader: str, path: Path | str, **words: Any) -> Imported:
    """Return value of `module.reader(path, **words)`, called in a process of its own; words must be plain JSON values.

    Raises GeometryError with the reader's message, or one that says how the reader ended; also for a file that is
    missing, empty or larger than 500 MB, or a folder whose files are larger together.
    """
    path = Path(path).absolute()
    size = _size_of_folder(path) if path.is_dir() else require_file(path, LARGEST)
    seconds = min(SECONDS, START + PER_MEGABYTE * size // 1_000_000)
    patience = min(SECONDS, PATIENCE * seconds)
    with tempfile.TemporaryDirectory(prefix="masonry-", ignore_cleanup_errors=True) as folder:
        child = begin(json.dumps([module, reader, str(path), words, seconds]), Path(folder))
        try:
            code = child.wait(patience)
        except subprocess.TimeoutExpired:
            raise GeometryError(f"'{path.name}': reading it was stopped after {patience} s; is it damaged?") from None
        finally:
            if child.poll() is None:
                child.kill()
                child.wait()
            if child.stdin is not None:
                child.stdin.close()
        return _answer(Path(folder), code, path.name, seconds)


def _size_of_folder(path: Path) -> int:
    """Bytes of the files in a folder; of files that cannot be looked at the reader says what is wrong."""
    try:
        size = sum(entry.stat().st_size for entry in os.scandir(path) if entry.is_file())
    except OSError as error:
        raise GeometryError(f"'{path}' cannot be read: {error.strerror or error}") from None
    if size > LARGEST:
        raise GeometryError(f"'{path}' holds {size:.3g} bytes, at most {LARGEST:.3g} are allowed")
    return size


def begin(task: str, folder: Path) -> Any:
    """Start the reader in this folder, as a subprocess.Popen, whose standard input tells it that it is waited for."""
    surroundings = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    return subprocess.Popen(
        child_command("geometry.files.sandbox", task),
        cwd=folder,
        env=surroundings | SYSTEM.home(folder),  # the CAD kernel's libraries leave settings there
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        **SYSTEM.apart(),
    )


def _answer(folder: Path, code: int, name: str, seconds: int) -> Imported:
    if code == SAID:
        raise GeometryError((folder / COMPLAINT).read_text(encoding="utf-8")[:4000])
    if code == LACKS_MEMORY:
        raise GeometryError(
            f"'{name}': reading it takes more than {MEMORY >> 30} GB of memory; is it damaged? "
            "Else make it smaller where it was made: a scan of 100,000 faces takes a tenth of that"
        )
    if code == SYSTEM.too_late:
        raise GeometryError(f"'{name}': reading it takes more than {seconds} s of processor time; is it damaged?")
    if code != 0:
        how = signal.Signals(-code).name if code < 0 else f"exit code {code}"
        raise GeometryError(f"'{name}' cannot be read: the reader crashed on it ({how}); it is damaged or too large")
    with np.load(folder / ANSWER, allow_pickle=False) as archive:
        words = json.loads(bytes(archive["words"]).decode())
        blocks = Blocks(**{key: archive[key] for key in BLOCKS}, groups=tuple(words["groups"]))
        mesh = TetMesh(**{key: archive[key] for key in MESH}) if MESH[0] in archive else None
        colours = archive.get("colours", None)
    return Imported(blocks, tuple(words["names"]), colours, mesh, tuple(words["notes"]))


def serve(task: str) -> int:
    """The reader's side: limits, the call, the answer as a file in the working folder; returns the exit code."""
    module, reader, path, words, seconds = json.loads(task)
    SYSTEM.limit_process(MEMORY, seconds)
    try:
        _save(getattr(import_module(module), reader)(Path(path), **words))
    except MemoryError:
        return LACKS_MEMORY
    except Exception as error:  # whatever a reader trips over must end in one message
        known = isinstance(error, GeometryError)
        text = str(error) if known else f"'{Path(path).name}' cannot be read: {type(error).__name__}: {error}"[:500]
        Path(COMPLAINT).write_text(text, encoding="utf-8", errors="replace")
        return SAID
    return 0


def _save(imported: Imported) -> None:
    words = {"names": imported.names, "notes": imported.notes, "groups": imported.blocks.groups}
    arrays = {key: getattr(imported.blocks, key) for key in BLOCKS}
    if imported.mesh is not None:
        arrays |= {key: getattr(imported.mesh, key) for key in MESH}
    if imported.colours is not None:
        arrays["colours"] = imported.colours
    text = json.dumps(words, ensure_ascii=False).encode("utf-8", "replace")
    np.savez(ANSWER, words=np.frombuffer(text, dtype=np.uint8), **arrays)


def main() -> NoReturn:
    """The reader's process, whose task is its word."""
    end_with_parent(_leave)
    sys.exit(serve(sys.argv[1]))


def _leave() -> None:
    """Take the working folder away: nobody waits for an answer."""
    folder = os.getcwd()
    os.chdir(tempfile.gettempdir())
    shutil.rmtree(folder, ignore_errors=True)
