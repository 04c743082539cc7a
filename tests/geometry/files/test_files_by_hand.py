"""What files say, with units, names and numbers that are not the usual ones."""

import math

import h5py
import meshio
import numpy as np
import pytest

from geometry.blocks import GeometryError, Specimen
from geometry.files.blocks_h5 import load_blocks, save_blocks
from geometry.files.mesh_files import read_mesh
from geometry.files.sandbox import guarded
from geometry.files.surfaces.crossings import crossing
from geometry.polyhedra.construct import from_boxes
from geometry.polyhedra.measures import bounds, volumes
from tests.geometry.files import step_files
from tests.geometry.files.test_mesh_files import tower


def test_a_mesh_in_mm_has_its_blocks_and_its_nodes_in_m(tmp_path):
    points, tets = tower(2)
    meshio.vtu.write(tmp_path / "mm.vtu", meshio.Mesh(points * 250.0, [("tetra", tets)]))
    solids = read_mesh(tmp_path / "mm.vtu", unit=1e-3)
    assert volumes(solids.blocks).sum() == pytest.approx(2 * 0.25**3)
    assert np.ptp(solids.mesh.nodes, axis=0) == pytest.approx([0.25, 0.25, 0.5])
    assert bounds(solids.blocks)[1].max(axis=0) == pytest.approx([0.25, 0.25, 0.5])


def test_groups_of_solids_are_not_called_by_groups_of_faces_of_the_same_number(tmp_path):
    points, tets = tower(1)
    tags = {"gmsh:physical": [np.ones(len(tets), int)], "gmsh:geometrical": [np.ones(6, int)]}
    names = {"a stone": np.array([1, 3])}
    path = tmp_path / "named.msh"
    mesh = meshio.Mesh(points, [("tetra", tets)], cell_data=tags, field_data=names)
    meshio.gmsh.write(path, mesh, fmt_version="2.2", binary=False)
    stone, side = '3 1 "a stone"\n', '2 1 "a side"\n'
    text = path.read_text()
    assert text.count(f"1\n{stone}") == 1
    for order in (stone + side, side + stone):
        path.write_text(text.replace(f"1\n{stone}", f"2\n{order}"))
        assert read_mesh(path).blocks.groups == ("a stone",)


def ball(tmp_path, **words):
    """A ball of 20 mm."""
    path = step_files.write_step(tmp_path / "ball.step", lambda occ: occ.addSphere(0, 0, 0, 20), ["ball"])
    return guarded("geometry.files.cad", "read_cad", path, **words)


def test_facets_are_as_far_off_a_face_as_is_asked_in_m_whatever_the_unit(tmp_path):
    exact = 4 / 3 * math.pi * 0.02**3
    fine, coarse = (volumes(ball(tmp_path, facet=facet).blocks)[0] / exact for facet in (1e-4, 4e-4))
    assert 0.985 < fine < 1.0 and fine - coarse > 5e-3
    large = ball(tmp_path, facet=0.1, unit=1.0)
    assert volumes(large.blocks)[0] == pytest.approx(exact * 1e9 * fine, rel=1e-9), "as fine, a thousand times as large"


def test_facets_that_change_a_volume_by_a_twentieth_are_refused(tmp_path):
    with pytest.raises(GeometryError, match=r"flat facets change its volume by \d+\.\d%; take a smaller --facet"):
        ball(tmp_path, facet=5e-3)


def test_triangles_that_are_pierced_by_an_edge_are_found_whichever_of_the_two_comes_first():
    """A needle through the middle of a wide triangle: none of the wide one's edges goes through the needle."""
    points = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, -1], [1, 1, 1], [1.01, 1, 3]])
    for triangles in ([[0, 1, 2], [3, 4, 5]], [[3, 4, 5], [0, 1, 2]]):
        assert crossing(points, np.array(triangles), 1e-9) == pytest.approx([1.0, 1.0, 0.0], abs=0.01)
    beside = points + np.repeat([[0.0, 0, 0], [3, 3, 0]], 3, axis=0)
    assert crossing(beside, np.array([[0, 1, 2], [3, 4, 5]]), 1e-9) is None


def test_a_set_that_names_a_block_behind_the_last_is_refused_and_without_joints_a_file_is_of_version_1(tmp_path):
    low, high = np.array([[0.0, 0, 0], [0.3, 0, 0]]), np.array([[0.3, 0.2, 0.1], [0.5, 0.2, 0.1]])
    blocks = from_boxes(low, high, np.arange(2), np.zeros(2, dtype=int), ("units",))
    path = tmp_path / "two.blocks.h5"
    save_blocks(path, Specimen(blocks, {"last": np.array([1])}))
    assert load_blocks(path)[0].sets["last"].tolist() == [1]
    with h5py.File(path, "r+") as file:
        assert b'"version": 1' in file["about"][()].tobytes()
        file["sets/0"][...] = 2
    with pytest.raises(GeometryError, match="set 'last' names blocks that do not exist"):
        load_blocks(path)
