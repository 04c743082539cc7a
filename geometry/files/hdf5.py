"""HDF5 files: written to a disk that may be full, and read though they may be damaged or hostile.

The library itself ends in crashes on a full disk, so it never hears of it. A file to read holds arrays of plain numbers
and texts that lie in the file itself; packed ones are unpacked only where the file is large enough to be worth it: a
small file must not fill the memory.
"""

import contextlib
import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

LARGEST = 16 << 30
"""Bytes of all arrays of a file together."""
PACKED, SPARE = 100, 1 << 28
"""Bytes of all arrays for each byte of the file, and besides."""
FILTERS = {1: "deflate", 2: "shuffle"}


class _Disk(io.FileIO):
    """Keeps the first error of the disk to itself."""

    error: OSError | None = None

    def write(self, content: Any) -> int:
        if self.error is None:
            try:
                remaining = memoryview(content)
                while remaining.nbytes:
                    remaining = remaining[super().write(remaining) :]
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


def require_plain(file: Any, path: Path) -> None:
    """Raise ValueError unless every member of the h5py file is a group or array of its own, and all fit into memory."""
    import h5py

    total, maximum = 0, min(LARGEST, PACKED * path.stat().st_size + SPARE)
    waiting, seen = [("", file)], {hash(file.id)}
    while waiting:
        above, group = waiting.pop()
        for name in group:
            where = f"{above}{name}"
            if not isinstance(group.get(name, getlink=True), h5py.HardLink):
                raise ValueError(f"'{where}' is a link; only what is in the file itself is read")
            member = group[name]
            if isinstance(member, h5py.Group):
                if hash(member.id) in seen:
                    raise ValueError(f"'{where}' is there twice")
                seen.add(hash(member.id))
                waiting.append((f"{where}/", member))
                continue
            total += _size(member, where)
            if total > maximum:
                raise ValueError(f"its arrays claim more than {maximum} bytes")


def _size(data: Any, where: str) -> int:
    """Bytes of an array. Raises ValueError where it lies elsewhere, is made up, or is none of numbers or texts."""
    import h5py

    if not isinstance(data, h5py.Dataset) or data.shape is None:
        raise ValueError(f"'{where}' is no array")
    if data.external is not None or data.is_virtual:
        raise ValueError(f"'{where}' lies in another file")
    if data.dtype.kind not in "iuf" and h5py.check_string_dtype(data.dtype) is None:
        raise ValueError(f"'{where}' holds neither numbers nor texts")
    plan = data.id.get_create_plist()
    used = {plan.get_filter(n)[0] for n in range(plan.get_nfilters())}
    if used - set(FILTERS):
        raise ValueError(f"'{where}' is packed in a way that is not read")
    if data.nbytes > 0 and data.id.get_storage_size() == 0:
        raise ValueError(f"'{where}' claims {data.nbytes} bytes and holds none")
    chunk = int(np.prod(data.chunks)) * data.dtype.itemsize if data.chunks else 0
    return max(int(data.nbytes), chunk)
