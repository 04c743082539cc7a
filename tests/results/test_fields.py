"""fields.vtkhdf and joints.vtkhdf have the layout that VTK asks for, and VTK reads the numbers of every frame."""

import h5py
import numpy as np
import pytest

from geometry.polyhedra.measures import face_areas_normals_centroids
from geometry.polyhedra.polygons import areas_normals_centroids, pad
from masonry.results.fields import BlockGrid, write_blocks
from masonry.results.joint_fields import JointGrid, mode_of, write_joints
from tests.results.sample import opened, sample, with_tets

GRIDS = {"fields": (BlockGrid, write_blocks), "joints": (JointGrid, write_joints)}


@pytest.fixture(params=["fields", "joints"])
def kind(request):
    return request.param


@pytest.fixture(params=[False, True], ids=["faces", "tets"])
def written(request, kind, tmp_path):
    result = with_tets(sample()) if request.param else sample()
    grid, write = GRIDS[kind]
    path = tmp_path / f"{kind}.vtkhdf"
    write(path, result)
    return result, grid(result), path


def read(path):
    """The output of VTK's reader at each step, as arrays, and the times that it knows."""
    pytest.importorskip("vtk")
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
    from vtkmodules.vtkIOHDF import vtkHDFReader

    reader = vtkHDFReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    steps = []
    for step in range(max(reader.GetNumberOfSteps(), 1)):
        reader.SetStep(step)
        reader.Update()
        grid = reader.GetOutput()
        data = {}
        for part in (grid.GetPointData(), grid.GetCellData()):
            arrays = [part.GetArray(k) for k in range(part.GetNumberOfArrays())]
            data |= {array.GetName(): vtk_to_numpy(array).copy() for array in arrays}
        points = vtk_to_numpy(grid.GetPoints().GetData()).copy()
        cells = [
            [grid.GetCell(c).GetPointId(k) for k in range(grid.GetCell(c).GetNumberOfPoints())]
            for c in range(grid.GetNumberOfCells())
        ]
        steps.append((points, cells, [grid.GetCellType(c) for c in range(grid.GetNumberOfCells())], data))
    return steps, reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())


def test_the_file_has_the_attributes_and_sizes_of_the_format(written):
    result, grid, path = written
    with h5py.File(path) as file:
        root = file["VTKHDF"]
        assert list(root.attrs["Version"]) == [2, 0], "what ParaView 5.12 reads"
        assert root.attrs.get_id("Type").dtype == np.dtype("S16") and root.attrs["Type"] == b"UnstructuredGrid"
        points, cells = root["NumberOfPoints"][0], root["NumberOfCells"][0]
        assert root["Points"].shape == (points, 3)
        assert root["Types"].shape == (cells,) and root["Types"].dtype == np.uint8
        assert root["Offsets"].shape == (cells + 1,) and root["Offsets"][-1] == root["NumberOfConnectivityIds"][0]
        assert root["Connectivity"].shape[0] == root["Offsets"][-1] and root["Connectivity"][:].max() < points
        steps = root["Steps"]
        assert steps.attrs["NSteps"] == 3
        for name in ("PartOffsets", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets"):
            assert not np.any(steps[name]), "the mesh is written once"
        for kind, count in (("Point", points), ("Cell", cells)):
            assert set(steps[f"{kind}DataOffsets"]) == set(root[f"{kind}Data"])
            for name, offsets in steps[f"{kind}DataOffsets"].items():
                still = name in grid.cells.still
                assert list(offsets) == ([0, 0, 0] if still else [0, count, 2 * count])
                assert len(root[f"{kind}Data"][name]) == (count if still else 3 * count)


def test_vtk_reads_every_step_with_its_time_its_cells_and_its_fields(written):
    result, grid, path = written
    steps, times = read(path)
    frames = result.history.frames
    np.testing.assert_allclose(times, [frame.time for frame in frames])
    offsets = grid.cells.offsets
    for frame, (points, cells, types, data) in zip(frames, steps, strict=True):
        np.testing.assert_array_equal(points, grid.cells.points)
        np.testing.assert_array_equal(np.concatenate(cells), grid.cells.connectivity)
        np.testing.assert_array_equal([len(cell) for cell in cells], np.diff(offsets))
        np.testing.assert_array_equal(types, grid.cells.types)
        expected = grid.point_data(frame) | grid.cell_data(frame) | grid.cells.still
        assert set(data) == set(expected)
        for name, values in expected.items():
            np.testing.assert_allclose(data[name], values, rtol=1e-6, err_msg=name)


def test_a_corner_moves_and_a_block_is_stressed_in_the_file_as_in_the_frame(tmp_path):
    result = sample()
    write_blocks(tmp_path / "fields.vtkhdf", result)
    blocks = result.specimen.blocks
    for frame, (points, cells, _, data) in zip(result.history.frames, read(tmp_path / "fields.vtkhdf")[0], strict=True):
        corner = blocks.points.argmax(axis=0)[0]  # of the plate on the right
        place = np.flatnonzero((points == blocks.points[corner]).all(axis=1))
        np.testing.assert_allclose(data["displacement"][place], [[frame.displacement, 0, 0]] * len(place), rtol=1e-6)
        assert len(cells) == 6 * blocks.count and set(data["unit"]) == set(blocks.unit)
        np.testing.assert_allclose(data["stress"][data["block"] == 3], [frame.stress[3][[0, 1, 2, 5, 3, 4]]] * 6)


def test_a_tile_shows_the_opening_slip_and_damage_of_its_contact(tmp_path):
    result = sample()
    write_joints(tmp_path / "joints.vtkhdf", result)
    joints = result.joints
    for frame, (_, _, _, data) in zip(result.history.frames, read(tmp_path / "joints.vtkhdf")[0], strict=True):
        for name in ("opening", "slip", "normal_stress", "damage", "damage_tension", "damage_shear"):
            np.testing.assert_allclose(data[name], getattr(frame, name), rtol=1e-6, err_msg=name)
        np.testing.assert_allclose(data["opening_vector"], frame.opening[:, None] * joints.normal, rtol=1e-6)
        np.testing.assert_allclose(np.linalg.norm(data["slip_vector"], axis=1), frame.slip, rtol=1e-6)
        np.testing.assert_array_equal(data["mode"], mode_of(frame))
    assert {0.0, 1.0, 2.0} == set(data["mode"]), "the sample has joints of all three kinds"


def test_a_file_without_frames_holds_what_stands_there(kind, tmp_path):
    result = sample()
    result.history.frames = []
    grid, write = GRIDS[kind]
    write(tmp_path / "still.vtkhdf", result)
    [(points, cells, _, data)], times = read(tmp_path / "still.vtkhdf")
    assert len(cells) == grid(result).cells.count and set(data) == set(grid(result).cells.still) and not times


def test_the_tiles_of_a_joint_cover_it_once_and_look_along_its_normal():
    result = sample()
    joints, cells = result.joints, JointGrid(result).cells
    area, normal, middle = areas_normals_centroids(pad(cells.points, cells.offsets, cells.connectivity)[0])
    np.testing.assert_allclose(area, joints.area, rtol=1e-9)
    np.testing.assert_allclose(np.abs(np.einsum("ni,ni->n", normal, joints.normal)), 1.0)
    assert np.abs(np.einsum("ni,ni->n", middle - joints.point, joints.normal)).max() < 1e-12


def test_joints_move_with_the_mean_of_their_two_sides():
    result = sample()
    frame, grid = result.history.frames[-1], JointGrid(result)
    moved = grid.point_data(frame)["displacement"]
    parted = (frame.damage > 0.5)[grid.owner]
    np.testing.assert_allclose(moved[parted], [[frame.displacement / 2, 0, 0]] * parted.sum(), atol=1e-12)


def test_blocks_that_are_turned_and_strained_carry_their_joints_exactly():
    result = sample()
    blocks = result.specimen.blocks
    gradient = np.array([[0.1, 0.3, 0.0], [-0.2, 0.0, 0.05], [0.0, 0.1, -0.3]])
    frame = opened(blocks, result.joints, 1e-4, 1)
    frame.corners[:] = blocks.points @ gradient.T + [1.0, 2.0, 3.0]
    for grid in (BlockGrid(result), JointGrid(result)):
        moved = grid.point_data(frame)["displacement"]
        np.testing.assert_allclose(moved, grid.cells.points @ gradient.T + [1.0, 2.0, 3.0], atol=1e-12)
    assert np.abs(JointGrid(result).cell_data(frame)["slip_vector"]).max() < 1e-12, "nothing slid, all moved as one"


def test_the_faces_of_blocks_in_the_file_have_their_areas():
    result = sample()
    cells = BlockGrid(result).cells
    area = areas_normals_centroids(pad(cells.points, cells.offsets, cells.connectivity)[0])[0]
    np.testing.assert_allclose(area, face_areas_normals_centroids(result.specimen.blocks)[0])
