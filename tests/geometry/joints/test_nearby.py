"""Joints over gaps: the rule, held against closed forms, against exact joints, and turned."""

import numpy as np
import pytest

from geometry.blocks import Blocks
from geometry.joints.covered import covered_fractions
from geometry.joints.find import find_joints, stated_joints
from geometry.joints.nearby import Rule, nearby_joints
from geometry.joints.point_density import Density
from geometry.polyhedra.construct import concatenate, from_boxes
from geometry.specimens.from_arrays import polyhedra
from geometry.specimens.placed import rotation
from geometry.specimens.wallette import wallette

BENT = [(0, 3, 2, 1), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (4, 5, 6), (4, 6, 7)]
"""Faces of a box whose upper one is two triangles."""
RULE = Rule(gap=0.02, overlap=1e-3, angle=np.radians(20.0))


def boxes(*ends: tuple) -> Blocks:
    low, high = np.array([a for a, _ in ends], dtype=float), np.array([b for _, b in ends], dtype=float)
    return from_boxes(low, high, np.arange(len(ends)), np.zeros(len(ends), dtype=int), ("units",))


def stacked(gap: float, shift: float = 0.0) -> Blocks:
    return boxes(((0, 0, 0), (1, 1, 1)), ((shift, 0, 1 + gap), (1 + shift, 1, 2 + gap)))


def drawn_out(outline, y=(0.0, 0.3)) -> Blocks:
    """A body with an outline (n, 2) along x and z, drawn out along y."""
    outline = np.asarray(outline, dtype=float)
    points = np.concatenate([np.insert(outline, 1, level, axis=1) for level in y])
    n = len(outline)
    sides = [(k, (k + 1) % n, n + (k + 1) % n, n + k) for k in range(n)]
    return polyhedra([(points, [list(range(n))[::-1], list(range(n, 2 * n)), *sides])], ["body"], [0], ["units"])


def measured(blocks, rule=RULE):
    stated = nearby_joints(blocks, rule)
    return stated, stated_joints(stated, Density("vertex"))


@pytest.mark.parametrize("gap", [0.0, 1e-4, 0.02, -1e-3])
def test_a_joint_lies_half_way_between_two_blocks(gap):
    stated, joints = measured(stacked(gap, shift=0.25))
    assert stated.gap == pytest.approx(np.array([[gap, gap]]), abs=1e-12)
    assert joints.area.sum() == pytest.approx(0.75, rel=1e-12)
    assert joints.point[:, 2] == pytest.approx(1 + gap / 2, rel=1e-12)
    assert joints.normal == pytest.approx(np.tile([0.0, 0, 1], (4, 1)), abs=1e-12)
    assert sorted(set(np.round(joints.point[:, 0], 9))) == [0.25, 1.0]


@pytest.mark.parametrize("gap", [0.0201, -1.01e-3])
def test_what_is_farther_apart_or_deeper_than_the_limits_is_no_joint(gap):
    assert len(nearby_joints(stacked(gap), RULE).block_a) == 0


def test_where_blocks_meet_the_joints_are_those_that_are_found():
    blocks = wallette(4, 3, 0.25, 0.07, 0.12, 0.0, (2, 1)).blocks
    touching, (_, joints) = find_joints(blocks, "vertex"), measured(blocks)
    assert len(joints.patch_start) == len(touching.patch_start)

    def sorted_rows(x):
        return np.array(
            sorted(np.column_stack([x.block_a, x.block_b, np.round(x.point, 9), x.normal, x.area]).tolist())
        )

    assert sorted_rows(joints) == pytest.approx(sorted_rows(touching), abs=1e-12)


def test_faces_that_open_as_a_wedge_touch_as_far_as_the_gap_goes():
    """At an opening angle of t about the edge x = 0, points of the mean plane up to gap / (2 sin(t / 2)) are near."""
    angle = np.radians(4.0)
    turn = rotation((0.0, -1.0, 0.0), angle)  # lifts the end at x = 1
    upper = boxes(((0, 0, 0), (1, 1, 1)))
    upper = Blocks(upper.points @ turn.T, *[getattr(upper, k) for k in Blocks.__dataclass_fields__ if k != "points"])
    stated, joints = measured(concatenate([boxes(((0, 0, -1), (1, 1, 0))), upper]))
    reach = RULE.gap / (2 * np.tan(angle / 2))
    assert joints.area.sum() == pytest.approx(reach, rel=1e-6)  # the limits have a rim of 1e-9
    assert stated.gap == pytest.approx(np.array([[0.0, RULE.gap]]), abs=1e-8)
    assert joints.normal[0] == pytest.approx([-np.sin(angle / 2), 0, np.cos(angle / 2)], abs=1e-12)


@pytest.mark.parametrize(("degrees", "count"), [(19.0, 1), (21.0, 0)])
def test_faces_look_at_each_other_within_the_angle(degrees, count):
    """A wedge that stands on its edge, 0.01 above a slab, broad enough within the gap."""
    slope = np.tan(np.radians(degrees))
    wedge = drawn_out([(0, 0), (1, slope), (1, 1), (0, 1)])
    slab = drawn_out([(0, -1), (1, -1), (1, -0.001), (0, -0.001)])
    assert len(nearby_joints(concatenate([slab, wedge]), Rule(0.5, 1e-3, np.radians(20.0))).block_a) == count


def test_what_is_not_broader_than_its_gap_is_no_joint():
    assert len(nearby_joints(stacked(0.02, shift=0.985), RULE).block_a) == 0
    assert len(nearby_joints(stacked(0.002, shift=0.985), RULE).block_a) == 1


def test_blocks_with_another_one_between_them_do_not_touch():
    thin = boxes(((0, 0, 0), (1, 1, 1)), ((0, 0, 1.005), (1, 1, 1.01)), ((0, 0, 1.015), (1, 1, 2)))
    stated = nearby_joints(thin, RULE)
    assert np.stack([stated.block_a, stated.block_b], axis=1).tolist() == [[0, 1], [1, 2]]


def wavy(scale=0.01):
    """Two blocks with rough faces, 13 mm apart on average: an uneven stone on another one."""
    x = np.linspace(0, 1, 9)
    lower = np.array([0, 3, -1, 2, 0, -2, 1, 3, 0]) * 1e-1 * scale
    upper = 0.013 + np.array([2, -1, 0, 3, 1, -2, 2, 0, 1]) * 1e-1 * scale
    under = [(0, -1), (1, -1), *zip(x[::-1], lower[::-1], strict=True)]
    return concatenate([drawn_out(under), drawn_out([*zip(x, upper, strict=True), (1, 1), (0, 1)])])


def test_rough_faces_make_one_joint_in_their_mean_plane():
    stated, joints = measured(wavy())
    assert len(stated.block_a) == 1 and len(joints.point) == 4
    assert joints.area.sum() == pytest.approx(0.3, rel=1e-3)
    assert joints.normal[:, 2] == pytest.approx(1.0, abs=1e-4)
    assert 0.009 < stated.gap[0, 0] < 0.013 < stated.gap[0, 1] < 0.017


def test_a_joint_over_a_gap_spans_the_hollows_between_its_parts():
    """Two of three parts are near: what they bear together has its resultant anywhere between them."""
    upper = drawn_out([(0, 0.01), (0.4, 0.01), (0.4, 0.1), (0.6, 0.1), (0.6, 0.01), (1, 0.01), (1, 1), (0, 1)])
    lower = drawn_out([(0, -1), (1, -1), (1, 0), (0, 0)])
    stated, joints = measured(concatenate([lower, upper]))
    assert len(stated.block_a) == 1 and joints.area.sum() == pytest.approx(0.3, rel=1e-9)


def test_the_joints_turn_with_the_blocks_and_do_not_know_their_order():
    blocks = wavy()
    turn, shift = rotation(np.array([2.0, -1.0, 2.0]) / 3, 1.1), np.array([3.0, -2.0, 5.0])
    moved = Blocks(
        blocks.points @ turn.T + shift, *[getattr(blocks, k) for k in Blocks.__dataclass_fields__ if k != "points"]
    )
    one, two = measured(blocks)[1], measured(moved)[1]
    there = one.point @ turn.T + shift
    apart = np.linalg.norm(there[:, None] - two.point, axis=-1).min(axis=1)
    assert apart.max() < 1e-9 and two.area.sum() == pytest.approx(one.area.sum(), rel=1e-9)
    assert two.normal[0] == pytest.approx(turn @ one.normal[0], abs=1e-9)


@pytest.mark.parametrize(("gap", "share"), [(0.0, 1.0), (0.004, 1.0), (0.015, 1.0), (0.019, 1.0), (0.04, 0.0)])
def test_faces_beside_a_narrow_gap_count_as_covered(gap, share):
    """A gap of 4 % of a face can be looked into; both halves of a face that is cut in two lie beside the joint."""
    blocks = stacked(gap)
    joints = measured(blocks, Rule(0.05, 1e-3, 0.3))[1]
    assert np.sort(covered_fractions(blocks, joints))[-2:] == pytest.approx(share)
    cut = polyhedra(
        [([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1.002)], BENT)],
        ["bent"], [0], ["units"],
    )  # fmt: skip
    joints = measured(concatenate([cut, boxes(((0, 0, 1.004), (1, 1, 2)))]), RULE)[1]
    fractions = covered_fractions(concatenate([cut, boxes(((0, 0, 1.004), (1, 1, 2)))]), joints)
    assert np.sum(fractions > 0.99) == 3


def test_two_planes_of_a_step_are_two_joints():
    """An angle on an angle: level, riser, level."""
    lower = drawn_out([(0, -1), (2, -1), (2, 0.5), (1, 0.5), (1, 0), (0, 0)])
    upper = drawn_out([(0, 0.01), (0.99, 0.01), (0.99, 0.51), (2, 0.51), (2, 2), (0, 2)])
    stated, joints = measured(concatenate([lower, upper]))
    assert len(stated.block_a) == 3
    assert joints.area.sum() == pytest.approx(0.3 * (0.99 + 0.49 + 1.0), rel=1e-9)
