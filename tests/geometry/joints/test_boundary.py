import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.joints.boundary import faces_in_plane, free_faces_in_plane, outer_faces, surface_nodes
from geometry.joints.find import find_joints
from geometry.meshes.tetrahedralise import mesh_blocks
from geometry.polyhedra.construct import from_faces
from geometry.polyhedra.measures import face_areas_normals_centroids
from geometry.specimens.boxes import boxes
from geometry.specimens.stacked import couplet


@pytest.fixture(scope="module")
def divided():
    specimen = couplet(0.2, 0.05, 0.06, (3, 2, 2))
    joints = find_joints(specimen.blocks)
    meshed = np.ones(specimen.blocks.count, dtype=bool)
    return specimen, *mesh_blocks(specimen.blocks, meshed, 0.02, joints)


@pytest.mark.parametrize(
    ("direction", "area"), [("z+", 0.01), ("x-", 0.003), ("x+", 0.003), ("y-", 0.012), ("y+", 0.012)]
)
def test_outer_faces_of_a_divided_unit_cover_its_whole_side(divided, direction, area):
    specimen, mesh, joints = divided
    faces = outer_faces(specimen.blocks, joints, specimen.sets["top"], direction)
    areas, normals, _ = face_areas_normals_centroids(specimen.blocks)
    assert areas[faces].sum() == pytest.approx(area, rel=1e-14)
    assert np.all(normals[faces, "xyz".index(direction[0])] == (1 if direction[1] == "+" else -1))
    node, share = surface_nodes(mesh, specimen.blocks, faces)
    assert share.sum() == pytest.approx(area, rel=1e-12)
    assert np.all(np.diff(node) > 0)


def test_nodal_areas_of_a_face_balance_about_its_centroid(divided):
    specimen, mesh, joints = divided
    faces = outer_faces(specimen.blocks, joints, specimen.sets["top"], "z+")
    node, share = surface_nodes(mesh, specimen.blocks, faces)
    assert np.allclose(share @ mesh.nodes[node] / share.sum(), (0.1, 0.025, 0.12), atol=1e-14)
    assert np.allclose(mesh.nodes[node, 2], 0.12, atol=1e-15)


def test_a_face_in_a_joint_is_no_outer_face(divided):
    specimen, _, joints = divided
    with pytest.raises(GeometryError, match="face z- lies in a joint; outer faces there are: x-, x\\+, y-, y\\+, z\\+"):
        outer_faces(specimen.blocks, joints, specimen.sets["top"], "z-")


def test_an_unknown_direction_names_the_allowed_ones(divided):
    specimen, _, joints = divided
    with pytest.raises(GeometryError, match="'up' is unknown; allowed: x-, x\\+"):
        outer_faces(specimen.blocks, joints, specimen.sets["top"], "up")


def test_a_partly_covered_face_is_refused():
    specimen = boxes(
        [("floor", (0, 0, 0), (2, 1, 1), "g", 0, (1, 1, 1)), ("post", (0, 0, 1), (1, 1, 1), "g", 1, (1, 1, 1))], 1.0
    )
    with pytest.raises(GeometryError, match="covered by a joint over 50.0%"):
        outer_faces(specimen.blocks, find_joints(specimen.blocks), specimen.sets["floor"], "z+")


def test_covered_faces_beside_free_ones_are_left_out():
    specimen = boxes(
        [("floor", (0, 0, 0), (2, 1, 1), "g", 0, (2, 1, 1)), ("post", (0, 0, 1), (1, 1, 1), "g", 1, (1, 1, 1))], 1.0
    )
    faces = outer_faces(specimen.blocks, find_joints(specimen.blocks), specimen.sets["floor"], "z+")
    assert specimen.blocks.face_block()[faces].tolist() == [1]


def test_one_of_two_coplanar_faces_of_a_block_gets_its_own_nodes_only(prism):
    bottom, top, *sides = prism(np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]]), 0, 1)
    middle = (top[[0, 3]] + top[[1, 2]]) / 2
    halves = [np.array([top[0], *middle, top[3]]), np.array([middle[0], top[1], top[2], middle[1]])]
    blocks = from_faces([[bottom, *halves, *sides]], [0], [0], ["g"])
    joints = find_joints(blocks)
    mesh, _ = mesh_blocks(blocks, np.array([True]), 0.3, joints)
    assert outer_faces(blocks, joints, np.array([0]), "z+").tolist() == [1, 2]
    for face, centre in ((1, 0.25), (2, 0.75)):
        node, area = surface_nodes(mesh, blocks, np.array([face]))
        assert area.sum() == pytest.approx(0.5, rel=1e-13)
        assert np.allclose(area @ mesh.nodes[node] / 0.5, (centre, 0.5, 1), atol=1e-13)


def test_a_post_on_one_of_two_coplanar_faces_covers_this_one_alone(prism):
    bottom, top, *sides = prism(np.array([[0, 0], [2, 0], [2, 1], [0, 1.0]]), 0, 1)
    middle = (top[[0, 3]] + top[[1, 2]]) / 2
    halves = [np.array([top[0], *middle, top[3]]), np.array([middle[0], top[1], top[2], middle[1]])]
    post = prism(np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]]), 1, 2)
    blocks = from_faces([[bottom, *halves, *sides], post], [0, 1], [0, 0], ["g"])
    assert outer_faces(blocks, find_joints(blocks), np.array([0]), "z+").tolist() == [2]


def test_faces_of_blocks_without_tets_have_no_nodes():
    specimen = couplet(0.2, 0.05, 0.05)
    joints = find_joints(specimen.blocks)
    mesh, joints = mesh_blocks(specimen.blocks, np.array([True, False]), 0.05, joints)
    node, area = surface_nodes(mesh, specimen.blocks, outer_faces(specimen.blocks, joints, specimen.sets["top"], "z+"))
    assert len(node) == len(area) == 0


def test_a_plane_has_all_faces_in_it_and_those_that_are_free():
    specimen = boxes(
        [
            ("low", (0, 0, 0), (1, 1, 1), "g", 0, (1, 1, 1)),
            ("high", (0, 0, 1), (1, 1, 1), "g", 1, (1, 1, 1)),
            ("beside", (3, 0, 0), (1, 1, 1), "g", 2, (2, 1, 1)),
            ("hanging", (5, 0, 1), (1, 1, 1), "g", 3, (1, 1, 1)),
        ],
        1.0,
    )
    blocks, joints = specimen.blocks, find_joints(specimen.blocks)
    owner = blocks.face_block()
    assert owner[faces_in_plane(blocks, 2, 1.0)].tolist() == [0, 1, 2, 3, 4]
    assert owner[free_faces_in_plane(blocks, joints, 2, 1.0)].tolist() == [2, 3, 4]
    assert owner[free_faces_in_plane(blocks, joints, 0, 6.0 + 1e-9)].tolist() == [4]
    with pytest.raises(GeometryError, match="nearest planes with faces are z = 0 mm, z = 1000 mm, z = 2000 mm"):
        faces_in_plane(blocks, 2, 0.4)
    with pytest.raises(GeometryError, match="faces are x = 4000 mm, x = 5000 mm, x = 6000 mm$"):
        faces_in_plane(blocks, 0, 5.2)
    with pytest.raises(GeometryError, match="lie in joints"):
        free_faces_in_plane(blocks, joints, 0, 3.5)


def test_a_plane_with_a_partly_covered_face_is_refused():
    specimen = boxes(
        [("floor", (0, 0, 0), (2, 1, 1), "g", 0, (1, 1, 1)), ("post", (0, 0, 1), (1, 1, 1), "g", 1, (1, 1, 1))], 1.0
    )
    with pytest.raises(GeometryError, match="a face there of block 0 .* is covered by a joint over 50.0%"):
        free_faces_in_plane(specimen.blocks, find_joints(specimen.blocks), 2, 1.0)
