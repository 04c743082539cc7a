"""Files appear whole or not at all: written beside the place and put there at the end."""

import contextlib
import errno
import os
import re
import stat
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import TracebackType

from geometry.errors import GeometryError
from geometry.operating_system import SYSTEM

LONGEST_NAME = 48
"""Letters of the name that the place beside keeps, so that it is no longer than a system allows."""


def unfinished(name: str) -> str:
    """Name of a file or folder in this process until it is whole: one that nobody else gives, as what a killed process
    left of it is deleted."""
    return f".masonry-{os.getpid()}-unfinished-{name[-LONGEST_NAME:]}"


def is_unfinished(name: str) -> bool:
    """Whether a process of ours called something so."""
    return re.fullmatch(r"\.masonry-\d+-unfinished-.+", name, re.DOTALL) is not None


@contextlib.contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A place of the same suffix to write to; renamed to path when all went well, removed otherwise.

    Raises GeometryError if the folder cannot be written to.
    """
    path = Path(path)
    if not path.name or not SYSTEM.is_name(str(path)):
        raise GeometryError(f"cannot write '{path}': this is no name of a file")
    if not path.parent.is_dir():
        raise GeometryError(f"cannot write '{path}': {os.strerror(errno.ENOENT)}")
    try:
        with WholeFiles(path.parent) as files:
            yield files.new(path.name)
    except OSError as error:
        raise GeometryError(f"cannot write '{path}': {error.strerror or error}") from error


class WholeFiles:
    """Writes several files so that each one appears whole or not at all.

    Within the `with` block, `new(name)` gives a temporary path in the same folder to write to. At the end all of them
    are flushed to the disk and take their names; if anything was raised, none does and the temporary files go.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._temporary: dict[str, Path] = {}

    def new(self, name: str) -> Path:
        """The path to write the file `name` to."""
        self._temporary[name] = self.folder / unfinished(name)
        return self._temporary[name]

    def text(self, name: str, content: str) -> None:
        """Write a text file, UTF-8 with newlines as they are."""
        self.new(name).write_text(content, encoding="utf-8", newline="\n")

    def settle(self, files: Mapping[str, Path]) -> None:
        """Questions or actions of a subclass once all files are written, by their names and where they are so far, and
        before they take their names."""

    def __enter__(self) -> "WholeFiles":
        self.folder.mkdir(parents=True, exist_ok=True)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            if kind is None:
                for path in self._temporary.values():
                    SYSTEM.flush(path)
                self.settle(self._temporary)
                for name, path in self._temporary.items():
                    SYSTEM.replace(path, self.folder / name)
                SYSTEM.flush(self.folder)
        finally:
            for path in self._temporary.values():
                with contextlib.suppress(PermissionError):  # it is still open, which some systems mind; swept up later
                    path.unlink(missing_ok=True)


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
