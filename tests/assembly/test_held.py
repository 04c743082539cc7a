"""A part that a dead load could move as a whole is refused; one that nothing pushes may float."""

import pytest

from masonry.assembly.assemble import assemble
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.model.layout import KINDS
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
    ("fix", "held"), [('"rotation z"', [5]), ('["x", "rotation y"]', [0, 4]), ('"rotation"', [3, 4, 5])]
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


@pytest.mark.parametrize("kinematics", ["rigid", "affine", "tets"])
@pytest.mark.parametrize(("scale", "away"), [(1e-5, 0.0), (1e4, 0.0), (0.05, 1e3)])
def test_what_is_held_is_held_at_any_size_and_at_any_place(kinematics, scale, away):
    assert laboratory.check(load(column(kinematics, '"all"', 'z = "-9.81 m/s^2"', scale, away)))["blocks"] == 2
    with pytest.raises(SceneError, match="block 0 .*not held along z"):
        laboratory.check(load(column(kinematics, '["x", "y"]', 'z = "-9.81 m/s^2"', scale, away)))
