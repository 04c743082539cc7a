"""The wall against its drawing: volumes, joints, bond, corners, openings, and what is refused."""

import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.joints.find import connected, find_joints
from geometry.polyhedra.measures import bounds, volumes
from geometry.structures.openings import Opening
from geometry.structures.wall import wall
from tests.geometry.structures.drawing import area_across, joint_areas, require_bond, require_sound

MODULE, RISE, THICK = 0.25, 0.09, 0.12
SIZES = {
    **{"length": 3.0, "height": 16 * RISE, "thickness": THICK},
    **{"unit_length": 0.24, "unit_height": 0.08, "joint_thickness": 0.01},
}
WINDOW = Opening("window", 1.0, 1.0, 6 * RISE, 5 * RISE)
DOOR = Opening("door", 0.5, 0.75, 11 * RISE)
BOTH = {"returns": "both", "return_length": THICK + 5 * MODULE / 2, "length": 3.0}


def test_a_wall_without_openings_is_the_wallette_of_its_bond():
    from geometry.specimens.wallette import wallette

    ours = wall(**SIZES, base=0.1, beam=0.15)
    theirs = wallette(16, 12, 0.24, 0.08, THICK, 0.01, base=0.1, beam=0.15)
    for mine, other in zip(bounds(ours.blocks), bounds(theirs.blocks), strict=True):
        assert np.abs(mine - other).max() < 1e-12
    assert ours.section == pytest.approx(theirs.section)
    for name in ("units", "left end", "right end", "bottom course", "top course", "base", "beam"):
        assert ours.sets[name].tolist() == theirs.sets[name].tolist(), name


@pytest.mark.parametrize(
    ("bond", "length", "lap"), [("running", 3.125, 0.5), ("english", 3.0, 0.25), ("flemish", 2.875, 0.25)]
)
def test_every_bond_fills_the_wall_and_laps(bond, length, lap):
    specimen = wall(**(SIZES | {"length": length}), bond=bond, unit_width=0.115)
    require_sound(specimen, length * SIZES["height"] * THICK)
    require_bond(specimen, "facade", 0, RISE, lap * MODULE)
    joints = find_joints(specimen.blocks)
    assert area_across(joints, 2) == pytest.approx(15 * length * THICK, rel=1e-9), "bed joints"


def test_a_window_takes_its_volume_and_its_lintel_bears_beside_it():
    specimen = wall(**SIZES, opening=[WINDOW])
    require_sound(specimen, 3.0 * SIZES["height"] * THICK - 1.0 * 6 * RISE * THICK)
    require_bond(specimen, "facade", 0, RISE, MODULE / 4)
    lintel = int(specimen.sets["lintel"][0])
    assert specimen.sets["window lintel"].tolist() == [lintel]
    low, high = (corner[lintel] for corner in bounds(specimen.blocks))
    assert (low[2], high[2]) == pytest.approx((11 * RISE, 12 * RISE), abs=1e-12)
    bearing = WINDOW.left - low[0]
    assert bearing == pytest.approx(high[0] - 2.0) and 0.5 * MODULE <= bearing <= 1.25 * MODULE
    shared = {pair: area for pair, area in joint_areas(find_joints(specimen.blocks)).items() if lintel in pair}
    below = [area for (a, b), area in shared.items() if high[2] > bounds(specimen.blocks)[1][a + b - lintel][2]]
    assert sum(below) == pytest.approx(2 * bearing * THICK, rel=1e-9)
    ends = [area for area in shared.values() if area == pytest.approx(RISE * THICK, rel=1e-9)]
    assert len(ends) >= 2, "units stand at both ends of the lintel"


@pytest.mark.parametrize("left", [0.5, 0.5625, 0.625, 0.75, 0.8125, 1.0])
@pytest.mark.parametrize("width", [0.75, 1.0, 1.125])
def test_no_end_of_a_lintel_stands_in_line_with_a_head_joint(left, width):
    try:
        specimen = wall(**SIZES, opening=[Opening("w", left, width, 6 * RISE, 3 * RISE)])
    except GeometryError as error:
        assert "nearest: left" in str(error)
        return
    ends = [corner[specimen.sets["lintel"][0], 0] for corner in bounds(specimen.blocks)]
    low, high = bounds(specimen.blocks)
    for row in (8, 10):
        beside = specimen.sets["facade"][np.abs(low[specimen.sets["facade"], 2] - row * RISE) < 1e-9]
        joints = np.intersect1d(np.round(low[beside, 0], 9), np.round(high[beside, 0], 9))
        assert np.abs(np.subtract.outer(ends, joints)).min() > 1e-6


def test_a_flat_arch_meets_in_one_point_and_stands_on_its_skewbacks():
    head = WINDOW._replace(head="flat arch", head_courses=2, voussoirs=9, left=1.0, width=0.75)
    specimen = wall(**SIZES, opening=[head])
    require_sound(specimen, 3.0 * SIZES["height"] * THICK - 0.75 * 6 * RISE * THICK)
    stones = specimen.sets["flat arch"]
    assert specimen.sets["keystone"].tolist() == [stones[4]] == specimen.sets["window keystone"].tolist()
    slope = 2 * RISE * np.tan(head.skew)
    area = 0.5 * (0.75 + 0.75 + 2 * slope) * 2 * RISE
    assert volumes(specimen.blocks)[stones].sum() == pytest.approx(area * THICK, rel=1e-9)
    joints = find_joints(specimen.blocks)
    within = np.isin(joints.block_a, stones) & np.isin(joints.block_b, stones)
    point = np.array([1.375, 0.0, 11 * RISE - 0.375 / np.tan(head.skew)])
    arm = (joints.point[within] - point) * (1.0, 0.0, 1.0)
    assert within.sum() and np.abs(np.einsum("ni,ni->n", arm, joints.normal[within])).max() < 1e-12
    skewback = np.isin(joints.block_a, stones) ^ np.isin(joints.block_b, stones)
    skewback &= np.abs(joints.normal[:, 0]) > 0.5
    assert joints.area[skewback].sum() == pytest.approx(2 * np.hypot(2 * RISE, slope) * THICK, rel=1e-9)


def test_returns_are_bonded_in_at_both_corners():
    specimen = wall(**(SIZES | BOTH | {"length": 2 * 0.125 + 11 * MODULE}), opening=[WINDOW], base=0.1)
    length, back = 3.0, BOTH["return_length"]
    plan = length * THICK + 2 * (back - THICK) * MODULE / 2
    require_sound(specimen, plan * (SIZES["height"] + 0.1) - 1.0 * 6 * RISE * THICK)
    require_bond(specimen, "facade", 0, RISE, MODULE / 4)
    for side in ("left return", "right return"):
        require_bond(specimen, side, 1, RISE, MODULE / 4)
        low, high = bounds(specimen.blocks)
        own = specimen.sets[side]
        assert high[own, 1].max() == pytest.approx(back)
        at_corner = own[low[own, 1] < 1e-9]
        assert len(at_corner) == 8, "every other course of a return lies across the corner"
        assert np.unique(np.round(low[at_corner, 2] / RISE)).tolist() in ([*range(0, 16, 2)], [*range(1, 16, 2)])
    assert len(np.unique(connected(specimen.blocks, find_joints(specimen.blocks)))) == 1
    assert len(specimen.sets["base"]) == 3


def test_bed_joints_of_a_wall_with_returns_are_those_of_its_plan():
    specimen = wall(**(SIZES | BOTH))
    plan = 3.0 * THICK + 2 * (BOTH["return_length"] - THICK) * MODULE / 2
    assert area_across(find_joints(specimen.blocks), 2) == pytest.approx(15 * plan, rel=1e-9)


def test_openings_are_named_in_their_sets():
    specimen = wall(**SIZES, opening=[DOOR, WINDOW._replace(left=2.0, width=0.5)])
    assert len(specimen.sets["lintel"]) == 2
    assert specimen.sets["door lintel"][0] in specimen.sets["lintel"]


def test_an_opening_to_the_top_has_the_beam_as_its_head():
    specimen = wall(**SIZES, opening=[WINDOW._replace(height=11 * RISE, head="none")], beam=0.2)
    assert "lintel" not in specimen.sets
    require_sound(specimen, 3.0 * THICK * (16 * RISE + 0.2) - 11 * RISE * THICK)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"length": 3.05}, "length is 3.05 m, it must be made of half units .* nearest: 3 m"),
        ({"height": 1.0}, "height is 1 m, it must be a multiple of a course of 0.09 m .* nearest: 0.99 m"),
        ({"height": 0.001}, "nearest: 0.09 m"),
        ({"bond": "english"}, "unit_width is needed"),
        ({"opening": [WINDOW._replace(left=0.0)]}, "'window': too little wall beside it; .*nearest: left = "),
        ({"opening": [WINDOW._replace(width=4.0)]}, "too little wall beside it"),
        (
            {"opening": [WINDOW._replace(left=1.02)]},
            "a piece .* mm long in course .*; nearest: left = 1 m|nearest: left",
        ),
        ({"opening": [WINDOW._replace(sill=0.4)]}, "sill of opening 'window' is 0.4 m.*nearest: 0.36 m"),
        ({"opening": [WINDOW._replace(height=0.5)]}, "height of opening 'window' is 0.5 m.*nearest: 0.54 m"),
        ({"opening": [WINDOW._replace(height=0.001)]}, "nearest: 0.09 m"),
        ({"opening": [WINDOW._replace(sill=16 * RISE)]}, "begins at 1.44 m, not below the top of the wall, 1.44 m"),
        ({"opening": [WINDOW._replace(bearing=0.01)]}, "bears on 0.01 m, less than a quarter of a unit"),
        ({"opening": [WINDOW._replace(height=11 * RISE)]}, "reaches the top of the wall, where no lintel fits"),
        ({"opening": [WINDOW._replace(height=12 * RISE)]}, "above the wall of 1.44 m"),
        ({"opening": [WINDOW._replace(head="none")]}, "has no head, but 5 courses above it"),
        ({"opening": [WINDOW._replace(head_courses=6)]}, "6 courses high, above it are 5"),
        ({"opening": [WINDOW, WINDOW]}, "2 openings are named 'window'"),
        ({"opening": [WINDOW, WINDOW._replace(name="b", left=1.5)]}, "'window' and 'b', .* overlap by"),
        ({"opening": [WINDOW, WINDOW._replace(name="b", left=2.0, width=0.5)]}, "'window' and 'b'"),
        ({"opening": [WINDOW._replace(width=0.0)]}, "width is 0 m"),
        ({**BOTH, "return_thickness": 0.5}, "return_thickness is 0.5 m: .*nearest: 0.1875 m"),
        ({**BOTH, "thickness": 0.4}, "thickness is 0.4 m: .*nearest: 0.1875 m"),
        ({**BOTH, "return_length": 0.3}, "return_length is 0.3 m, of which corners take 0.12 m.*nearest: 0.245 m"),
        ({**BOTH, "return_length": None}, "needs return_length"),
        ({**BOTH, "bond": "stack"}, "in running bond only"),
        ({"return_length": 1.0}, "there are no returns"),
    ],
)
def test_a_wall_that_cannot_be_built_says_what_would_work(change, message):
    with pytest.raises(GeometryError, match=message):
        wall(**(SIZES | change))
