"""One process at a time in a folder: a lock that the system takes back when its holder dies, however it dies."""

import contextlib
import fcntl
import os
import socket
import time
from collections.abc import Iterator
from pathlib import Path

from masonry.errors import SceneError

LOCK = ".lock"
LONGEST = 300
"""Letters of a lock that a message repeats."""


@contextlib.contextmanager
def sole(folder: Path, doing: str) -> Iterator[None]:
    """Make the folder, and keep all others from it for a while; the file goes with the lock.

    doing  what others are told, such as "runs a sweep into it"
    Raises SceneError, saying who it is, where another process has the folder, and where it cannot be written to.
    """
    path = folder / LOCK
    try:
        folder.mkdir(parents=True, exist_ok=True)
        handle = _held(path)
        if handle is None:
            raise SceneError(f"'{folder}' is in use: {_holder(path)}; wait for its end, or name another folder")
    except OSError as error:
        raise SceneError(
            f"cannot write results to '{folder}': {error.strerror or error}; name a folder that you may write to"
        ) from None
    try:
        with contextlib.suppress(OSError):  # a full disk: the lock holds without a word
            since = time.strftime("%Y-%m-%d %H:%M:%S")
            text = f"process {os.getpid()} {doing} (on {socket.gethostname()}, since {since})"
            os.truncate(handle, 0)
            os.pwrite(handle, text.encode(), 0)
        yield
    finally:
        with contextlib.suppress(OSError):
            path.unlink(missing_ok=True)
        os.close(handle)


def _held(path: Path) -> int | None:
    """The open lock; None where another process has it. A file that its last holder has removed is no lock."""
    while True:
        handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK, 0o644)
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            os.close(handle)
            return None
        except OSError:
            os.close(handle)
            raise
        with contextlib.suppress(FileNotFoundError):
            if os.path.samestat(os.fstat(handle), os.stat(path)):
                return handle
        os.close(handle)


def _holder(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")[:LONGEST] or "another process writes to it"
    except OSError:
        return "another process writes to it"
