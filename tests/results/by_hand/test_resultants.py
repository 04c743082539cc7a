"""What a joint carries, which frame is meant, and what counts as opened: by hand, from made-up forces and frames."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from masonry.results import frame_choice
from masonry.results.dry_joints import moved_undamaged, without_parted
from masonry.results.joint_resultants import resultants, resultants_csv
from masonry.rows.history import History
from tests.results.sample import joints_of, opened, wall

SCENE = {"contact": {"unit_unit": {"normal_stiffness": "30 GPa/m", "shear_stiffness": "12 GPa/m"}}}


def bed():
    """The first bed joint of a wall of two courses, its contacts, and blocks and joints."""
    blocks = wall(2, 1, 1)
    joints = joints_of(blocks)
    units = np.column_stack([blocks.unit[joints.block_a], blocks.unit[joints.block_b]])
    return blocks, joints, np.flatnonzero((units.min(axis=1) == 0) & (units.max(axis=1) == 1)), units


def carried(blocks, joints, force: np.ndarray) -> dict[str, float]:
    table = resultants(blocks, joints, {"end": SimpleNamespace(force=force)})
    row = int(np.flatnonzero((table["unit_a"] == 0) & (table["unit_b"] == 1))[0])
    return {name: values[row] for name, values in table.items() if name != "moment"}


@pytest.mark.parametrize("swapped", [False, True])
def test_force_and_place_are_those_on_the_lower_unit_whichever_side_a_contact_calls_a(swapped):
    """Presses of 1, 2, 3 and 4 N at the four points, and a pull of 0.5 N along x at each."""
    blocks, joints, which, _ = bed()
    force = np.zeros((len(joints.area), 3))
    force[which, 2], force[which, 0] = -np.array([1.0, 2.0, 3.0, 4.0]), 0.5  # on the lower unit
    if swapped:
        a, b, normal = joints.block_a.copy(), joints.block_b.copy(), joints.normal.copy()
        a[which], b[which], normal[which], force[which] = b[which], a[which], -normal[which], -force[which]
        joints = replace(joints, block_a=a, block_b=b, normal=normal)
    found = carried(blocks, joints, force)
    assert [found[f"normal_{axis}"] for axis in "xyz"] == [0.0, 0.0, 1.0]
    assert [found[f"force_{axis}"] for axis in "xyz"] == [2.0, 0.0, -10.0]
    assert (found["normal_force"], found["shear_force"]) == (-10.0, 2.0)
    place = np.array([1.0, 2.0, 3.0, 4.0]) @ joints.point[which] / 10.0
    assert [found[f"place_{axis}"] for axis in "xyz"] == pytest.approx(place)


def test_the_eccentricity_is_measured_from_the_middle_of_the_areas_to_the_edge_that_way():
    """One contact has most of the area; all force on another lies off the middle that they have together."""
    blocks, joints, which, _ = bed()
    area = joints.area.copy()
    area[which] *= [6.0, 1.0, 1.0, 1.0]
    joints = replace(joints, area=area)
    force = np.zeros((len(area), 3))
    force[which[1], 2] = -7.0
    found = carried(blocks, joints, force)
    middle = area[which] @ joints.point[which] / area[which].sum()
    off = joints.point[which[1]] - middle
    corners = joints.patch_points[joints.patch_start[joints.patch[which[0]]] :][:4]
    reach = max((corner - middle) @ off / np.linalg.norm(off) for corner in corners)
    assert found["eccentricity"] == pytest.approx(np.linalg.norm(off) / reach)
    assert found["area"] == pytest.approx(area[which].sum())


def test_at_a_corner_of_a_long_joint_the_eccentricity_is_1_in_its_own_direction():
    blocks, joints, which, _ = bed()
    corners = joints.patch_points[joints.patch_start[joints.patch[which[0]]] :][:4]
    point = joints.point.copy()
    point[which] = corners
    joints = replace(joints, point=point)
    for k in range(4):
        force = np.zeros((len(joints.area), 3))
        force[which[k], 2] = -1.0
        assert carried(blocks, joints, force)["eccentricity"] == pytest.approx(1.0)
    force[which] = (0.0, 0.0, -1.0)
    assert carried(blocks, joints, force)["eccentricity"] == 0.0
    assert "nan" not in resultants_csv(resultants(blocks, joints, {"end": SimpleNamespace(force=0.0 * force)}))


def test_the_nearest_frame_is_meant_be_it_before_or_behind():
    blocks = wall(2, 1, 1)
    kept = [opened(blocks, joints_of(blocks), 1e-3 * k, 100 * k) for k in (0, 1, 2, 4)]
    result = SimpleNamespace(history=History({}, kept), in_real_time=False, has_drive=True)
    for asked, step in ((120, 100), (170, 200), (290, 200), (310, 400), (9999, 400), ("1.4 mm", 100), ("1.6 mm", 200)):
        assert frame_choice.choose(result, asked).frame.step == step


def test_a_joint_that_is_pressed_has_not_opened_however_soft_it_is():
    """Open by 1 um for good at one point; elsewhere it is pressed, or pulled within its stiffness."""
    blocks, joints, which, _ = bed()
    frame = opened(blocks, joints, 0.0, 1)
    opening, stress = np.zeros(len(joints.area)), np.zeros(len(joints.area))
    opening[which], stress[which] = (1e-6, -1e-6, 1e-6, 0.0), (0.0, -3e4, 3e4, 0.0)
    slip, shear = np.zeros(len(joints.area)), np.zeros(len(joints.area))
    slip[which], shear[which] = (0.0, 0.0, 0.0, 1e-6), (0.0, 0.0, 0.0, -1.2e4)
    result = SimpleNamespace(joints=joints, joint_groups=("unit_unit",), joint_properties={}, scene_table=SCENE)
    result.joint_group = np.zeros(len(joints.area), dtype=int)
    frame = replace(frame, opening=opening, normal_stress=stress, slip=slip, shear_stress=shear)
    assert np.flatnonzero(moved_undamaged(result, frame)).tolist() == [which[0]]
    opening[which[1]] = 1e-6  # and pressed: it stands on what it has risen by
    assert set(np.flatnonzero(moved_undamaged(result, replace(frame, opening=opening)))) == {which[0], which[1]}


@pytest.mark.parametrize(("share", "parted"), [(0.99, False), (1.01, True)])
@pytest.mark.parametrize("how", ["opening", "slip"])
def test_two_sides_have_parted_from_half_the_root_of_their_area_on(share, parted, how):
    blocks, joints, which, _ = bed()
    far = np.zeros(len(joints.area))
    far[which] = share * 0.5 * np.sqrt(joints.area[which].sum())
    frame = replace(opened(blocks, joints, 0.0, 1), damage_tension=np.ones(len(far)), **{how: far})
    found = without_parted(SimpleNamespace(joints=joints), frame)
    assert (found.damage_tension[which] == 0.0).all() == parted
    assert found.damage_tension[np.setdiff1d(np.arange(len(far)), which)].all()
