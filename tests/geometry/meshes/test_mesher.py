import signal
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.joints.find import find_joints
from geometry.meshes.tetrahedralise import mesh_blocks
from geometry.polyhedra.construct import concatenate, from_faces
from geometry.polyhedra.measures import bounds, volumes
from geometry.specimens.boxes import boxes
from geometry.specimens.stacked import couplet
from geometry.specimens.wallette import wallette

WALL = {
    "courses": 3,
    "units_per_course": 2,
    "unit_length": 0.24,
    "unit_height": 0.113,
    "thickness": 0.0115,
    "joint_thickness": 0.01,
}


def box(name, origin, size):
    return (name, origin, size, "g", 0, (1, 1, 1))


SPECIMENS = {
    "couplet": lambda: couplet(0.2, 0.05, 0.05, (3, 2, 1), mortar=(0.01, (2, 1, 1)), plates=0.02),
    "divided wallette": lambda: wallette(**WALL, divisions=(4, 2), plates=0.05),
    "undivided wallette": lambda: wallette(**WALL, plates=0.05),
    "island": lambda: boxes([box("floor", (0, 0, 0), (3, 3, 1)), box("post", (1, 1, 1), (1, 1, 1))], 1.0),
    "checkerboard": lambda: boxes(
        [box("floor", (0, 0, 0), (4, 4, 1)), box("a", (1, 1, 1), (1, 1, 1)), box("b", (2, 2, 1), (1, 1, 1))], 1.0
    ),
    "two remainders": lambda: boxes(
        [
            box("floor", (0, 0, 0), (3, 3, 1)),
            box("wall", (1, -1, 1), (1, 5, 1)),
            box("post", (2.25, 1, 1), (0.5, 1, 1)),
        ],
        1.0,
    ),
    "corners": lambda: boxes(
        [box("floor", (0, 0, 0), (2, 2, 1)), box("a", (0, 0, 1), (1, 1, 1)), box("b", (1, 1, 1), (1, 1, 1))], 1.0
    ),
}


SQUARE = np.array([[0, 0], [2, 0], [2, 2], [0, 2.0]])
POSTS = {
    "touching one side": [[1, 0], [1.5, 1], [0.5, 1]],
    "touching four sides": [[1, 0], [2, 1], [1, 2], [0, 1]],
    "touching two corners": [[0, 0], [1.2, 0.8], [2, 2], [0.8, 1.2]],
}


def posts_on_a_floor(prism, *outlines):
    solids = [prism(SQUARE, 0, 1), *(prism(np.array(outline, dtype=float), 1, 2) for outline in outlines)]
    return from_faces(solids, range(len(solids)), [0] * len(solids), ["g"])


def split_floor(prism):
    """A floor whose top is two coplanar faces, with a post across both."""
    bottom, top, *sides = prism(SQUARE, 0, 1)
    middle = (top[[0, 3]] + top[[1, 2]]) / 2
    left, right = np.array([top[0], middle[0], middle[1], top[3]]), np.array([middle[0], top[1], top[2], middle[1]])
    post = prism(SQUARE / 4 + 0.7, 1, 2)
    return from_faces([[bottom, left, right, *sides], post], [0, 1], [0, 0], ["g"])


@pytest.fixture(scope="module", params=[*SPECIMENS, *POSTS, "touching each other", "split floor"])
def solid(request, prism):
    """Blocks, joints, mesh and mesh joints of a specimen with every block meshed."""
    if request.param in SPECIMENS:
        blocks = SPECIMENS[request.param]().blocks
    elif request.param in POSTS:
        blocks = posts_on_a_floor(prism, POSTS[request.param])
    elif request.param == "split floor":
        blocks = split_floor(prism)
    else:
        blocks = posts_on_a_floor(prism, [[1, 0], [1.5, 0.5], [1, 1], [0.5, 0.5]], [[1, 1], [1.5, 1.5], [0.7, 1.6]])
    joints = find_joints(blocks)
    size = np.ptp(blocks.points, axis=0).max() / 8
    return blocks, joints, *mesh_blocks(blocks, np.ones(blocks.count, dtype=bool), size, joints)


def test_tets_fill_each_block_exactly_and_none_is_turned_over(solid, tet_volumes):
    blocks, _, mesh, _ = solid
    volume = tet_volumes(mesh)
    assert volume.min() > 0
    assert np.allclose(np.add.reduceat(volume, mesh.tet_start[:-1]), volumes(blocks), rtol=1e-12, atol=0)


def test_nodes_are_numbered_block_by_block_and_lie_in_their_block(solid):
    blocks, _, mesh, _ = solid
    low, high = bounds(blocks)
    for block in range(blocks.count):
        nodes = range(mesh.node_start[block], mesh.node_start[block + 1])
        tets = mesh.tets[mesh.tet_start[block] : mesh.tet_start[block + 1]]
        assert np.array_equal(np.unique(tets), nodes)
        assert np.all(mesh.nodes[nodes] >= low[block] - 1e-12)
        assert np.all(mesh.nodes[nodes] <= high[block] + 1e-12)


def test_nodes_of_both_sides_coincide_with_their_contact_point(solid):
    blocks, _, mesh, joints = solid
    assert np.all(joints.node_a >= 0)
    assert np.all(joints.node_b >= 0)
    for node, block in ((joints.node_a, joints.block_a), (joints.node_b, joints.block_b)):
        assert np.abs(mesh.nodes[node] - joints.point).max() < 1e-12
        assert np.array_equal(np.searchsorted(mesh.node_start, node, side="right") - 1, block)
    assert np.all(joints.block_a < joints.block_b)


def test_nodal_areas_keep_every_joint_s_area_and_first_moment(solid):
    _, joints, _, meshed = solid
    before, after = ([np.bincount(j.patch, j.area * value) for value in (1.0, *j.point.T)] for j in (joints, meshed))
    assert np.allclose(before, after, rtol=1e-12, atol=1e-12 * joints.area.max())


def test_two_meshings_in_one_process_are_identical():
    blocks = SPECIMENS["undivided wallette"]().blocks
    joints = find_joints(blocks)
    one, two = (mesh_blocks(blocks, np.ones(blocks.count, dtype=bool), 0.02, joints) for _ in range(2))
    for first, second in zip(one, two, strict=True):
        for name in vars(first):
            assert np.array_equal(getattr(first, name), getattr(second, name)), name


def test_unmeshed_plates_keep_no_nodes_but_take_the_points_of_their_neighbours():
    specimen = SPECIMENS["divided wallette"]()
    blocks = specimen.blocks
    joints = find_joints(blocks)
    meshed = blocks.group == blocks.groups.index("units")
    mesh, points = mesh_blocks(blocks, meshed, 0.03, joints)
    assert np.all(np.diff(mesh.tet_start)[~meshed] == 0)
    assert np.all(np.diff(mesh.node_start)[~meshed] == 0)
    at_plate = np.isin(points.block_b, np.flatnonzero(~meshed))
    assert np.all(points.node_a >= 0)
    assert np.array_equal(points.node_b < 0, at_plate)
    assert np.array_equal(mesh.nodes[points.node_a], points.point)
    assert points.area[at_plate].sum() == pytest.approx(2 * specimen.section, rel=1e-13)


def test_joints_between_unmeshed_blocks_keep_their_points():
    specimen = couplet(0.2, 0.05, 0.05, (2, 1, 1), mortar=(0.01, (2, 1, 1)))
    blocks = specimen.blocks
    joints = find_joints(blocks)
    meshed = np.zeros(blocks.count, dtype=bool)
    meshed[specimen.sets["top"]] = True
    _, points = mesh_blocks(blocks, meshed, 0.02, joints)
    kept, rest = (~meshed[j.block_a] & ~meshed[j.block_b] for j in (joints, points))
    for name in ("block_a", "block_b", "node_a", "node_b", "point", "normal", "area", "patch"):
        assert np.array_equal(getattr(joints, name)[kept], getattr(points, name)[rest])
    across = ~meshed[points.block_a] & meshed[points.block_b]
    assert np.all(points.node_a[across] == -1)
    assert np.all(points.node_b[across] >= 0)
    assert points.patch_start is joints.patch_start
    assert np.all(np.diff(points.patch) >= 0)


def test_nothing_to_mesh_leaves_the_joints_alone():
    blocks = couplet(0.2, 0.05, 0.05).blocks
    joints = find_joints(blocks)
    mesh, same = mesh_blocks(blocks, np.zeros(2, dtype=bool), 0.02, joints)
    assert same is joints
    assert len(mesh.nodes) == len(mesh.tets) == 0


def test_turned_prisms_of_any_outline_match_node_to_node(prism, rotate, tet_volumes):
    angle = 2 * np.pi * np.arange(6) / 6
    hexagon = 0.1 * np.column_stack([np.cos(angle), np.sin(angle)])
    triangle = 0.15 * np.column_stack([np.cos(angle[::2] + 0.4), np.sin(angle[::2] + 0.4)]) + 0.02
    stack = concatenate(
        [
            from_faces([prism(hexagon, 0, 0.05)], [0], [0], ["g"]),
            from_faces([prism(triangle, 0.05, 0.1)], [1], [0], ["g"]),
        ]
    )
    blocks, _ = rotate(stack, 40.0)
    joints = find_joints(blocks)
    mesh, points = mesh_blocks(blocks, np.array([True, True]), 0.03, joints)
    assert np.allclose(np.add.reduceat(tet_volumes(mesh), mesh.tet_start[:-1]), volumes(blocks), rtol=1e-12)
    assert np.abs(mesh.nodes[points.node_a] - mesh.nodes[points.node_b]).max() < 1e-12
    assert points.area.sum() == pytest.approx(joints.area.sum(), rel=1e-12)


def test_thin_walls_get_no_flat_tets(tet_volumes):
    blocks = wallette(**WALL, plates=0.05).blocks
    mesh, _ = mesh_blocks(blocks, np.ones(blocks.count, dtype=bool), 0.02, find_joints(blocks))
    corner = mesh.nodes[mesh.tets]
    one, two = np.triu_indices(4, 1)
    longest = np.linalg.norm(corner[:, one] - corner[:, two], axis=2).max(axis=1)
    assert (6 * np.sqrt(2) * tet_volumes(mesh) / longest**3).min() > 0.1


def test_gmsh_and_signal_handlers_are_left_as_found():
    import gmsh

    blocks = couplet(0.2, 0.05, 0.05).blocks
    joints = find_joints(blocks)
    handler = signal.getsignal(signal.SIGINT)
    mesh_blocks(blocks, np.array([True, False]), 0.05, joints)
    assert not gmsh.isInitialized()
    assert signal.getsignal(signal.SIGINT) is handler
    gmsh.initialize(readConfigFiles=False, interruptible=False)
    try:
        gmsh.option.setNumber("Mesh.Algorithm3D", 4)
        gmsh.model.add("of the user")
        mesh_blocks(blocks, np.array([True, False]), 0.05, joints)
        assert gmsh.model.getCurrent() == "of the user"
        assert gmsh.option.getNumber("Mesh.Algorithm3D") == 4
    finally:
        gmsh.finalize()


def test_meshing_works_outside_the_main_thread():
    blocks = couplet(0.2, 0.05, 0.05).blocks
    joints = find_joints(blocks)
    with ThreadPoolExecutor(1) as threads:
        mesh, _ = threads.submit(mesh_blocks, blocks, np.array([True, True]), 0.05, joints).result()
    assert len(mesh.tets) > 0


def test_missing_system_libraries_are_named_with_the_line_that_installs_them(monkeypatch):
    class Missing:
        def find_spec(self, name, path=None, target=None):
            if name == "gmsh":
                raise OSError("libGLU.so.1: cannot open shared object file")

    monkeypatch.delitem(sys.modules, "gmsh", raising=False)
    monkeypatch.setattr(sys, "meta_path", [Missing(), *sys.meta_path])
    blocks = couplet(0.2, 0.05, 0.05).blocks
    with pytest.raises(GeometryError, match=r"libGLU\.so\.1.*apt-get install libgl1 libglu1-mesa"):
        mesh_blocks(blocks, np.array([True, True]), 0.05, find_joints(blocks))


@pytest.mark.parametrize("size", [0.0, -0.01])
def test_a_mesh_size_must_be_positive(size):
    blocks = couplet(0.2, 0.05, 0.05).blocks
    with pytest.raises(GeometryError, match="size is"):
        mesh_blocks(blocks, np.array([True, True]), size, find_joints(blocks))
