"""fields.vtkhdf: the specimen once and its fields at every frame, for ParaView (VTKHDF 2.0, unstructured grid).

Points stand where they stood before loading; `displacement` is point data (warp by it). Cells: the faces of blocks
without tets as polygons, tets, and contact points as vertices whose displacement is the mean of their two sides.
Cell data `group` is the block group, and on contact points the contact group.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from masonry.deformation import Corners, Deformation
from masonry.hdf5 import new_file
from masonry.history import Frame

if TYPE_CHECKING:
    from masonry.results import Result

VTK_VERTEX, VTK_POLYGON, VTK_TETRA = 1, 7, 10
FACE, TET, CONTACT = 0, 1, 2
"""Cell data `kind`."""

VTK_ORDER = [0, 1, 2, 5, 3, 4]
"""From xx yy zz yz xz xy to VTK's xx yy zz xy yz xz."""

CONTACT_FIELDS = ("damage", "opening", "slip", "normal_stress", "shear_stress")


class Grid:
    """The cells of a result: points (n, 3), connectivity, offsets, types, and block, group, kind of each cell."""

    def __init__(self, result: "Result") -> None:
        blocks, mesh, joints = result.specimen.blocks, result.mesh, result.joints
        self.shape = Corners(blocks)
        tets_of = np.zeros(blocks.count, int) if mesh is None else np.diff(mesh.tet_start)
        nodes = np.zeros((0, 3)) if mesh is None else mesh.nodes
        tets = np.zeros((0, 4), int) if mesh is None else mesh.tets
        face_block = blocks.face_block()
        bare = tets_of[face_block] == 0
        sides = np.diff(blocks.face_start)
        shown = np.repeat(bare, sides)
        self.corners = np.unique(blocks.face_points[shown])
        face_points = np.searchsorted(self.corners, blocks.face_points[shown])
        contacts = len(joints.area)
        first_node = len(self.corners)
        first_contact = first_node + len(nodes)
        self.points = np.concatenate([blocks.points[self.corners], nodes, joints.point])
        self.connectivity = np.concatenate(
            [face_points, tets.ravel() + first_node, np.arange(contacts) + first_contact]
        ).astype(np.int64)
        sizes = np.concatenate([sides[bare], np.full(len(tets), 4), np.ones(contacts, int)])
        self.offsets = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)
        counts = [int(bare.sum()), len(tets), contacts]
        self.types = np.repeat([VTK_POLYGON, VTK_TETRA, VTK_VERTEX], counts).astype(np.uint8)
        self.kind = np.repeat([FACE, TET, CONTACT], counts).astype(np.int32)
        self.solids = counts[0] + counts[1]
        solid_block = np.concatenate([face_block[bare], np.repeat(np.arange(blocks.count), tets_of)])
        self.block = np.concatenate([solid_block, joints.block_a]).astype(np.int32)
        self.group = np.concatenate([blocks.group[solid_block], result.joint_group]).astype(np.int32)

    def point_data(self, result: "Result", frame: Frame) -> dict[str, np.ndarray]:
        """`displacement` (points, 3) m of one frame."""
        joints = result.joints
        field = Deformation(self.shape, frame)
        mean = 0.5 * field.at(joints.block_a, joints.point, joints.node_a, joints.corner_a, joints.share_a)
        mean += 0.5 * field.at(joints.block_b, joints.point, joints.node_b, joints.corner_b, joints.share_b)
        return {"displacement": np.concatenate([frame.corners[self.corners], frame.nodes.reshape(-1, 3), mean])}

    def cell_data(self, frame: Frame) -> dict[str, np.ndarray]:
        """Stress of blocks (cells, 6) Pa and the fields of contacts (cells,), zero on the other cells."""
        stress = np.zeros((len(self.types), 6))
        stress[: self.solids] = frame.stress[self.block[: self.solids]][:, VTK_ORDER]
        data: dict[str, np.ndarray] = {"stress": stress}
        for name in CONTACT_FIELDS:
            data[name] = np.zeros(len(self.types))
            data[name][self.solids :] = getattr(frame, name)
        return data


def write(path: Path, result: "Result") -> None:
    """Write the VTKHDF file; without frames it holds the specimen only."""
    import h5py

    grid = Grid(result)
    with new_file(path) as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = np.array([2, 0], dtype=np.int64)
        kind = b"UnstructuredGrid"
        root.attrs.create("Type", kind, dtype=h5py.string_dtype("ascii", len(kind)))
        for name, number in (
            ("NumberOfPoints", len(grid.points)),
            ("NumberOfCells", len(grid.types)),
            ("NumberOfConnectivityIds", len(grid.connectivity)),
        ):
            root.create_dataset(name, data=np.array([number], dtype=np.int64))
        root.create_dataset("Points", data=grid.points)
        root.create_dataset("Connectivity", data=grid.connectivity)
        root.create_dataset("Offsets", data=grid.offsets)
        root.create_dataset("Types", data=grid.types)
        point_data, cell_data = root.create_group("PointData"), root.create_group("CellData")
        for name in ("block", "group", "kind"):
            cell_data.create_dataset(name, data=getattr(grid, name))
        if result.history.frames:
            _write_steps(root, point_data, cell_data, grid, result)


def _write_steps(root: Any, point_data: Any, cell_data: Any, grid: Grid, result: "Result") -> None:
    """Every frame's fields one after another in one dataset a field, and where each step's part begins."""
    frames = result.history.frames
    count = len(frames)
    zeros = np.zeros(count, dtype=np.int64)
    steps = root.create_group("Steps")
    steps.attrs["NSteps"] = np.int64(count)
    steps.create_dataset("Values", data=np.array([frame.time for frame in frames], dtype=float))
    steps.create_dataset("NumberOfParts", data=zeros + 1)
    steps.create_dataset("PartOffsets", data=zeros)
    steps.create_dataset("PointOffsets", data=zeros)
    steps.create_dataset("CellOffsets", data=zeros[:, None])
    steps.create_dataset("ConnectivityIdOffsets", data=zeros[:, None])
    point_offsets, cell_offsets = steps.create_group("PointDataOffsets"), steps.create_group("CellDataOffsets")
    for name in ("block", "group", "kind"):
        cell_offsets.create_dataset(name, data=zeros)
    for number, frame in enumerate(frames):
        for target, offsets, data in (
            (point_data, point_offsets, grid.point_data(result, frame)),
            (cell_data, cell_offsets, grid.cell_data(frame)),
        ):
            for name, values in data.items():
                if number == 0:
                    shape = (count * len(values), *values.shape[1:])
                    target.create_dataset(name, shape=shape, dtype=np.float32)
                    offsets.create_dataset(name, data=np.arange(count, dtype=np.int64) * len(values))
                target[name][number * len(values) : (number + 1) * len(values)] = values
