"""Files from elsewhere are read in a process of their own, so that a damaged or hostile one can do no harm here.

The reader gets limited memory, processor time and output, no standard input and an empty folder to work in. What comes
back is plain arrays. A crash, an abort or a time-out of it becomes one GeometryError. A reader whose asker was killed
takes its folder away and ends.
"""

import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from geometry.blocks import Blocks, GeometryError, Imported, TetMesh
from geometry.child_python import child_command
from geometry.files.atomic import require_file

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
    """What `module.reader(path, **words)` returns, called in a process of its own; words must be plain JSON values.

    Raises GeometryError with the reader's message, or one that says how the reader ended; also for a file that is
    missing, empty or larger than 500 MB, or a folder whose files are larger together.
    """
    path = Path(path).absolute()
    size = _size_of_folder(path) if path.is_dir() else require_file(path, LARGEST)
    seconds = min(SECONDS, START + PER_MEGABYTE * size // 1_000_000)
    patience = min(SECONDS, PATIENCE * seconds)
    theirs, ours = os.pipe()
    with open(ours, "wb"), open(theirs, "rb"), tempfile.TemporaryDirectory(prefix="masonry-") as folder:
        child = begin(json.dumps([module, reader, str(path), words, seconds]), Path(folder), theirs)
        try:
            code = child.wait(patience)
        except subprocess.TimeoutExpired:
            raise GeometryError(f"'{path.name}': reading it was stopped after {patience} s; is it damaged?") from None
        finally:
            if child.poll() is None:
                child.kill()
                child.wait()
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


def begin(task: str, folder: Path, alive: int) -> Any:
    """Start the reader in this folder, as a subprocess.Popen; `alive` is the end of a pipe whose other end is here."""
    surroundings = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    surroundings["HOME"] = str(folder)  # the CAD kernel's libraries leave settings there
    return subprocess.Popen(
        child_command("geometry.files.sandbox", task, str(alive)),
        cwd=folder,
        env=surroundings,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
        pass_fds=(alive,),
    )


def _answer(folder: Path, code: int, name: str, seconds: int) -> Imported:
    if code == SAID:
        raise GeometryError((folder / COMPLAINT).read_text(encoding="utf-8")[:4000])
    if code == LACKS_MEMORY:
        raise GeometryError(
            f"'{name}': reading it takes more than {MEMORY >> 30} GB of memory; is it damaged? "
            "Else make it smaller where it was made: a scan of 100,000 faces takes a tenth of that"
        )
    if code == -signal.SIGXCPU:
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
    for limit, most in (
        (resource.RLIMIT_AS, MEMORY),
        (resource.RLIMIT_CPU, seconds),
        (resource.RLIMIT_CORE, 0),
        (resource.RLIMIT_FSIZE, MEMORY),
    ):
        hard = resource.getrlimit(limit)[1]
        resource.setrlimit(limit, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))
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


def _end_with_asker(alive: int) -> None:
    """Nothing comes through the pipe; it ends when the process that asks is gone, and nobody waits for an answer."""
    os.read(alive, 1)
    shutil.rmtree(os.getcwd(), ignore_errors=True)
    os._exit(1)


def main() -> NoReturn:
    """The reader's process: its task, and the pipe that tells whether somebody waits for it."""
    threading.Thread(target=_end_with_asker, args=(int(sys.argv[2]),), daemon=True).start()
    sys.exit(serve(sys.argv[1]))


@contextmanager
def limited_memory(more: int) -> Iterator[None]:
    """Let the process take up `more` bytes beyond what it has; where the system cannot do this, nothing changes."""
    try:
        pages = int(Path("/proc/self/statm").read_text().split()[0])
    except (OSError, ValueError):
        yield
        return
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    wanted = pages * resource.getpagesize() + more
    bounds = [limit for limit in (soft, hard) if limit != resource.RLIM_INFINITY]
    resource.setrlimit(resource.RLIMIT_AS, (min([wanted, *bounds]), hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))
