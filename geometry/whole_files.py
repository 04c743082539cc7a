"""Files appear whole or not at all: written beside the place and put there at the end."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from geometry.blocks import GeometryError


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A place of the same suffix to write to; renamed to path when all went well, removed otherwise.

    Raises GeometryError if the folder cannot be written to.
    """
    path = Path(path)
    beside = path.with_name(f".{os.getpid()}-{path.name}")
    try:
        yield beside
        os.replace(beside, path)
    except OSError as error:
        raise GeometryError(f"cannot write '{path}': {error.strerror or error}") from error
    finally:
        beside.unlink(missing_ok=True)


def require_file(path: Path, largest: int) -> int:
    """Size in bytes of a plain file that can be read and is no larger than allowed; GeometryError otherwise."""
    path = Path(path)
    if not path.exists():
        raise GeometryError(f"'{path}' does not exist")
    if not path.is_file():
        raise GeometryError(f"'{path}' is no file")
    if not os.access(path, os.R_OK):
        raise GeometryError(f"'{path}' cannot be read: permission denied")
    size = path.stat().st_size
    if size == 0:
        raise GeometryError(f"'{path}' is empty")
    if size > largest:
        raise GeometryError(f"'{path}' has {size:.3g} bytes, at most {largest:.3g} are allowed")
    return size
