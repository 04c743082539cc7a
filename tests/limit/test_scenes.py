"""Limit analysis of scenes: what grows, what is held, what is said where there is no answer."""

import numpy as np
import pytest

import masonry
from masonry.errors import SceneError
from tests.limit.one_block import DRIVE, SIDEWAYS, STRONG, block
from tests.scenes import load
from verification.cases.friction.collapse_in_one_run import DILATES
from verification.fixtures.arches import Arch, greatest_thrust, least_thrust
from verification.scene_runs import load as load_verified

WEIGHT = 2000 * 9.81 * 0.3
"""N/m2: density, g and depth of the packaged arch, whose radius is 1 m."""


def test_the_tilted_arch_of_the_gallery_falls_where_it_should():
    result = masonry.limit("arch-tilted")
    assert result.factor == pytest.approx(0.37361, abs=3e-6)
    assert "20.486" in str(result) and "tangent of the angle" in str(result)


def test_the_packaged_wall_of_ferris_and_tin_loi_falls_where_it_should():
    result = masonry.limit("wall-tilted")
    assert result.factor == pytest.approx(0.64286, rel=1e-4)
    assert result.specimen.blocks.count - len(result.specimen.sets["bottom course"]) == 33
    without = masonry.limit("wall-tilted", dilation=False)
    assert without.factor == pytest.approx(0.6403, rel=2e-3) and without.bound.startswith("no bound")


@pytest.mark.parametrize(
    ("name", "slides"),
    [("arch-tilted", False), ("wall-out-of-plane", False), ("wall-tilted", True), ("wall-with-window", True)],
)
def test_a_mechanism_that_slides_where_friction_does_not_dilate_has_a_word(name, slides):
    """What is the greatest with dilation is then too great for the scene."""
    result = masonry.limit(name)
    assert any("--no-dilation" in remark for remark in result.remarks) == slides
    without = masonry.limit(name, dilation=False).factor
    assert (without < 0.998 * result.factor) == slides and without <= (1 + 1e-6) * result.factor


def test_friction_that_dilates_by_its_angle_in_the_scene_needs_no_word():
    assert masonry.limit(load_verified("wall-tilted", DILATES)).remarks == []


def test_what_the_drive_pushes_with_lies_between_the_least_and_the_greatest_thrust():
    result = masonry.limit("arch-spread")
    assert result.factor == pytest.approx(WEIGHT * greatest_thrust(Arch(15, 0.15)), rel=1e-8)
    assert result.least == pytest.approx(WEIGHT * least_thrust(Arch(15, 0.15)), rel=1e-8)
    assert result.unit == "N"


PATTERNS = {
    "weight": ('pattern = "weight"\ndirection = "-x"', 0.5),
    "tilt": ('pattern = "tilt"\nabout = "y"', 0.5),
    "tilt back": ('pattern = "tilt"\nabout = "-y"', 0.5),
    "force": ('pattern = "force"\non = "block"\nforce = {x = "1 kN"}', 1.5),
    "force at the top": ('pattern = "force"\non = "block"\nforce = {x = "1 kN"}\nat = [0, 0, "1 m"]', 0.75),
    "traction": ('pattern = "traction"\non = "block.x-"\nstress = {x = "1 kPa"}', 5.0),
}


@pytest.mark.parametrize("name", PATTERNS)
def test_each_pattern_of_load_topples_a_block_where_it_should(name):
    """Weight 3 kN, 0.5 m wide, 1 m high: it topples at 0.75 kN m, before it slides."""
    text, expected = PATTERNS[name]
    assert masonry.limit(load(block(f"[limit]\n{text}"))).factor == pytest.approx(expected, rel=1e-8)


def test_a_point_off_the_middle_is_a_problem_in_space():
    """Pulled up at a corner of the top, 0.25 and 0.15 m off the middle, it lifts when half of W b reaches there."""
    more = '[limit]\npattern = "force"\non = "block"\nforce = {z = "1 kN"}\nat = ["0.5 m", "0.3 m", "1 m"]'
    result = masonry.limit(load(block(more)))
    assert "Clarabel" in result.method
    assert result.factor == pytest.approx(1.5, rel=1e-7)


def test_a_tilt_of_a_joint_with_strength_falls_at_the_angle_itself_not_at_its_tangent():
    """tan(t) W h/2 = W b/2 + f A b/2 / cos(t): the strength does not turn with gravity."""
    result = masonry.limit(load(block('[limit]\npattern = "tilt"\nabout = "y"', STRONG)))
    angle = np.arctan(result.factor)
    weight, strength = 3000.0, 4000.0 * 0.15
    assert np.sin(angle) * weight * 0.5 == pytest.approx((np.cos(angle) * weight + strength) * 0.25, rel=1e-8)
    assert result.thrust()["normal_force"] == pytest.approx([-weight * np.cos(angle)], rel=1e-8)
    assert result.thrust()["shear_force"] == pytest.approx([weight * np.sin(angle)], rel=1e-8)
    assert any("plastic" in remark for remark in result.remarks)


@pytest.mark.parametrize(("about", "expected"), [("y", 6 / 9.5), ("-y", 4 / 10.5)])
def test_a_tilt_turns_gravity_the_way_its_axis_says(about, expected):
    """By gravity (1, 0, -10) a block topples where (1 - 10 l) and (-10 - l) are as 0.5 m to 1 m; about -y with -l."""
    scene = load(
        block(f'[limit]\npattern = "tilt"\nabout = "{about}"').replace("[gravity]", '[gravity]\nx = "1 m/s^2"')
    )
    assert masonry.limit(scene).factor == pytest.approx(expected, rel=1e-8)


def test_what_is_held_by_a_drive_alone_needs_a_force_between_two_of_one_sign():
    """Pushed sideways by 2.4 kN, it topples beyond 1.5 kN on either side; the drive does not hold it from turning."""
    scene = load(block(DRIVE).replace("[gravity]", '[gravity]\nx = "8 m/s^2"').replace("= 0.7", "= 0.9"))
    result = masonry.limit(scene)
    assert (result.factor, result.least) == (pytest.approx(-900.0, rel=1e-7), pytest.approx(-3900.0, rel=1e-7))


def test_blocks_of_one_drive_move_as_one_whatever_each_of_them_resists():
    """Of 0.5 m and of 1 m, 3 kN and 6 kN; both slide at a friction of 0.2."""
    other = '  {name = "other", origin = ["0.7 m", "0 m", "0 m"], size = ["1 m", "0.3 m", "1 m"], unit = 2},\n]\n'
    text = block(DRIVE).replace("]\n[material", other + "[material").replace('"block"\ndir', '"blocks at z = 1 m"\ndir')
    result = masonry.limit(load(text.replace("= 0.7", "= 0.2")))
    assert (result.factor, result.least) == (pytest.approx(1800.0, rel=1e-7), pytest.approx(-1800.0, rel=1e-7))


def test_a_joint_off_the_plane_is_no_plane_problem():
    """The ground reaches below less than half of the depth: seen from the front it stands, and yet it falls over."""
    text = block('[limit]\npattern = "weight"\ndirection = "x"')
    assert masonry.limit(load(text.replace('"3 m", "0.3 m", "1 m"', '"3 m", "0.2 m", "1 m"'))).factor > 0.1
    with pytest.raises(SceneError, match="cannot stand"):
        masonry.limit(load(text.replace('"3 m", "0.3 m", "1 m"', '"3 m", "0.14 m", "1 m"')))


def test_strength_can_be_left_out():
    scene = load(block('[limit]\npattern = "weight"\ndirection = "x"', STRONG))
    assert masonry.limit(scene).factor == pytest.approx(0.5 * (1 + 600 / 3000), rel=1e-8)
    assert masonry.limit(scene, strength=False).factor == pytest.approx(0.5, rel=1e-8)
    worn = scene.with_({"contact.unit_unit.tan_residual_friction_angle": 0.3})
    assert masonry.limit(worn).factor == pytest.approx(0.5 * (1 + 600 / 3000), rel=1e-8)
    assert masonry.limit(worn, strength=False).factor == pytest.approx(0.3, rel=1e-8), "it slides"


def test_a_stone_that_crushes_is_weaker():
    scene = load(block('[limit]\npattern = "weight"\ndirection = "x"'))
    assert masonry.limit(scene, crushing="40 kPa").factor == pytest.approx(0.5 * (1 - 3000 / (40e3 * 0.15)), rel=1e-7)


def test_crushing_that_a_scene_has_is_named_where_it_is_left_out():
    crushing = 'law = "friction"\ncompressive_strength = "40 kPa"\ncrushing = "cut-off"'
    scene = load(block('[limit]\npattern = "weight"\ndirection = "x"', crushing))
    left_out = [remark for remark in masonry.limit(scene).remarks if '--crushing "0.04 MPa"' in remark]
    assert len(left_out) == 1 and "it may fall earlier" in left_out[0]
    assert not any("bear any pressure" in remark for remark in masonry.limit(scene, crushing="40 kPa").remarks)


def test_a_stone_that_crushes_does_not_turn_with_the_tilt():
    """sin(t) W h/2 = cos(t) W b/2 (1 - cos(t) W / (fc A))."""
    result = masonry.limit(load(block('[limit]\npattern = "tilt"\nabout = "y"')), crushing="40 kPa")
    angle, share = np.arctan(result.factor), 3000 / (40e3 * 0.15)
    assert np.tan(angle) == pytest.approx(0.5 * (1 - share * np.cos(angle)), rel=1e-7)


def test_a_traction_with_a_history_is_what_grows():
    more = """[[traction]]
on = "block.x-"
stress = {x = "1 kPa"}
history = [["0 s", 0], ["1 s", 1]]
"""
    result = masonry.limit(load(block(more)))
    assert result.factor == pytest.approx(5.0, rel=1e-8)
    assert result.words == "traction.0 at a share of 1"


def test_a_block_that_may_turn_about_one_axis_only_is_held_about_the_others():
    more = """[[support]]
on = "block"
fix = ["rotation y"]
[limit]
pattern = "weight"
direction = "x"
"""
    assert masonry.limit(load(block(more))).factor == pytest.approx(0.7, rel=1e-8), "it slides"


def test_blocks_that_deform_are_taken_as_rigid_and_held_as_they_were():
    deformable = {"kinematics": "affine", "material.units.young_modulus": "5 GPa", "material.units.poisson_ratio": 0.2}
    result = masonry.limit(masonry.load("arch", {**deformable, **SIDEWAYS}))
    assert result.factor == pytest.approx(masonry.limit(masonry.load("arch", SIDEWAYS)).factor, rel=1e-9)
    assert "every block is taken as rigid" in result.remarks


def test_a_block_that_may_deform_and_whose_middle_is_held_does_not_turn():
    elastic = {"kinematics": "affine", "material.units.young_modulus": "5 GPa", "material.units.poisson_ratio": 0.2}
    text = block('[limit]\npattern = "weight"\ndirection = "x"').replace('fix = "all"', 'fix = ["x", "y", "z"]')
    assert masonry.limit(load(text).with_(elastic)).factor == pytest.approx(0.5, rel=1e-8)


def test_a_scene_that_is_turned_or_larger_has_the_same_factor():
    pushed = {"limit": {"pattern": "force", "on": "keystone", "force": {"z": "-1 kN"}}}
    straight = masonry.limit(masonry.load("arch", pushed))
    askew = {"about": "z", "angle": "30 deg", "through": ["1 m", "0 m", "0 m"]}
    turned = masonry.limit(masonry.load("arch", {**pushed, "specimen.turned": askew}))
    assert "plane" in straight.method and "plane" not in turned.method
    assert turned.factor == pytest.approx(straight.factor, rel=1e-6)
    sizes = {"specimen.radius": "10 m", "specimen.thickness": "1.5 m", "specimen.depth": "3 m"}
    assert masonry.limit(masonry.load("arch", {**pushed, **sizes})).factor == pytest.approx(1e3 * straight.factor)


def test_inset_points_of_the_scene_let_an_arch_fall_earlier():
    scene = masonry.load("arch", {**SIDEWAYS, "specimen.contact_points": "gauss", "specimen.thickness": "250 mm"})
    corners, inset = masonry.limit(scene), masonry.limit(scene, points="scene")
    assert inset.factor < 0.9 * corners.factor
    assert "corners" in corners.points and "gauss" in inset.points


def test_nothing_that_resists_is_a_factor_of_0_with_a_word():
    result = masonry.limit(load(block('[limit]\npattern = "weight"\ndirection = "x"').replace("= 0.7", "= 0.0")))
    assert result.factor == pytest.approx(0.0, abs=1e-9)
    assert any(remark.startswith("nothing resists") for remark in result.remarks)


def test_the_factor_of_safety_of_a_scene_needs_no_load_to_be_named():
    arch = masonry.limit("arch", safety=True)
    assert arch.is_safety and arch.factor == pytest.approx(2.00932, rel=1e-4)
    tilted = load(block('[limit]\npattern = "tilt"\nabout = "y"', STRONG, '["2 m", "0.3 m", "0.2 m"]'))
    steep, weight = np.arctan(0.5), 2400.0
    by_hand = 0.7 / 0.5 + 100e3 * 0.6 / (weight * np.sin(steep))
    assert masonry.limit(tilted, safety=True, at=0.5).factor == pytest.approx(by_hand, rel=1e-4), "on an incline"
    pressed = '[[traction]]\non = "block.x-"\nstress = {x = "3 kPa"}\n'
    assert masonry.limit(load(block(pressed)), safety=True).factor == pytest.approx(0.7 * 3000 / 900, rel=1e-5)
    at = masonry.limit(masonry.load("arch", SIDEWAYS), safety=True, at=0.1)
    assert 1.0 < at.factor < arch.factor


def test_each_joint_of_a_thrust_carries_what_stands_above_it():
    result = masonry.limit(load(block('[limit]\npattern = "weight"\ndirection = "x"')))
    thrust = result.thrust()
    assert thrust["normal_force"] == pytest.approx([-3000.0], rel=1e-9), "it presses"
    assert thrust["force_x"] == pytest.approx([1500.0], rel=1e-9), "the block pushes the ground along x"
    assert thrust["eccentricity"] == pytest.approx([1.0], rel=1e-9), "at the edge it topples about"
