import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.cells.domain import box_domain
from geometry.cells.power import tessellate
from geometry.cells.power_blocks import to_blocks
from geometry.joints.find import find_joints
from geometry.joints.quality import radius_ratios
from geometry.meshes import tetrahedralise as mesher
from geometry.meshes.fan import mesh_by_fans
from geometry.meshes.tetrahedralise import mesh_blocks
from geometry.polyhedra.construct import from_boxes, from_faces
from geometry.polyhedra.measures import volumes
from geometry.specimens.stacked import couplet
from geometry.specimens.wallette import wallette


def cells(count, seed=0):
    sites = np.random.default_rng(seed).uniform(0, 1, (count, 3)) * (0.23, 0.11, 0.06)
    return to_blocks(
        tessellate(sites, np.zeros(count), box_domain(np.zeros(3), np.array([0.23, 0.11, 0.06]))), sites[:, 0] * 0
    )


def every(blocks):
    return np.ones(blocks.count, dtype=bool)


SPECIMENS = {
    "cells": lambda: cells(60),
    "couplet": lambda: couplet(0.2, 0.05, 0.06, (4, 2, 2), mortar=(0.01, (5, 3, 1)), plates=0.02).blocks,
    "wallette": lambda: wallette(4, 2, 0.24, 0.113, 0.0115, 0.01, (2, 2), 0.05).blocks,
}


@pytest.fixture(params=sorted(SPECIMENS))
def specimen(request):
    return SPECIMENS[request.param]()


def test_the_tets_of_each_block_fill_it(specimen, tet_volumes):
    mesh, _ = mesh_by_fans(specimen, every(specimen), find_joints(specimen))
    volume = tet_volumes(mesh)
    assert volume.min() > 0
    block = np.repeat(np.arange(specimen.count), np.diff(mesh.tet_start))
    assert np.allclose(np.bincount(block, volume), volumes(specimen), rtol=1e-12)
    assert np.all((mesh.tets >= mesh.node_start[block, None]) & (mesh.tets < mesh.node_start[block + 1, None]))


def test_nodes_of_both_sides_coincide_on_every_joint_and_share_out_its_area(specimen):
    joints = find_joints(specimen)
    mesh, at_nodes = mesh_by_fans(specimen, every(specimen), joints)
    assert np.all(at_nodes.node_a >= 0) and np.all(at_nodes.node_b >= 0)
    assert np.array_equal(mesh.nodes[at_nodes.node_a], at_nodes.point)
    assert np.array_equal(mesh.nodes[at_nodes.node_b], at_nodes.point)
    for node, block in ((at_nodes.node_a, at_nodes.block_a), (at_nodes.node_b, at_nodes.block_b)):
        assert np.array_equal(np.searchsorted(mesh.node_start, node, side="right") - 1, block)
    patches = len(joints.patch_start) - 1
    area, known = (np.bincount(j.patch, j.area, minlength=patches) for j in (at_nodes, joints))
    assert np.allclose(area, known, rtol=1e-9)


def test_cells_have_about_as_many_tets_as_their_faces_have_triangles():
    blocks = cells(200)
    mesh, _ = mesh_by_fans(blocks, every(blocks), find_joints(blocks))
    assert 30 <= len(mesh.tets) / blocks.count <= 46


def test_only_the_blocks_asked_for_are_filled_and_the_others_keep_their_contact_points():
    blocks = couplet(0.2, 0.05, 0.06, (4, 2, 1), plates=0.02).blocks
    joints = find_joints(blocks)
    meshed = blocks.group == blocks.groups.index("plates")
    mesh, at_nodes = mesh_by_fans(blocks, meshed, joints)
    assert np.array_equal(np.diff(mesh.tet_start) > 0, meshed)
    plain = ~meshed[joints.block_a] & ~meshed[joints.block_b]
    kept = (at_nodes.node_a < 0) & (at_nodes.node_b < 0)
    assert np.array_equal(at_nodes.point[kept], joints.point[plain])
    assert np.array_equal(at_nodes.area[kept], joints.area[plain])
    assert np.all((at_nodes.node_a[~kept] >= 0) == meshed[at_nodes.block_a[~kept]])


def test_a_face_with_a_corner_cut_out_of_its_free_part_is_still_filled(tet_volumes):
    low = np.array([[0, 0, 0], [0, 0, 1.0]])
    blocks = from_boxes(low, low + [[2, 2, 1], [1, 1, 1]], np.arange(2), np.zeros(2), ["g"])
    mesh, at_nodes = mesh_by_fans(blocks, every(blocks), find_joints(blocks))
    assert tet_volumes(mesh).sum() == pytest.approx(5, rel=1e-12)
    assert at_nodes.area.sum() == pytest.approx(1, rel=1e-12)


def test_a_joint_in_the_middle_of_a_larger_face_is_refused_with_the_way_out():
    low = np.array([[0, 0, 0], [1, 1, 1.0]])
    blocks = from_boxes(low, low + [[3, 3, 1], [1, 1, 1]], np.arange(2), np.zeros(2), ["g"])
    with pytest.raises(GeometryError, match="block 0 .*goes all round a joint.*mesh_size"):
        mesh_by_fans(blocks, every(blocks), find_joints(blocks))


def test_a_block_that_is_not_seen_whole_from_its_centroid_is_refused_with_the_way_out(prism):
    angle = np.linspace(0, 1.75 * np.pi, 15)
    ring = np.concatenate(
        [np.column_stack([np.cos(angle), np.sin(angle)]), 0.9 * np.column_stack([np.cos(angle), np.sin(angle)])[::-1]]
    )
    blocks = from_faces([prism(ring, 0.0, 0.1)], [3], [0], ["g"])
    with pytest.raises(GeometryError, match=r"block 0 \(unit 3\).*centroid.*mesh_size"):
        mesh_by_fans(blocks, every(blocks), find_joints(blocks))


def test_cubes_have_good_tets():
    corner = np.array([[i, 0, k] for i in range(3) for k in range(3)], dtype=float)
    blocks = from_boxes(corner, corner + 1, np.arange(9), np.zeros(9), ["g"])
    assert radius_ratios(mesh_by_fans(blocks, every(blocks), find_joints(blocks))[0]).min() > 0.6


def test_the_gmsh_model_names_groups_of_blocks_and_the_joints_between_them(monkeypatch):
    blocks = couplet(0.2, 0.05, 0.06, mortar=(0.01, (2, 1, 1)), plates=0.02).blocks
    joints = find_joints(blocks)
    seen = {}
    generate = mesher._generate

    def listen(gmsh, volumes):
        for dimension, tag in gmsh.model.getPhysicalGroups():
            name = gmsh.model.getPhysicalName(dimension, tag)
            seen[dimension, name] = len(gmsh.model.getEntitiesForPhysicalGroup(dimension, tag))
        generate(gmsh, volumes)

    monkeypatch.setattr(mesher, "_generate", listen)
    mesh_blocks(blocks, every(blocks), 0.05, joints)
    assert {name: n for (dimension, name), n in seen.items() if dimension == 3} == {
        "units": 2,
        "mortar": 2,
        "plates": 2,
    }
    assert {name: n for (dimension, name), n in seen.items() if dimension == 2} == {
        "joint units mortar": 4,
        "joint mortar": 1,
        "joint units plates": 2,
    }
