"""HDF5 files on a disk that may be full: the library itself ends in crashes there, so it never hears of it."""

import contextlib
import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any


class _Disk(io.FileIO):
    """Keeps the first error of the disk to itself."""

    error: OSError | None = None

    def write(self, content: Any) -> int:
        if self.error is None:
            try:
                left = memoryview(content)
                while left.nbytes:
                    left = left[super().write(left) :]
            except OSError as error:
                self.error = error
        return memoryview(content).nbytes

    def truncate(self, size: int | None = None) -> int:
        if self.error is None:
            try:
                return super().truncate(size)
            except OSError as error:
                self.error = error
        return size or 0


@contextlib.contextmanager
def new_file(path: Path) -> Iterator[Any]:
    """A new h5py.File. Raises OSError at its end where it could not be written."""
    import h5py

    with _Disk(path, "w+") as disk:
        with h5py.File(disk, "w") as file:
            yield file
        if disk.error is not None:
            raise disk.error
