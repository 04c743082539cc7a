"""VTKHDF: a grid that stands still, written once, and its data at every frame (version 2.0 of the format).

ParaView reads a grid with time from 5.12 on (VTK 9.3), but several grids in one file only later (format 2.1): so each
grid has a file of its own.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from geometry.files.hdf5 import new_file
from masonry.rows.history import Frame

VTK_POLYGON, VTK_TETRA = 7, 10
TO_VTK = [0, 1, 2, 5, 3, 4]
"""From xx yy zz yz xz xy to VTK's xx yy zz xy yz xz."""

AT_ONCE = 2_000_000
"""Numbers that are kept to be written together: each call of HDF5 costs as much as writing a thousand."""

Data = dict[str, np.ndarray]


@dataclass(frozen=True)
class VtkCells:
    """points (n, 3) m; cell c has the points connectivity[offsets[c]:offsets[c + 1]] and is of types[c].

    still  data of the cells that is the same at every frame
    """

    points: np.ndarray
    connectivity: np.ndarray
    offsets: np.ndarray
    types: np.ndarray
    still: Data = field(default_factory=dict)

    @property
    def count(self) -> int:
        return len(self.types)


def write(
    path: Path,
    cells: VtkCells,
    frames: Sequence[Frame],
    point_data: Callable[[Frame], Data],
    cell_data: Callable[[Frame], Data],
) -> None:
    """Write the file; without frames it holds the grid and its still data only. Floats at frames are single."""
    import h5py

    with new_file(path) as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = np.array([2, 0], dtype=np.int64)
        kind = b"UnstructuredGrid"
        root.attrs.create("Type", kind, dtype=h5py.string_dtype("ascii", len(kind)))
        for name, number in (
            ("NumberOfPoints", len(cells.points)),
            ("NumberOfCells", cells.count),
            ("NumberOfConnectivityIds", len(cells.connectivity)),
        ):
            root.create_dataset(name, data=np.array([number], dtype=np.int64))
        root.create_dataset("Points", data=cells.points)
        root.create_dataset("Connectivity", data=cells.connectivity.astype(np.int64))
        root.create_dataset("Offsets", data=cells.offsets.astype(np.int64))
        root.create_dataset("Types", data=cells.types.astype(np.uint8))
        groups = root.create_group("PointData"), root.create_group("CellData")
        for name, values in cells.still.items():
            groups[1].create_dataset(name, data=values)
        if frames:
            places = zip(groups, _steps(root, frames, cells.still), (point_data, cell_data), strict=True)
            series = [_Series(*place, len(frames)) for place in places]
            together = 1
            while (done := series[0].done) < len(frames):
                for entry in series:  # points and cells of a frame one after the other: they have much in common
                    entry.write(frames[done : done + together])
                together = max(1, AT_ONCE // max(entry.numbers for entry in series))


def _steps(root: Any, frames: Sequence[Frame], still: Data) -> tuple[Any, Any]:
    """The group that says where the data of each step begin; returns its parts for points and for cells."""
    zeros = np.zeros(len(frames), dtype=np.int64)
    steps = root.create_group("Steps")
    steps.attrs["NSteps"] = np.int64(len(frames))
    steps.create_dataset("Values", data=np.array([frame.time for frame in frames], dtype=float))
    steps.create_dataset("NumberOfParts", data=zeros + 1)
    for name in ("PartOffsets", "PointOffsets"):
        steps.create_dataset(name, data=zeros)
    for name in ("CellOffsets", "ConnectivityIdOffsets"):
        steps.create_dataset(name, data=zeros[:, None])
    points, cells = steps.create_group("PointDataOffsets"), steps.create_group("CellDataOffsets")
    for name in still:
        cells.create_dataset(name, data=zeros)
    return points, cells


class _Series:
    """The data of all frames, one after the other in one dataset a field.

    numbers  of a frame      done  frames that are written
    """

    def __init__(self, group: Any, starts: Any, data_of: Callable[[Frame], Data], frames: int) -> None:
        self.group, self.starts, self.data_of, self.frames = group, starts, data_of, frames
        self.sets: dict[str, Any] = {}
        self.numbers, self.done = 1, 0

    def write(self, frames: Sequence[Frame]) -> None:
        """Write the frames that follow those written before."""
        batch = [self.data_of(frame) for frame in frames]
        if not self.sets:
            self._make(batch[0])
        for name, data in self.sets.items():
            size = len(batch[0][name])
            values = np.concatenate([frame[name] for frame in batch], dtype=np.float32, casting="same_kind")
            data[self.done * size : self.done * size + len(values)] = values
        self.done += len(frames)

    def _make(self, first: Data) -> None:
        self.numbers = max(sum(values.size for values in first.values()), 1)
        for name, values in first.items():
            shape = (self.frames * len(values), *values.shape[1:])
            self.sets[name] = self.group.create_dataset(name, shape=shape, dtype=np.float32)
            self.starts.create_dataset(name, data=np.arange(self.frames, dtype=np.int64) * len(values))
