"""Files appear whole or not at all: written beside the place and put there at the end."""

import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from geometry.blocks import GeometryError

LONGEST_NAME = 48
"""Letters of the name that the place beside keeps, so that it is no longer than a system allows."""


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A place of the same suffix to write to; renamed to path when all went well, removed otherwise.

    Raises GeometryError if the folder cannot be written to.
    """
    path = Path(path)
    if not path.name or not is_name(str(path)):
        raise GeometryError(f"cannot write '{path}': this is no name of a file")
    beside = path.with_name(f".{os.getpid()}-{path.name[-LONGEST_NAME:]}")
    try:
        yield beside
        os.replace(beside, path)
    except OSError as error:
        raise GeometryError(f"cannot write '{path}': {error.strerror or error}") from error
    finally:
        with suppress(OSError):
            beside.unlink()


def is_name(path: str) -> bool:
    """Whether a file system can have it: no NUL, no halves of letters."""
    try:
        return b"\0" not in os.fsencode(path)
    except UnicodeEncodeError:
        return False


def require_file(path: Path, largest: int) -> int:
    """Size in bytes of a plain file that can be read and is no larger than allowed; GeometryError otherwise."""
    path = Path(path)
    try:
        state = path.stat()
    except FileNotFoundError:
        raise GeometryError(f"'{path}' does not exist") from None
    except (OSError, ValueError) as error:
        raise GeometryError(f"'{path}' cannot be read: {getattr(error, 'strerror', None) or error}") from None
    if not stat.S_ISREG(state.st_mode):
        raise GeometryError(f"'{path}' is no file")
    if not os.access(path, os.R_OK):
        raise GeometryError(f"'{path}' cannot be read: permission denied")
    size = state.st_size
    if size == 0:
        raise GeometryError(f"'{path}' is empty")
    if size > largest:
        raise GeometryError(f"'{path}' has {size:.3g} bytes, at most {largest:.3g} are allowed")
    return size
