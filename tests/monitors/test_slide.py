"""Contacts keep their place and area: a slip that is no small share of the joint is a doubt, and then the end."""

import numpy as np
import pytest

from geometry.joints.extents import joint_extents
from geometry.joints.find import find_joints
from geometry.specimens.boxes import boxes
from masonry.assembly.assemble import assemble, joined
from masonry.cli.main import main
from masonry.configuration.energy import Seen
from masonry.errors import Stopped
from masonry.judgement.sentence import trust
from masonry.laboratory import laboratory
from masonry.monitors.observer import View
from masonry.monitors.slide import Slide
from masonry.scene import load

FAST = {"drive.accuracy": "5 %"}
GLUE = {"law": "elastic", "contact.unit_unit.shear_stiffness": "0 Pa/m"}
"""It slides on without any shear."""


def contacts_show(model, *values):
    """All contacts show the same opening, slip, normal and shear stress."""
    return Seen(*(np.full(len(model.group), value) for value in values))


def slid(displacement, **more):
    return laboratory.run(load("couplet", FAST | {"drive.displacement": displacement} | more)).summary


def test_a_couplet_that_slides_off_its_unit_is_stopped_at_a_quarter_of_it():
    with pytest.raises(Stopped, match=r"slid by .* more than solver\.slip_limit = 0\.25") as stop:
        slid("500 mm")
    summary = stop.value.result.summary
    places = stop.value.result.history.rows["displacement"]
    assert 0.2 < summary["slip_max"] <= 0.25
    assert places[-1] == pytest.approx(0.2 * summary["slip_max"], rel=1e-6)  # the joint is 200 mm long
    with pytest.raises(Stopped, match="solver.slip_limit = 0.05"):
        slid("500 mm", **{"solver.slip_limit": "5 %"})


def test_the_shell_says_so_and_the_results_stay(tmp_path, capsys):
    words = ["run", "couplet", "--out", str(tmp_path / "r"), "--set", "drive.displacement='500 mm'"]
    assert main([*words, "--set", "drive.accuracy='5 %'"]) == 3
    assert "solver.slip_limit" in capsys.readouterr().err
    assert (tmp_path / "r" / "summary.json").is_file()


@pytest.mark.parametrize("divisions", [[1, 1, 1], [4, 1, 2]])
def test_the_share_is_that_of_the_whole_joint_however_its_units_are_cut(divisions):
    summary = slid("9 mm", **{"specimen.divisions": divisions})
    assert summary["slip_max"] == pytest.approx(9 / 200, rel=1e-4)
    assert "slid" not in trust(summary)


def test_beyond_a_fifth_of_the_limit_the_slip_is_a_doubt():
    assert "contacts slid by up to 0.055 of their joints" in trust(slid("11 mm"))
    assert "slid" not in trust(slid("11 mm", **{"solver.slip_limit": 0.5}))


@pytest.mark.parametrize("kinematics", ["rigid", "affine", "tets"])
def test_bonds_of_large_displacement_keep_place_and_area_as_well(kinematics):
    large = {"displacements": "large", "kinematics": kinematics}
    summary = slid("11 mm", **large, **GLUE)
    assert summary["slip_max"] == pytest.approx(11 / 200, rel=1e-4)
    assert "contacts slid by up to 0.055 of their joints" in trust(summary)
    assert "do not meet elsewhere" in trust(summary)
    for left in ("0 MPa", "0.05 MPa"):
        summary = slid("11 mm", **large, **{"contact.unit_unit.residual_cohesion": left})
        assert summary["slip_max"] < 0.05, "patches, which took over, move with the blocks"


def test_a_roller_may_slide_as_far_as_it_likes():
    smooth = {"tensile_strength": "0 Pa", "cohesion": "0 Pa", "tan_friction_angle": 0, "residual_cohesion": "0 Pa"}
    smooth |= {"tan_residual_friction_angle": 0, "fracture_energy_mode_2_slope": "0 N/m/MPa"}
    roller = {f"contact.unit_unit.{key}": value for key, value in smooth.items()} | {"law": "brittle"}
    for smooth in (roller, GLUE):
        assert slid("60 mm", **smooth)["slip_max"] == 0.0
    assert slid("60 mm", **roller, displacements="large")["slip_max"] is None, "there they are patches"


@pytest.mark.parametrize("displacements", ["small", "large"])
def test_bonds_that_close_by_a_part_of_a_block_are_a_doubt(displacements):
    soft = {f"contact.unit_unit.{key}": "1 GPa/m" for key in ("normal_stiffness", "shear_stiffness")}
    pressed = {"displacements": displacements, "law": "elastic", "drive.direction": "-z", "confinement": "0 MPa"}
    summary = slid("10 mm", **soft, **pressed)
    assert summary["overlap_max"] == pytest.approx(10 / 50, rel=1e-3)  # a unit is 50 mm high
    assert "contacts close by" in trust(summary)


def test_what_is_apart_touches_nothing_and_does_not_count():
    model = assemble(load("couplet")).model
    model.contacts.u[model.contacts.sides[:, 1], 0] = 0.06
    slide, seen = Slide(model, 0.25), contacts_show(model, 1e-3, 0.06, 0.0, 0.0)
    seen.tau[:] = 1.0  # what a softening law leaves of its strength
    slide.look(model, View(seen), 0)
    assert slide.largest == 0.0
    seen.sigma[:] = -1.0  # pressed, as dilation does
    with pytest.raises(Stopped):
        slide.look(model, View(seen), 0)


@pytest.mark.parametrize("displacements", ["small", "large"])
def test_glue_that_is_pulled_wide_open_slides_as_well(displacements):
    """It stands open by 2 %, which no other law bears, and slides by 11 mm of 200 mm."""
    soft = {"contact.unit_unit.normal_stiffness": "1 MPa/m", "contact.unit_unit.shear_stiffness": "1 kPa/m"}
    pull = [{"on": "top.z+", "stress": {"z": "1 kPa"}}]
    pulled = {"law": "elastic", "traction": pull, "displacements": displacements}
    summary = slid("11 mm", **soft, **pulled)
    assert summary["slip_max"] == pytest.approx(11 / 200, rel=1e-2)


def test_extents_of_running_bond_are_those_of_half_a_unit():
    specimen, joints = joined(load("wallette-mode-1"))
    axes, size = joint_extents(specimen.blocks, joints)
    unit = specimen.blocks.unit
    plates = specimen.blocks.group == specimen.blocks.groups.index("plates")
    between = (unit[joints.block_a] != unit[joints.block_b]) & ~plates[joints.block_a] & ~plates[joints.block_b]
    bed = between & (np.abs(joints.normal[:, 2]) > 0.5)
    np.testing.assert_allclose(np.sort(size[bed], axis=1), np.tile([0.0115, 0.125], (bed.sum(), 1)))
    head = between & ~bed
    np.testing.assert_allclose(np.sort(size[head], axis=1), np.tile([0.0115, 0.123], (head.sum(), 1)))
    long = np.take_along_axis(axes[bed], size[bed].argmax(axis=1)[:, None, None], axis=1)[:, 0]
    np.testing.assert_allclose(np.abs(long), np.tile([1.0, 0.0, 0.0], (bed.sum(), 1)), atol=1e-12)
    inside = unit[joints.block_a] == unit[joints.block_b]  # blocks of 31.25 x 11.5 x 30.75 mm
    assert set(np.round(size[inside].max(axis=1), 6)) <= {0.03125, 0.03075}


def test_extents_do_not_depend_on_the_order_of_blocks_and_units():
    def stack(order):
        box = [(f"b{k}", (0.1 * (k // 2), 0, 0.1 * (k % 2)), (0.1, 0.05, 0.1), "g", k % 2, (1, 1, 1)) for k in order]
        blocks = boxes(box, 1.0).blocks
        joints = find_joints(blocks)
        size = joint_extents(blocks, joints)[1]
        return np.sort(size[np.abs(joints.normal[:, 2]) > 0.5], axis=1)

    for order in ([0, 1, 2, 3], [1, 2, 0, 3], [3, 0, 1, 2]):
        np.testing.assert_allclose(stack(order), np.tile([0.05, 0.2], (8, 1)))


def test_a_slip_across_is_measured_by_the_width():
    model = assemble(load("couplet")).model
    slide, seen = Slide(model, 0.25), contacts_show(model, 0.0, 0.01, -1.0, 0.0)
    for axis, length in ((0, 0.2), (1, 0.05)):
        slide.largest = 0.0
        model.contacts.u[model.contacts.sides[:, 1]] = 0.01 * np.eye(3)[axis]
        slide.look(model, View(seen), 0)
        assert slide.largest == pytest.approx(0.01 / length)
