import time

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from geometry.blocks import TetMesh
from geometry.joints.find import find_joints
from geometry.joints.quality import quality, radius_ratios
from geometry.polyhedra.construct import divide, from_boxes
from geometry.specimens.stacked import couplet

REGULAR = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1.0]])
CORNER = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])


def one_tet(nodes):
    return TetMesh(np.asarray(nodes), np.array([0, 4]), np.array([[0, 1, 2, 3]]), np.array([0, 1]))


def row_of_boxes(lengths):
    end = np.cumsum(lengths)
    low = np.column_stack([end - lengths, np.zeros((len(end), 2))])
    high = np.column_stack([end, np.full((len(end), 2), 0.1)])
    return from_boxes(low, high, np.arange(len(end)), np.zeros(len(end)), ["units"])


@pytest.mark.parametrize("size", [1e-3, 1.0, 50.0])
def test_the_radius_ratio_of_the_regular_tet_is_1_whatever_its_size_and_place(size):
    nodes = Rotation.random(rng=1).apply(REGULAR) * size + (0.3, -2, 0.1)
    assert radius_ratios(one_tet(nodes))[0] == pytest.approx(1, rel=1e-9)


def test_the_radius_ratio_of_a_corner_of_a_cube_is_that_of_its_closed_form():
    inradius = 3 * (1 / 6) / (1.5 + np.sqrt(3) / 2)
    assert radius_ratios(one_tet(CORNER))[0] == pytest.approx(3 * inradius / (np.sqrt(3) / 2), rel=1e-14)


def test_a_tet_flattened_to_nothing_has_radius_ratio_0_and_its_block_is_blamed():
    flat = CORNER * (1, 1, 1e-9)
    mesh = TetMesh(
        np.concatenate([REGULAR, flat]),
        np.array([0, 4, 8]),
        np.array([[0, 1, 2, 3], [4, 5, 6, 7]]),
        np.array([0, 1, 2]),
    )
    blocks = row_of_boxes([0.1, 0.2])
    worst = quality(blocks, find_joints(blocks), mesh).flattest_tet
    assert worst.value < 1e-8 and worst.blocks == (1,)


def test_the_thin_block_among_equal_ones_is_found_with_its_edge_its_size_and_its_joints():
    blocks = row_of_boxes([0.1, 0.1, 0.002, 0.1, 0.1])
    measures = quality(blocks, find_joints(blocks))
    mean = 0.402 * 0.01 / 5
    assert measures.shortest_edge.value == pytest.approx(0.002) and measures.shortest_edge.blocks == (2,)
    assert measures.shortest_edge.ratio == pytest.approx(0.002 / np.cbrt(mean))
    assert measures.smallest_block.value == pytest.approx(2e-5) and measures.smallest_block.blocks == (2,)
    assert measures.smallest_block.ratio == pytest.approx(2e-5 / mean)
    assert measures.smallest_joint.value == pytest.approx(0.01)
    assert measures.shortest_joint_edge.value == pytest.approx(0.1)
    assert measures.flattest_tet is None


def test_a_sliver_of_joint_between_whole_blocks_is_found_with_both_blocks():
    low = np.array([[0, 0, 0], [0.1, 0, 0], [0.001, 0, 0.1]])
    blocks = from_boxes(low, low + 0.1, np.arange(3), np.zeros(3), ["units"])
    measures = quality(blocks, find_joints(blocks))
    assert measures.shortest_joint_edge.value == pytest.approx(0.001) and measures.shortest_joint_edge.blocks == (1, 2)
    assert measures.smallest_joint.value == pytest.approx(1e-4) and measures.smallest_joint.blocks == (1, 2)
    assert measures.smallest_joint.ratio == pytest.approx(0.01)


def test_a_block_is_small_beside_the_others_of_its_group_not_beside_a_plate():
    specimen = couplet(0.2, 0.1, 0.05, (4, 2, 1), mortar=(0.01, (4, 2, 1)), plates=0.3)
    assert quality(specimen.blocks, find_joints(specimen.blocks)).smallest_block.ratio == pytest.approx(1)


def test_blocks_without_joints_have_no_joint_measures():
    blocks = row_of_boxes([0.1])
    measures = quality(blocks, find_joints(blocks))
    assert measures.shortest_joint_edge is None and measures.smallest_joint is None


def test_the_cost_grows_as_the_number_of_blocks():
    seconds = []
    for number in (10, 20):
        low, high = divide((0, 0, 0), (1, 1, 1), (number, number, number))
        blocks = from_boxes(low, high, np.zeros(len(low)), np.zeros(len(low)), ["g"])
        joints = find_joints(blocks)
        begin = time.process_time()
        quality(blocks, joints)
        seconds.append(time.process_time() - begin)
    assert seconds[1] < 8 * 3 * seconds[0] + 0.05
