"""fields.vtkhdf has the layout that VTK asks for, and VTK reads every step of it."""

import h5py
import numpy as np
import pytest

from masonry import fields
from tests.results.sample import opened, sample, with_tets


@pytest.fixture(params=[False, True], ids=["faces", "tets"])
def written(request, tmp_path):
    result = with_tets(sample()) if request.param else sample()
    fields.write(tmp_path / "fields.vtkhdf", result)
    return result, tmp_path / "fields.vtkhdf"


def test_the_file_has_the_attributes_and_sizes_of_the_format(written):
    result, path = written
    with h5py.File(path) as file:
        root = file["VTKHDF"]
        assert list(root.attrs["Version"]) == [2, 0]
        kind = root.attrs.get_id("Type")
        assert kind.dtype == np.dtype("S16") and root.attrs["Type"] == b"UnstructuredGrid"
        points, cells = root["NumberOfPoints"][0], root["NumberOfCells"][0]
        assert root["Points"].shape == (points, 3)
        assert root["Types"].shape == (cells,) and root["Types"].dtype == np.uint8
        assert root["Offsets"].shape == (cells + 1,) and root["Offsets"][-1] == root["NumberOfConnectivityIds"][0]
        assert root["Connectivity"].shape[0] == root["Offsets"][-1] and root["Connectivity"][:].max() < points
        steps = root["Steps"]
        assert steps.attrs["NSteps"] == 3
        np.testing.assert_allclose(steps["Values"], [frame.time for frame in result.history.frames])
        for name in ("PartOffsets", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets"):
            assert not np.any(steps[name]), "the mesh is written once"
        for kind, count in (("Point", points), ("Cell", cells)):
            assert set(steps[f"{kind}DataOffsets"]) == set(root[f"{kind}Data"])
            for name, offsets in steps[f"{kind}DataOffsets"].items():
                static = name in ("block", "group", "kind")
                assert list(offsets) == ([0, 0, 0] if static else [0, count, 2 * count])
                assert len(root[f"{kind}Data"][name]) == (count if static else 3 * count)


def test_contacts_move_with_the_mean_of_their_two_sides():
    result = sample()
    frame = result.history.frames[-1]
    moved = fields.Grid(result).point_data(result, frame)["displacement"][-len(result.joints.area) :]
    head = (frame.damage_tension > 0.5) | (frame.damage_shear > 0.5)
    np.testing.assert_allclose(moved[head], [[frame.displacement / 2, 0, 0]] * head.sum(), atol=1e-12)


def test_blocks_that_are_turned_and_strained_carry_their_contacts_exactly():
    result = sample()
    blocks = result.specimen.blocks
    gradient = np.array([[0.1, 0.3, 0.0], [-0.2, 0.0, 0.05], [0.0, 0.1, -0.3]])
    frame = opened(blocks, result.joints, 1e-4, 1)
    frame.corners[:] = blocks.points @ gradient.T + [1.0, 2.0, 3.0]
    grid = fields.Grid(result)
    moved = grid.point_data(result, frame)["displacement"]
    np.testing.assert_allclose(moved, grid.points @ gradient.T + [1.0, 2.0, 3.0], atol=1e-12)


def test_stress_is_given_in_the_order_of_vtk_and_is_zero_on_contacts():
    result = sample()
    grid = fields.Grid(result)
    stress = grid.cell_data(result.history.frames[0])["stress"]
    np.testing.assert_array_equal(stress[0], [0, 1, 2, 5, 3, 4])
    assert not stress[grid.kind == fields.CONTACT].any()


def test_vtk_reads_every_step_with_its_fields(written):
    pytest.importorskip("vtk")
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOHDF import vtkHDFReader

    result, path = written
    grid = fields.Grid(result)
    reader = vtkHDFReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    assert reader.GetNumberOfSteps() == 3
    for step, frame in enumerate(result.history.frames):
        reader.SetStep(step)
        reader.Update()
        output = reader.GetOutput()
        types = [output.GetCellType(cell) for cell in range(output.GetNumberOfCells())]
        np.testing.assert_array_equal(types, grid.types)
        np.testing.assert_array_equal(vtk_to_numpy(output.GetPoints().GetData()), grid.points)
        for name, expected in grid.point_data(result, frame).items():
            np.testing.assert_allclose(vtk_to_numpy(output.GetPointData().GetArray(name)), expected, rtol=1e-6)
        for name, expected in grid.cell_data(frame).items():
            np.testing.assert_allclose(vtk_to_numpy(output.GetCellData().GetArray(name)), expected, rtol=1e-6)
        for name in ("block", "group", "kind"):
            np.testing.assert_array_equal(vtk_to_numpy(output.GetCellData().GetArray(name)), getattr(grid, name))
