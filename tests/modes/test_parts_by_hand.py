"""Parts of an oscillator by hand: bars, dead loads, joints that press and slide, and how corners move."""

import re

import numpy as np
import pytest

import masonry
from masonry.errors import SceneError
from masonry.modal_analysis.eigen import slowest
from masonry.modal_analysis.joint_words import frequencies_too_high
from masonry.modal_analysis.modes_data import block_of_points, moved_corners, own_points
from masonry.modal_analysis.oscillator import oscillator_of
from masonry.modal_analysis.pressed import equilibrium, pressed
from verification.references.swinging_stack import STACK, boxes, keys_of
from verification.scene_runs import load

WEIGHT = 9.81 * STACK.mass
ONE = {"specimen.box": boxes(STACK)[:2], "gravity": {"z": "-9.81 m/s^2"}, "settle.steps": 0, "motion": []}
"""A block of the stack on its foot, 0.5 x 0.2 x 0.25 m."""
STONE = {"density": "2000 kg/m^3", "young_modulus": "10 GPa", "poisson_ratio": 0.2}
STRONG = {
    "law": "brittle",
    "contact.unit_unit.tan_friction_angle": 0.6,
    "contact.unit_unit.tan_residual_friction_angle": 0.4,
}


def one(**more):
    return oscillator_of(load("stack", keys_of(STACK) | ONE | STRONG | more))


def strengths(tension, cohesion):
    return {
        "contact.unit_unit.tensile_strength": f"{tension!r} Pa",
        "contact.unit_unit.cohesion": f"{cohesion!r} Pa",
    }


def test_a_block_on_a_skew_bar_swings_along_it_alone():
    """E A / L along an axis through its centre; two motions across it and three turns are loose."""
    ends = [["0 m", "0 m", "0 m"], ["-1 m", "0.5 m", "0.3 m"]]
    push = {"drive": None, "traction": [{"on": "block.x+", "stress": {"x": "1 Pa"}}]}
    keys = push | {"bar.0.ends": ends, "support": [{"on": "foot", "fix": "all"}]}
    modes = masonry.modes(load("block-on-a-bar", keys), 1)
    along = np.array([-1.0, 0.5, 0.3])
    stiffness = 10e9 * 1e-4 / np.linalg.norm(along)
    assert modes.frequencies == pytest.approx(np.sqrt([stiffness / 2.0]) / (2.0 * np.pi)) and modes.loose == 5
    share = along**2 / (along @ along)
    assert modes.share[0] == pytest.approx(share) and modes.effective_mass[0] == pytest.approx(2.0 * share)
    assert abs(modes.shapes[0]["rigid"][1, :3] @ along) == pytest.approx(np.linalg.norm(along) / np.sqrt(2.0))
    slack = masonry.modes(load("block-on-a-bar", keys | {"bar.0.slack": "1 mm"}), 1)
    assert len(slack.frequencies) == 0 and "1 that hang slack left out" in str(slack)


def test_dead_loads_are_those_that_do_not_vary_and_the_weight():
    steady = {"on": "block 1.x+", "stress": {"x": "-3 kPa", "y": "1 kPa"}}
    shaken = {"on": "block 1.z+", "stress": {"z": "-50 kPa"}, "history": [["0 s", 0], ["1 ms", 1]]}
    oscillator = one(traction=[steady, shaken], **strengths(1e4, 1e5))
    area, half = STACK.depth * STACK.height, 0.5 * STACK.width
    load_of_block = oscillator.by_kind(oscillator.load)["rigid"][1]
    assert load_of_block[:3] == pytest.approx([-3e3 * area, 1e3 * area, -WEIGHT])
    turns = oscillator.layout.axes[1] @ load_of_block[3:]
    assert turns == pytest.approx([0.0, 0.0, half * 1e3 * area], abs=1e-9)


@pytest.mark.parametrize(("cohesion", "slides"), [(0.0, 4), (200.0, 2), (2.3e3, 2), (2.4e3, 0)])
def test_contacts_slide_where_the_shear_exceeds_cohesion_and_friction_of_their_own_pressure(cohesion, slides):
    """A push of 0.65 of the weight in mid-height: the pressure is even but for the moment, 1 +- 0.65 h x / (2 x^2), at
    points x = b / (2 root 3) of two to an edge."""
    push = 0.65 * WEIGHT / (STACK.depth * STACK.height)
    level = {"traction": [{"on": "block 1.x+", "stress": {"x": f"{push!r} Pa"}}]}
    low = {"contact.unit_unit.tan_friction_angle": 0.4, "specimen.points_per_edge": 2}
    oscillator = one(**level, **strengths(1e3, cohesion), **low)
    result = pressed(oscillator)
    x = oscillator.joints.point[:, 0]
    even, shear = WEIGHT / STACK.area, 0.65 * WEIGHT / STACK.area
    pressure = even * (1.0 + 0.65 * 0.5 * STACK.height * x / x[0] ** 2)
    assert result.closed.all() and (result.slides == (shear > cohesion + 0.4 * pressure)).all()
    assert result.slides.sum() == slides


@pytest.mark.parametrize(("tension", "opens"), [(2.0e3, 0), (1.0e3, 2), (0.0, 2)])
def test_points_open_where_they_pull_by_more_than_they_bear(tension, opens):
    """A push of 1.6 times the weight turns the block: its far points pull by 0.386 of the pressure of rest, and
    those that are left cannot hold it."""
    push = 1.6 * WEIGHT / (STACK.depth * STACK.height)
    level = {"traction": [{"on": "block 1.x+", "stress": {"x": f"{push!r} Pa"}}]}
    oscillator = one(**level, **strengths(tension, 1e6), **{"specimen.points_per_edge": 2})
    x = oscillator.joints.point[:, 0]
    pulls = WEIGHT / STACK.area * (1.6 * 0.5 * STACK.height / abs(x[0]) - 1.0)
    assert opens == (2 if pulls > tension else 0)
    jump = equilibrium(oscillator, np.ones(len(x), dtype=bool))[:, 0]
    assert STACK.kn * jump == pytest.approx(WEIGHT / STACK.area * (-1.0 - 1.6 * 0.5 * STACK.height * x / x[0] ** 2))
    if opens:
        with pytest.raises(SceneError, match="does not stand on joints that press"):
            pressed(oscillator)
    else:
        assert pressed(oscillator).closed.all()


@pytest.mark.parametrize("kinematics", ["rigid", "affine"])
def test_corners_move_by_the_turns_and_strains_about_the_axes_of_their_block(kinematics):
    """Voussoirs of an arch that leans: u = t + w x r of a rigid block, t + G A r of one that deforms, A its axes."""
    turned = {"about": "x", "angle": "25 deg", "through": ["0 m", "0 m", "0 m"]}
    keys = {"kinematics": kinematics, "material.units": STONE, "specimen.turned": turned}
    oscillator = oscillator_of(masonry.load("arch", keys))
    layout, blocks = oscillator.layout, own_points(oscillator.specimen)
    shape = np.random.default_rng(3).standard_normal(len(oscillator.mass))
    dofs, block = oscillator.by_kind(shape)[kinematics], block_of_points(blocks)
    wanted = np.zeros_like(blocks.points)
    for p, b in enumerate(block.tolist()):
        arm, axes, values = blocks.points[p] - layout.centroid[b], layout.axes[b], dofs[layout.local[b]]
        if kinematics == "rigid":
            wanted[p] = values[:3] + np.cross(axes @ values[3:], arm)
        else:
            wanted[p] = values[:3] + values[3:].reshape(3, 3) @ (arm @ axes)
    assert moved_corners(layout, blocks, oscillator.by_kind(shape)) == pytest.approx(wanted, rel=1e-12, abs=1e-12)


def test_the_farthest_corner_of_a_mode_moves_forward_by_1_and_blocks_by_the_mean_of_their_corners():
    modes = masonry.modes(load("stack", keys_of(STACK)), 24)
    block = block_of_points(modes.blocks)
    for corners, moved, content in zip(modes.corners, modes.movements(), modes.as_data()["modes"], strict=True):
        length = np.linalg.norm(corners, axis=1)
        farthest = corners[int(np.argmax(length > 1.0 - 1e-6))]
        largest = np.abs(farthest) > (1.0 - 1e-6) * np.abs(farthest).max()
        assert length.max() == pytest.approx(1.0) and farthest[int(np.argmax(largest))] > 0.0
        for b in range(modes.blocks.count):
            assert moved[b] == pytest.approx(corners[block == b].mean(axis=0), abs=1e-12)
        assert content["displacement"] == moved.tolist()
        assert content["period_s"] * content["frequency_hz"] == pytest.approx(1.0)
    first = np.linalg.norm(modes.movements()[0], axis=1)
    assert (np.diff(first) > 0.0).all() and first[0] == pytest.approx(0.0, abs=1e-9), "the farther up, the farther"


def beam(mesh_size):
    """A slender block of tets, 0.1 x 0.1 x 0.8 m, on a stiff joint: a cantilever."""
    ends = {"foot": (["-0.05 m", "-0.05 m", "-0.2 m"], "0.2 m"), "beam": (["-0.05 m", "-0.05 m", "0 m"], "0.8 m")}
    entries = [
        {"name": name, "origin": low, "size": ["0.1 m", "0.1 m", high], "unit": k}
        for k, (name, (low, high)) in enumerate(ends.items())
    ]
    soft = {"density": "2000 kg/m^3", "young_modulus": "1 GPa", "poisson_ratio": 0.0}
    stiff = {f"contact.unit_unit.{kind}_stiffness": "1000 GPa/m" for kind in ("normal", "shear")}
    start = [{"on": "beam", "velocity": ["1 mm/s", 0, 0]}]
    keys = {"specimen.box": entries, "kinematics": "tets", "material.units": soft, "motion": start}
    return masonry.modes(load("stack", keys | stiff | {"specimen.mesh_size": mesh_size}), 2)


@pytest.mark.parametrize("mesh_size", ["100 mm", "50 mm"])
def test_frequencies_of_coarse_tets_are_told_as_too_high_by_what_they_are_or_somewhat_more(mesh_size):
    modes = beam(mesh_size)
    (words,) = (words for words in modes.remarks if "the tets are too large" in words)
    exact = 3.516 / (2.0 * np.pi) * np.sqrt(1e9 * 0.1**4 / 12.0 / (2000.0 * 0.1**2 * 0.8**4))
    for number, frequency in enumerate(modes.frequencies, start=1):
        told = float(re.search(rf"([\d.]+) % in mode {number}", words)[1])
        assert 1.0 <= told / (100.0 * (frequency / exact - 1.0)) < 1.5


def test_frequencies_by_corner_points_are_told_as_too_high_by_what_they_are():
    """Beside those with points that bend as the area does: the first two modes bend; the one that is most too high
    twists, three times as stiffly by corners as by an even stress."""
    both = {
        points: masonry.modes(load("stack", keys_of(STACK) | {"specimen.contact_points": points}), 12)
        for points in ("vertex", "gauss")
    }
    corners = oscillator_of(both["vertex"].scene)
    modes = slowest(corners.strain_matrix, corners.mass, corners.free, 12)
    high = frequencies_too_high(corners, modes.shape, np.ones(len(corners.normal), dtype=bool))
    ratio = both["vertex"].frequencies[:2] / both["gauss"].frequencies[:2]
    assert high[:2] == pytest.approx(ratio - 1.0, rel=0.02)
    assert high.min() == pytest.approx(0.0, abs=1e-9), "up and down nothing bends"
    twists = int(np.argmax(high))
    assert twists > 1 and high[twists] == pytest.approx(3.0**0.5 - 1.0, rel=0.02)
    assert f"mode {twists + 1} by about {100.0 * high[twists]:.2g} %" in str(both["vertex"])
    assert not any("too stiffly" in words for words in both["gauss"].remarks)
