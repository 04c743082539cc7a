"""Where the matter of blocks goes in a frame, by hand: turned and stretched blocks, both sides of a joint, fields."""

from dataclasses import replace

import numpy as np
import pytest

from masonry.results.deformation import BlockCorners, Deformation
from masonry.results.fields import BlockGrid
from masonry.results.joint_fields import JointGrid, mode_of
from masonry.results.table import column_names, csv_text
from masonry.rows.history import History
from tests.results.sample import joints_of, opened, wall

GRADIENT = np.array([[1e-3, -4e-3, 2e-3], [3e-3, 5e-4, -1e-3], [-2e-3, 6e-3, -7e-4]])
SHIFT = np.array([0.02, -0.01, 0.03])


def strained():
    """A wall of which the second block is shifted and strained about the origin; its frame."""
    blocks = wall(2, 1, 1)
    corners = np.zeros_like(blocks.points)
    mine = slice(8, 16)
    corners[mine] = SHIFT + blocks.points[mine] @ GRADIENT.T
    return blocks, joints_of(blocks), replace(opened(blocks, joints_of(blocks), 0.0, 1), corners=corners)


def test_points_of_a_block_move_by_its_shift_and_gradient_and_those_of_others_stay():
    blocks, joints, frame = strained()
    field = Deformation(BlockCorners(blocks), frame)
    assert field.gradient[1] == pytest.approx(GRADIENT, abs=1e-12)
    assert field.gradient[0] == pytest.approx(np.zeros((3, 3)), abs=1e-15)
    places = np.array([[0.1, 0.02, 0.15], [0.3, 0.2, 0.1]])
    none = np.full(2, -1)
    assert field.at(np.array([1, 1]), places, none) == pytest.approx(SHIFT + places @ GRADIENT.T)
    assert field.at(np.array([0, 1]), places, none)[0] == pytest.approx(np.zeros(3), abs=1e-15)
    every = np.arange(len(joints.area))
    first, second = field.sides(joints, every, joints.point)
    for side, block in ((first, joints.block_a), (second, joints.block_b)):
        wanted = np.where((block == 1)[:, None], SHIFT + joints.point @ GRADIENT.T, 0.0)
        assert side == pytest.approx(wanted, abs=1e-12)


def test_a_point_on_a_node_or_between_three_moves_with_them():
    blocks, _, frame = strained()
    nodes = np.array([[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 4.0], [8.0, 8.0, 8.0]])
    field = Deformation(BlockCorners(blocks), replace(frame, nodes=nodes))
    block, point = np.array([0, 0, 1]), np.zeros((3, 3))
    corner, share = np.array([[-1] * 3, [0, 1, 2], [-1] * 3]), np.array([[0.0] * 3, [0.5, 0.25, 0.25], [0.0] * 3])
    found = field.at(block, point, np.array([3, -1, -1]), corner, share)
    assert found[0] == pytest.approx([8.0, 8.0, 8.0]) and found[1] == pytest.approx([0.5, 0.5, 1.0])
    assert found[2] == pytest.approx(SHIFT)


def test_fields_of_blocks_and_joints_are_those_of_the_frame():
    blocks, joints, frame = strained()
    stress = np.arange(6.0) + 10.0 * np.arange(blocks.count)[:, None]
    damage = np.linspace(0.0, 1.0, len(joints.area))
    frame = replace(frame, stress=stress, damage_tension=damage, damage_shear=0.5 * damage, opening=damage * 1e-3)

    class Sample:
        specimen = type("Sample", (), {"blocks": blocks})
        mesh = None
        joint_group = np.zeros(len(joints.area), dtype=int)

    Sample.joints = joints
    grid = BlockGrid(Sample)
    second = np.flatnonzero(grid.block == 1)
    assert grid.cell_data(frame)["stress"][second] == pytest.approx(np.tile([10, 11, 12, 15, 13, 14], (len(second), 1)))
    assert grid.point_data(frame)["displacement"] == pytest.approx(frame.corners[grid.corners])
    data = JointGrid(Sample).cell_data(frame)
    which = joints.block_b == 1
    apart = SHIFT + joints.point[which] @ GRADIENT.T
    along = np.einsum("ci,ci->c", apart, joints.normal[which])[:, None] * joints.normal[which]
    assert data["slip_vector"][which] == pytest.approx(apart - along)
    assert data["opening_vector"] == pytest.approx(frame.opening[:, None] * joints.normal)
    assert data["damage"] == pytest.approx(1.0 - (1.0 - damage) * (1.0 - 0.5 * damage))


@pytest.mark.parametrize(("tension", "shear", "mode"), [(0.049, 0.0, 0), (0.051, 0.0, 1), (0.2, 0.3, 2), (0.3, 0.3, 1)])
def test_the_mode_of_a_contact_is_that_of_its_greater_damage_from_a_twentieth_on(tension, shear, mode):
    blocks, joints, frame = strained()
    every = np.ones(len(joints.area))
    found = mode_of(replace(frame, damage_tension=tension * every, damage_shear=shear * every))
    assert (found == mode).all()


def test_a_table_has_displacement_stress_and_gauges_first_with_their_units_and_all_digits():
    rows = {"step": np.array([1.0, 2.0]), "stress": np.array([0.1, 1 / 3]), "sag": np.array([1e-9, 2.0])}
    rows |= {"displacement": np.array([0.0, 1e-3]), "kinetic": np.array([0.0, 5e-324])}
    assert column_names(rows) == ["displacement", "stress", "sag", "step", "kinetic"]
    lines = csv_text(History(rows)).splitlines()
    assert lines[0] == "displacement [m],stress [Pa],sag [m],step [1],kinetic [J]"
    assert [float(value) for value in lines[2].split(",")] == [1e-3, 1 / 3, 2.0, 2.0, 5e-324]
