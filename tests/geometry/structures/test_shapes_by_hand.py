"""Structures course by course and corner by corner, with numbers of their own."""

import numpy as np
import pytest

from geometry.cells.request import CellRequest
from geometry.joints.find import find_joints
from geometry.polyhedra.measures import bounds, volumes
from geometry.structures.arch import arch
from geometry.structures.column import column
from geometry.structures.dome import dome
from geometry.structures.multi_leaf import multi_leaf
from geometry.structures.openings import Opening
from geometry.structures.vault import vault
from geometry.structures.wall import wall

LEAVES = {
    **{"length": 2.0, "height": 1.2, "leaf_thickness": 0.12, "core_thickness": 0.2, "unit_length": 0.4},
    **{"unit_height": 0.1, "core": CellRequest(total=80, space=True, regularise=False)},
}


@pytest.mark.parametrize("share", [0.1, 0.3, 0.7])
def test_headers_are_whole_units_course_by_course_and_evenly_shared_out(share):
    """Courses of five whole units, and of four between halves, by turns."""
    specimen = multi_leaf(**LEAVES, headers=share)
    low, high = bounds(specimen.blocks)
    headers = specimen.sets["headers"]
    course = np.round(low[:, 2] / 0.1).astype(int)
    assert high[headers, 0] - low[headers, 0] == pytest.approx(np.full(len(headers), 0.4))
    laid = {c: {round(x / 0.2) for x in low[headers[course[headers] == c], 0]} for c in range(12)}
    for c, begins in laid.items():
        ends = {0, 2, 4, 6, 8} if c % 2 == 0 else {1, 3, 5, 7}
        assert begins <= ends, "where a whole unit of this course is"
        for leaf in ("front leaf", "back leaf"):
            own = specimen.sets[leaf][course[specimen.sets[leaf]] == c]
            units = {round(x / 0.2) for x in low[own, 0]} - ({0, 9} if c % 2 else set())
            assert units == ends - begins, "headers take the place of these, and of no others"
    numbers = [len(begins) for begins in laid.values() if begins]
    assert sum(numbers) == round(share * 54) and max(numbers) - min(numbers) <= 1
    if share <= 0.3:
        assert max(numbers) <= 2, "every other unit at most"
    courses = np.flatnonzero([bool(begins) for begins in laid.values()])
    assert np.diff(courses).max(initial=0) - np.diff(courses).min(initial=12) <= 1
    assert courses.mean() + 0.5 == pytest.approx(6.0, abs=0.6), "as much in the lower half as in the upper one"


def test_the_section_of_a_wall_of_leaves_is_all_of_its_thickness():
    assert multi_leaf(**LEAVES).section == pytest.approx(2.0 * 0.44)


def outline(specimen, block: int) -> np.ndarray:
    """(n, 2) different corners of a block in x and z, in m, rounded."""
    faces = [specimen.blocks.face(f) for f in specimen.blocks.faces_of(block)]
    return np.unique(np.round(np.concatenate(faces)[:, [0, 2]], 9), axis=0)


@pytest.mark.parametrize(("skew", "courses"), [(10.0, 2), (35.0, 1)])
def test_joints_of_a_flat_arch_lean_from_the_upright_by_shares_of_the_skew_that_is_asked(skew, courses):
    """The skewbacks lean by the angle, so that the arch is wider above by twice its rise times the tangent."""
    angle, rise = np.radians(skew), 0.1 * courses
    opening = Opening("door", 1.2, 0.8, 1.0, head="flat arch", head_courses=courses, voussoirs=5, skew=angle)
    built = wall(3.2, 1.6, 0.2, 0.4, 0.1, opening=[opening])
    corners = np.concatenate([outline(built, b) for b in built.sets["flat arch"]])
    below, above = (np.unique(corners[np.isclose(corners[:, 1], z), 0]) for z in (1.0, 1.0 + rise))
    assert below == pytest.approx(np.linspace(1.2, 2.0, 6))
    assert above == pytest.approx(np.linspace(1.2 - rise * np.tan(angle), 2.0 + rise * np.tan(angle), 6))
    low, high = bounds(built.blocks)
    assert volumes(built.blocks).sum() == pytest.approx(0.2 * (3.2 * 1.6 - 0.8 * 1.0), rel=1e-9)
    assert len(built.sets["keystone"]) == 1
    middle = 0.5 * (low + high)[built.sets["keystone"][0]]
    assert middle[0] == pytest.approx(1.6)


@pytest.mark.parametrize("length", [2.2, 2.0])
def test_returns_of_unlike_sides_stand_where_the_facade_ends(length):
    """On the right alone, of a facade of an even and of an odd number of halves beside it: flush with its end, and its
    units cover the corner by turns with those of the facade, which reach beyond it then."""
    built = wall(length, 0.8, 0.2, 0.4, 0.1, returns="right", return_length=1.0, return_thickness=0.2)
    low, high = bounds(built.blocks)
    right, facade = built.sets["right return"], built.sets["facade"]
    assert (low[right, 0].min(), high[right, 0].max()) == (pytest.approx(length - 0.2), pytest.approx(length))
    assert high[right, 1].max() == pytest.approx(1.0)
    course = np.round(low[:, 2] / 0.1).astype(int)
    corner = [int((low[right[course[right] == c], 1] < 1e-9).sum()) for c in range(8)]
    assert sorted(corner) == [0] * 4 + [1] * 4 and all(a != b for a, b in zip(corner, corner[1:], strict=False))
    for c, covered in enumerate(corner):
        last = max(facade[course[facade] == c], key=lambda b: high[b, 0])
        assert high[last, 0] == pytest.approx(length - 0.2 * covered)
        assert covered or high[last, 0] - low[last, 0] > 0.3, "it is bonded in"
    assert volumes(built.blocks).sum() == pytest.approx(0.8 * (length * 0.2 + 0.8 * 0.2), rel=1e-9)


def test_a_lintel_bears_on_three_quarters_of_a_unit_where_no_end_of_it_stands_in_line():
    """Head joints above and below stand at multiples of 0.4 m: neither 1.0 and 2.2 nor 1.1 and 2.1 are among them."""
    built = wall(3.2, 1.2, 0.2, 0.4, 0.1, opening=[Opening("window", 1.3, 0.6, 0.4, sill=0.3)])
    low, high = bounds(built.blocks)
    lintel = built.sets["lintel"][0]
    assert (low[lintel, 0], high[lintel, 0]) == (pytest.approx(1.0), pytest.approx(2.2))
    beside = wall(3.2, 1.2, 0.2, 0.4, 0.1, opening=[Opening("window", 1.1, 0.6, 0.4, sill=0.3)])
    low, high = bounds(beside.blocks)
    lintel = beside.sets["lintel"][0]
    assert (low[lintel, 0], high[lintel, 0]) == (pytest.approx(0.9), pytest.approx(1.9)), "0.8 m would be in line"


def test_courses_of_a_wall_are_named_by_their_height():
    built = wall(1.2, 0.5, 0.2, 0.4, 0.1)
    low, high = bounds(built.blocks)
    for name, level in (("bottom course", 0.0), ("top course", 0.4)):
        assert set(built.sets[name]) == set(np.flatnonzero(np.isclose(low[:, 2], level))), name
    assert set(built.sets["left end"]) == set(np.flatnonzero(np.isclose(low[:, 0], 0.0)))
    assert set(built.sets["right end"]) == set(np.flatnonzero(np.isclose(high[:, 0], 1.2)))


def test_an_arch_stands_about_its_centre_line_on_blocks_half_as_long_as_its_joints():
    built = arch(2.0, np.radians(120.0), 9, 0.3, 0.5)
    ring = np.concatenate([outline(built, b) for b in built.sets["voussoirs"]])
    assert np.unique(np.round(np.hypot(*ring.T), 6)) == pytest.approx([1.85, 2.15])
    assert volumes(built.blocks)[built.sets["left abutment"]] == pytest.approx(0.3 * 0.15 * 0.5)
    upright = arch(2.0, np.radians(120.0), 9, 0.3, 0.5, abutments="skewbacks")
    for side, sign in (("left abutment", -1.0), ("right abutment", 1.0)):
        corners = outline(upright, int(upright.sets[side][0]))
        spring = np.array([sign * np.sin(np.radians(60.0)), np.cos(np.radians(60.0))])
        wanted = [1.85 * spring, 2.15 * spring, (2.15 * spring[0], 0.775), (1.85 * spring[0], 0.775)]
        assert corners == pytest.approx(np.unique(np.round(wanted, 9), axis=0), abs=1e-9), "level, half a joint below"


@pytest.mark.parametrize(("courses", "keys"), [(5, [2]), (6, [2, 3])])
def test_a_vault_lays_its_courses_by_turns_and_names_its_ends(courses, keys):
    built = vault(2.0, np.radians(90.0), courses, 0.3, 1.2, 3)
    low, high = bounds(built.blocks)
    units = built.sets["voussoirs"]
    count = [3 + c % 2 for c in range(courses)]
    assert len(units) == sum(count)
    course = np.repeat(np.arange(courses), count)
    for c in range(courses):
        wanted = [0.4, 0.4, 0.4] if c % 2 == 0 else [0.2, 0.4, 0.4, 0.2]
        assert (high - low)[units[course == c], 1] == pytest.approx(wanted)
    assert set(course[built.sets["keystone"]]) == set(keys)
    assert set(built.sets["front"]) == set(np.flatnonzero(np.isclose(low[units, 1], 0.0)))
    assert set(built.sets["back"]) == set(np.flatnonzero(np.isclose(high[units, 1], 1.2)))


def test_a_tapered_column_has_its_capital_by_its_head_and_its_section_by_its_foot():
    built = column(0.6, 3.0, 4, sides=8, top_diameter=0.4, base=0.2, capital=0.3, overhang=0.05)
    low, high = bounds(built.blocks)
    size = {name: (high - low)[built.sets[name][0]] for name in ("base", "capital")}
    assert size["base"] == pytest.approx([0.7, 0.7, 0.2]) and size["capital"] == pytest.approx([0.5, 0.5, 0.3])
    assert built.section == pytest.approx(0.5 * 8 * 0.3**2 * np.sin(np.pi / 4))
    foot = find_joints(built.blocks)
    lowest = (foot.block_a == built.sets["base"][0]) | (foot.block_b == built.sets["base"][0])
    assert foot.area[lowest].sum() == pytest.approx(built.section)
    assert high[built.sets["drum 1"], 0] == pytest.approx(0.3 * np.cos(np.pi / 8)), "a side looks along x"


def azimuth(specimen, block: int) -> float:
    """rad, of the mean of the corners of a block."""
    corners = np.concatenate([specimen.blocks.face(f) for f in specimen.blocks.faces_of(block)])
    x, y, _ = np.unique(np.round(corners, 9), axis=0).mean(axis=0)
    return float(np.arctan2(y, x))


def test_a_dome_stands_on_a_ring_half_as_deep_as_it_is_thick_and_breaks_joint_by_turns():
    built = dome(2.0, 0.2, 3, 8, 0.5)
    low, high = bounds(built.blocks)
    base = built.sets["base"]
    assert len(base) == 16 and (high - low)[base, 2] == pytest.approx(np.full(16, 0.1))
    side = 2.0 * np.sin(np.pi / 16)
    assert built.section == pytest.approx(16 * 0.5 * np.cos(np.pi / 16) * side * (2.1**2 - 1.9**2))
    ring = [np.array([azimuth(built, b) for b in built.sets[f"course {c}"]]) for c in (1, 2, 3)]
    turned = [np.mod(angles - np.pi / 8, np.pi / 4) for angles in ring]
    assert [bool(np.isclose(np.minimum(t, np.pi / 4 - t), 0.0).all()) for t in turned] == [True, False, True]
