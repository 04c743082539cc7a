import numpy as np
import pytest

from geometry.blocks import GeometryError, TetMesh
from geometry.files.export import export
from geometry.files.mesh_files import read_mesh
from geometry.joints.find import find_joints
from geometry.meshes.fan import mesh_by_fans
from geometry.meshes.fan_tets import gathered
from geometry.meshes.nonmatching import surface_joints
from geometry.meshes.tetrahedralise import mesh_blocks
from geometry.specimens.boxes import boxes
from geometry.specimens.stacked import couplet


def meshed_apart(blocks, sizes):
    """Tets in the blocks that have a size, each meshed on its own, so that neighbours do not match."""
    parts = {}
    for b, size in sizes.items():
        alone = np.arange(blocks.count) == b
        lonely = boxes([("far", (9, 9, 9), (1, 1, 1), "g", 0, (1, 1, 1))], 1.0).blocks
        parts[b] = mesh_blocks(blocks, alone, size, find_joints(lonely))[0], b
    return gathered(blocks.count, parts)


@pytest.fixture
def specimen(rotate):
    made = boxes(
        [
            ("floor", (0, 0, 0), (2, 1, 0.5), "g", 0, (1, 1, 1)),
            ("left", (0, 0, 0.5), (0.9, 1, 0.5), "g", 1, (1, 1, 1)),
            ("right", (0.9, 0, 0.5), (1.3, 0.8, 0.5), "g", 2, (1, 1, 1)),
        ],
        1.0,
    )
    return rotate(made.blocks, 23.0)[0]


@pytest.fixture(params=["all", "left and right", "left alone"])
def joined(request, specimen):
    sizes = {"all": {0: 0.4, 1: 0.25, 2: 0.33}, "left and right": {1: 0.25, 2: 0.33}, "left alone": {1: 0.25}}
    mesh = meshed_apart(specimen, sizes[request.param])
    whole = find_joints(specimen)
    return specimen, mesh, whole, surface_joints(specimen, whole, mesh)


def moments(joints, a, b):
    """Area and first moments of a joint between two blocks, about the middle."""
    which = (joints.block_a == a) & (joints.block_b == b)
    return np.concatenate([[joints.area[which].sum()], joints.area[which] @ joints.point[which]])


def test_areas_and_first_moments_are_those_of_the_joints(joined):
    specimen, _, whole, joints = joined
    for a, b in {*zip(whole.block_a.tolist(), whole.block_b.tolist(), strict=True)}:
        assert moments(joints, a, b) == pytest.approx(moments(whole, a, b), rel=1e-12, abs=1e-12)
    assert np.all(joints.area > 0)
    assert np.all(np.diff(joints.patch) >= 0)
    assert set(joints.patch) == set(range(len(joints.patch_start) - 1))


def test_every_point_is_the_weighted_mean_of_the_nodes_of_both_sides(joined):
    specimen, mesh, _, joints = joined
    meshed = np.diff(mesh.tet_start) > 0
    for block, node, corner, share in (
        (joints.block_a, joints.node_a, joints.corner_a, joints.share_a),
        (joints.block_b, joints.node_b, joints.corner_b, joints.share_b),
    ):
        between = corner[:, 0] >= 0
        assert np.array_equal(between | (node >= 0), meshed[block])
        assert not np.any(between & (node >= 0))
        place = np.einsum("nj,nji->ni", share[between], mesh.nodes[corner[between]])
        assert np.abs(place - joints.point[between]).max(initial=0.0) < 1e-13
        assert np.all(share[between] >= 0)
        assert share[between].sum(axis=1) == pytest.approx(1.0, abs=1e-15)
        assert np.all(share[~between] == 0)
        assert np.array_equal(mesh.nodes[node[node >= 0]], joints.point[node >= 0])
        low, high = mesh.node_start[block[between]], mesh.node_start[block[between] + 1]
        assert np.all((corner[between] >= low[:, None]) & (corner[between] < high[:, None]))


def test_linear_tractions_times_shape_functions_are_integrated_exactly(joined):
    """Three points in a triangle are exact to the second degree: what linear elements meet with linear openings."""
    _, mesh, whole, joints = joined
    fine = find_joints(joined[0], points_per_edge=4)
    for a, b in {*zip(whole.block_a.tolist(), whole.block_b.tolist(), strict=True)}:
        of, exact = ((j.block_a == a) & (j.block_b == b) for j in (joints, fine))
        if np.any(joints.node_a[of] >= 0) or np.any(joints.node_b[of] >= 0):
            continue
        got = np.einsum("n,ni,nj->ij", joints.area[of], joints.point[of], joints.point[of])
        want = np.einsum("n,ni,nj->ij", fine.area[exact], fine.point[exact], fine.point[exact])
        assert np.abs(got - want).max() < 1e-12


def test_matched_meshes_get_the_node_pairs_of_the_mesher():
    blocks = couplet(0.2, 0.05, 0.05, (2, 1, 1), mortar=(0.01, (3, 1, 1)), plates=0.02).blocks
    whole = find_joints(blocks)
    for meshed in (np.ones(blocks.count, dtype=bool), blocks.group == 1, blocks.group == 0):
        mesh, pairs = mesh_blocks(blocks, meshed, 0.02, whole)
        joints = surface_joints(blocks, whole, mesh)
        assert joints.corner_a is None
        rows = [
            sorted(zip(j.block_a, j.block_b, j.node_a, j.node_b, j.point.round(9).tolist(), strict=True))
            for j in (joints, pairs)
        ]
        assert rows[0] == rows[1]
        order = [np.lexsort((*j.point.round(9).T, j.node_b, j.node_a, j.block_b, j.block_a)) for j in (joints, pairs)]
        assert joints.area[order[0]] == pytest.approx(pairs.area[order[1]], rel=1e-12)


def test_a_conforming_mesh_file_gives_node_pairs_and_no_points_between(tmp_path):
    blocks = couplet(0.2, 0.05, 0.05, (2, 1, 1), mortar=(0.01, (3, 1, 1)), plates=0.02)
    whole = find_joints(blocks.blocks)
    mesh, pairs = mesh_blocks(blocks.blocks, np.ones(blocks.blocks.count, dtype=bool), 0.02, whole)
    export(tmp_path / "a.msh", blocks, mesh)
    imported = read_mesh(tmp_path / "a.msh")
    joints = surface_joints(imported.blocks, find_joints(imported.blocks), imported.mesh)
    assert joints.corner_a is None
    assert len(joints.area) == len(pairs.area)
    assert joints.area.sum() == pytest.approx(pairs.area.sum(), rel=1e-12)


def test_without_tets_nothing_changes(specimen):
    whole = find_joints(specimen)
    none = gathered(specimen.count, {})
    joints = surface_joints(specimen, whole, none)
    assert np.array_equal(joints.point, whole.point)
    assert np.array_equal(joints.patch, whole.patch)
    assert joints.corner_a is None


def test_tets_that_do_not_fill_their_block_are_refused(specimen):
    whole = find_joints(specimen)
    mesh, _ = mesh_by_fans(specimen, np.ones(specimen.count, dtype=bool), whole)
    middle = mesh.nodes.mean(axis=0)
    small = TetMesh(middle + 0.9 * (mesh.nodes - middle), mesh.node_start, mesh.tets, mesh.tet_start)
    with pytest.raises(GeometryError, match="do not fill|beyond"):
        surface_joints(specimen, whole, small)
