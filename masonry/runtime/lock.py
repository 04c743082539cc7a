"""One process at a time in a folder: a lock that the system takes back when its holder dies, however it dies."""

import contextlib
import os
import socket
import time
from collections.abc import Iterator
from pathlib import Path

from filelock import FileLock, Timeout

from geometry.operating_system import SYSTEM
from masonry.errors import SceneError

LOCK = ".masonry-lock"
LOCKS = (LOCK, ".lock")
"""Its name, and the one that earlier versions gave it."""
BEGINS = b"process "
LONGEST = 300
"""Letters of a lock that a message repeats."""


@contextlib.contextmanager
def sole(folder: Path, doing: str) -> Iterator[None]:
    """Make the folder, and keep all others from it for a while; the file goes with the lock.

    doing  what others are told, such as "runs a sweep into it"
    Raises SceneError, saying who it is, where another process has the folder, and where it cannot be written to.
    """
    path = folder / LOCK
    lock = FileLock(path, timeout=0, thread_local=False)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if os.path.lexists(path) and not is_lock(path):
            raise SceneError(f"'{path}' is no lock of masonry: move it, or name another folder")
        lock.acquire()
    except Timeout:
        raise SceneError(f"'{folder}' is in use: {_holder(path)}; wait for its end, or name another folder") from None
    except OSError as error:
        raise SceneError(
            f"cannot write results to '{folder}': {error.strerror or error}; name a folder that you may write to"
        ) from None
    try:
        with contextlib.suppress(OSError):  # a full disk: the lock holds without a word
            since = time.strftime("%Y-%m-%d %H:%M:%S")
            words = f"process {os.getpid()} {doing} (on {socket.gethostname()}, since {since})"
            path.write_text(words, encoding="utf-8")
        yield
    finally:
        if not SYSTEM.removes_open_files:
            lock.release()
        with contextlib.suppress(OSError):
            path.unlink(missing_ok=True)
        lock.release()


def is_lock(path: Path) -> bool:
    """Whether a file is a lock of ours: no link, and empty or with the words of a lock."""
    try:
        content = b"" if path.is_symlink() else path.read_bytes()[:LONGEST] or BEGINS
        return content.startswith(BEGINS)
    except FileNotFoundError:  # it was given back meanwhile
        return True
    except OSError as error:
        return isinstance(error, PermissionError) and not SYSTEM.reads_locked_files  # it may be in use


def _holder(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")[:LONGEST] or "another process writes to it"
    except OSError:
        return "another process writes to it"
