"""A part that a dead load could move as a whole is refused; one that nothing pushes may float."""

from math import cos, radians, sin

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.model.layout import KINDS, principal_axes
from masonry.scene import load as load_scene
from tests.scenes import ELASTIC, MATERIAL, box, listed, load, specimen, tables


def column(kinematics: str, fix: str, gravity: str, scale: float = 1.0, away: float = 0.0) -> str:
    """Two blocks on each other, the lower one held in some directions, under a weight."""
    size = 0.2 * scale, 0.1 * scale, 0.06 * scale
    boxes = [box(f"b{k}", (away, 0, size[2] * k), size, "units", k) for k in range(2)]
    return (
        f'kinematics = "{kinematics}"\n'
        + specimen(boxes, size[0] * size[1], f"{0.1 * scale!r} m")
        + tables("material", {"units": MATERIAL})
        + tables("contact", {"unit_unit": ELASTIC})
        + listed("support", [f'on = "b0"\nfix = {fix}'])
        + f"[gravity]\n{gravity}\n[settle]\nsteps = 10\n"
    )


@pytest.mark.parametrize("kinematics", ["rigid", "affine", "tets"])
def test_a_part_that_would_fall_is_refused_with_the_way_it_would_go(kinematics):
    scene = load(column(kinematics, '["x", "y"]', 'z = "-9.81 m/s^2"'))
    with pytest.raises(SceneError, match=r"block 0 .*not held along z.*\[\[support\]\]"):
        laboratory.check(scene)


@pytest.mark.parametrize("kinematics", ["rigid", "affine", "tets"])
def test_what_nothing_pushes_may_float(kinematics):
    assert laboratory.check(load(column(kinematics, '["z"]', 'z = "-9.81 m/s^2"')))["blocks"] == 2


def test_a_rigid_block_held_at_its_centre_may_not_be_turned_over():
    scene = load(column("rigid", '["x", "y", "z"]', 'x = "1 m/s^2"'))
    with pytest.raises(SceneError, match="turning about y"):
        laboratory.check(scene)


def test_a_tet_block_held_in_all_directions_cannot_turn():
    assert laboratory.check(load(column("tets", '["x", "y", "z"]', 'x = "1 m/s^2"')))["blocks"] == 2


def test_a_driven_part_that_no_support_holds_is_refused():
    """Two blocks with a gap of 10 nm between them: the upper one is driven and touches nothing."""
    boxes = [box(f"b{k}", (0, 0, (0.06 + 1e-8) * k), (0.2, 0.1, 0.06), "units", k) for k in range(2)]
    text = (
        'kinematics = "rigid"\n'
        + specimen(boxes, 0.02)
        + tables("material", {"units": MATERIAL})
        + tables("contact", {"unit_unit": ELASTIC})
        + listed("support", ['on = "b0"\nfix = "all"'])
        + '[drive]\non = "b1"\ndirection = "x"\ndisplacement = "1 mm"\nsteps = 10\n'
    )
    with pytest.raises(SceneError, match="block 1 .*driven, but held by no"):
        laboratory.check(load(text))


def turned(fix: str):
    """A block on another, with a support of its own and a roller on top."""
    boxes = [box(f"b{k}", (0, 0, 0.06 * k), (0.2, 0.1, 0.06), "units", k) for k in range(2)]
    return load(
        'kinematics = "rigid"\n'
        + specimen(boxes, 0.02)
        + tables("material", {"units": MATERIAL})
        + tables("contact", {"unit_unit": ELASTIC})
        + listed("support", ['on = "b0"\nfix = "all"', f'on = "b1"\nfix = {fix}'])
        + '[drive]\non = "b1.z+"\ndirection = "z"\ndisplacement = "1 um"\nsteps = 10\n'
    )


@pytest.mark.parametrize(
    ("fix", "held"),
    [
        ('"rotation z"', [5]),
        ('["rotation z", "rotation z"]', [5]),
        ('["x", "rotation y"]', [0, 4]),
        ('"rotation"', [3, 4, 5]),
    ],
)
def test_a_support_may_hold_single_turns_of_a_rigid_block(fix, held):
    scene = turned(fix)
    built = assemble(scene)
    dt_over_mass = built.model.bodies[KINDS.index("rigid")].dt_over_mass[1]
    roller = {2, 3, 4}  # the drive's face may not tilt
    assert set((dt_over_mass == 0.0).nonzero()[0].tolist()) == set(held) | roller


def test_a_turn_about_an_axis_that_is_not_a_principal_one_is_refused():
    cells = {"specimen.cells": {"total": 40}, "specimen.divisions": [1, 1]}
    scene = load_scene(
        "wallette-mode-1", cells | {"support": [{"on": "units", "fix": "rotation x"}], "assumptions": {}}
    )
    with pytest.raises(SceneError, match=r"support\.0: x is no principal axis of rigid block .*fix 'rotation'"):
        assemble(scene)


def test_cells_of_the_plane_may_turn_in_it_though_their_other_principal_axes_are_oblique():
    supports = [
        {"on": "left plate", "fix": "all"},
        {"on": "right plate", "fix": "y"},
        {"on": "units", "fix": "rotation y"},
    ]
    cells = {"specimen.cells": {"total": 40}, "specimen.divisions": [1, 1]}
    scene = load_scene("wallette-mode-1", cells | {"support": supports})
    built = assemble(scene)
    units = built.specimen.sets["units"]
    held = built.model.bodies[KINDS.index("rigid")].dt_over_mass[built.model.layout.local[units], 3:] == 0.0
    assert held.sum(axis=1).tolist() == [1] * len(units)
    axis = built.model.layout.axes[units].transpose(0, 2, 1)[held]
    assert abs(abs(axis[:, 1]) - 1.0).max() < 1e-9


def pressed(size, degrees: float, displacements: str, fix: str):
    """A block on a slab, both turned about y, pressed down; 1 MPa is 10 kN."""
    slab, block = (box(name, (0, 0, z), size, "units", k) for k, (name, z) in enumerate((("slab", 0), ("block", 0.05))))
    turned = f'turned = {{about = "y", angle = "{degrees} deg", through = ["0 m", "0 m", "0 m"]}}'
    joint = 'normal_stiffness = "100 GPa/m"\nshear_stiffness = "40 GPa/m"\ntan_friction_angle = 0.75'
    return load(
        f'displacements = "{displacements}"\nlaw = "friction"\nkinematics = "rigid"\n'
        + specimen([slab, block], 0.01, more=turned)
        + tables("material", {"units": 'density = "2000 kg/m^3"'})
        + tables("contact", {"unit_unit": joint})
        + listed("support", ['on = "slab"\nfix = "all"', f'on = "block"\nfix = {fix}'])
        + '[drive]\non = "block"\ndirection = "-z"\ndisplacement = "0.05 mm"\nsteps = 1000\n[solver]\nrows = 10\n'
    )


@pytest.mark.parametrize("displacements", ["small", "large"])
@pytest.mark.parametrize("size", [(0.1, 0.1, 0.05), (0.1, 0.12, 0.05), (0.05, 0.05, 0.05)])
def test_a_block_turned_about_y_may_be_held_about_y_whatever_its_plan(displacements, size):
    """Its moments about the two other axes, or about y and one of them, are equal or not. Below 36.9 degrees and some
    it sticks, and presses with what both stiffnesses make of the way along them; beyond it slides."""
    for degrees, slides in ((5, False), (30, False), (40, False), (70, True)):
        result = laboratory.run(pressed(size, degrees, displacements, '["x", "y", "rotation y"]'))
        along, across = cos(radians(degrees)), sin(radians(degrees))
        normal = 100e9 * 5e-5 * along
        shear = 0.75 * normal if slides else 40e9 * 5e-5 * across
        expected = size[0] * size[1] * (normal * along + shear * across)
        assert abs(result.history.rows["force"][-1]) == pytest.approx(expected, rel=2e-3)
        assert result.summary["force_balance"] < 1e-9


@pytest.mark.parametrize("displacements", ["small", "large"])
def test_two_turns_may_be_held_that_leave_one_about_a_principal_axis(displacements):
    """A plane motion, of a block that the two others are no principal axes of."""
    scene = pressed((0.1, 0.12, 0.05), 30.0, displacements, '["x", "y", "rotation x", "rotation z"]')
    block = assemble(scene).model.bodies[KINDS.index("rigid")].dt_over_mass[1]
    assert (block == 0.0).tolist() == [True, True, True, True, False, True]
    result = laboratory.run(scene)
    assert result.summary["force_balance"] < 1e-9 and abs(result.history.rows["force"][-1]) > 1e3


def test_principal_axes_are_those_of_space_where_they_may():
    """One axis alone stays in its place, whatever the order of the moments; three equal moments leave all open."""
    turn = np.array([[0.8, 0.0, 0.6], [0.0, 1.0, 0.0], [-0.6, 0.0, 0.8]])
    tilt = turn @ turn[[1, 2, 0]][:, [1, 2, 0]]
    for moments in ([1.0, 2.0, 3.0], [2.0, 1.0, 3.0], [3.0, 3.0, 1.0], [1.0, 3.0, 3.0], [2.0, 2.0, 2.0]):
        tensors = np.array([matrix @ np.diag(moments) @ matrix.T for matrix in (np.eye(3), turn, tilt)])
        moment, axes = principal_axes(tensors)
        assert np.einsum("bij,bj,bkj->bik", axes, moment, axes) == pytest.approx(tensors, abs=1e-12)
        assert axes[0] == pytest.approx(np.eye(3)) and abs(axes[1, 1, 1]) == pytest.approx(1.0)


@pytest.mark.parametrize("kinematics", ["rigid", "affine", "tets"])
@pytest.mark.parametrize(("scale", "away"), [(1e-5, 0.0), (1e4, 0.0), (0.05, 1e3)])
def test_what_is_held_is_held_at_any_size_and_at_any_place(kinematics, scale, away):
    assert laboratory.check(load(column(kinematics, '"all"', 'z = "-9.81 m/s^2"', scale, away)))["blocks"] == 2
    with pytest.raises(SceneError, match="block 0 .*not held along z"):
        laboratory.check(load(column(kinematics, '["x", "y"]', 'z = "-9.81 m/s^2"', scale, away)))
