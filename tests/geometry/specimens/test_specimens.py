import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.joints.find import find_joints
from geometry.polyhedra.measures import bounds, centroids, volumes
from geometry.specimens.boxes import boxes
from geometry.specimens.stacked import couplet
from geometry.specimens.wallette import wallette

PAPER = {
    "courses": 4,
    "units_per_course": 2,
    "unit_length": 0.24,
    "unit_height": 0.113,
    "thickness": 0.0115,
    "joint_thickness": 0.01,
}


def test_the_wallette_of_the_paper_has_its_dimensions_and_counts():
    specimen = wallette(**PAPER, divisions=(6, 4), plates=0.05)
    low, high = bounds(specimen.blocks)
    wall = specimen.sets["units"]
    assert specimen.blocks.count == 4 * 12 * 4 + 2
    assert np.array_equal(low[wall].min(axis=0), [0, 0, 0])
    assert np.array_equal(high[wall].max(axis=0), [0.5, 0.0115, 0.492])
    assert specimen.section == pytest.approx(0.492 * 0.0115)
    assert volumes(specimen.blocks)[wall].sum() == pytest.approx(0.5 * 0.492 * 0.0115, rel=1e-14)
    assert {name: len(blocks) for name, blocks in specimen.sets.items()} == {
        "units": 192,
        "left end": 16,
        "right end": 16,
        "bottom course": 48,
        "top course": 48,
        "left plate": 1,
        "right plate": 1,
    }
    assert specimen.blocks.groups == ("units", "plates")
    assert len(np.unique(specimen.blocks.unit)) == 10 + 2


def test_plates_of_a_wallette_stand_outside_its_ends():
    specimen = wallette(**PAPER, plates=0.05)
    low, high = bounds(specimen.blocks)
    left, right = specimen.sets["left plate"][0], specimen.sets["right plate"][0]
    assert np.allclose([low[left], high[left]], [[-0.05, 0, 0], [0, 0.0115, 0.492]], atol=1e-16)
    assert np.allclose([low[right], high[right]], [[0.5, 0, 0], [0.55, 0.0115, 0.492]], atol=1e-16)
    assert np.all(low[specimen.sets["left end"], 0] == 0)
    assert np.all(high[specimen.sets["right end"], 0] == 0.5)


def test_base_and_beam_of_a_wallette_lie_below_and_above_it():
    specimen = wallette(**PAPER, base=0.1, beam=0.2)
    low, high = bounds(specimen.blocks)
    base, beam = specimen.sets["base"][0], specimen.sets["beam"][0]
    assert np.allclose([low[base], high[base]], [[0, 0, -0.1], [0.5, 0.0115, 0]], atol=1e-16)
    assert np.allclose([low[beam], high[beam]], [[0, 0, 0.492], [0.5, 0.0115, 0.692]], atol=1e-16)
    assert specimen.section == pytest.approx(0.5 * 0.0115), "of a bed joint, which the beam presses and shears"
    joints = find_joints(specimen.blocks)
    for block, course in ((base, "bottom course"), (beam, "top course")):
        touched = (joints.block_a == block) | (joints.block_b == block)
        assert joints.area[touched].sum() == pytest.approx(0.5 * 0.0115, rel=1e-12)
        others = np.union1d(joints.block_a[touched], joints.block_b[touched])
        assert np.array_equal(np.setdiff1d(others, [block]), specimen.sets[course])


def test_a_wallette_between_plates_keeps_the_section_of_a_test_along_x():
    specimen = wallette(**PAPER, plates=0.05, base=0.1)
    assert specimen.section == pytest.approx(0.492 * 0.0115)
    assert [name for name in specimen.sets if "course" not in name and "end" not in name] == [
        "units",
        "left plate",
        "right plate",
        "base",
    ]
    assert len(np.unique(specimen.blocks.unit)) == 10 + 3


def test_half_units_refuse_an_odd_division_and_name_the_nearest_even_ones():
    with pytest.raises(GeometryError, match="nearest: 4 or 6"):
        wallette(**PAPER, divisions=(5, 2))
    assert wallette(**(PAPER | {"courses": 1}), divisions=(5, 2)).blocks.count == 20


def test_a_couplet_stacks_plates_units_and_mortar_from_zero_upwards():
    specimen = couplet(0.2, 0.05, 0.06, (4, 2, 1), mortar=(0.01, (4, 2, 2)), plates=0.02)
    low, high = bounds(specimen.blocks)
    reach = {name: (low[s, 2].min(), high[s, 2].max()) for name, s in specimen.sets.items()}
    expected = {
        "bottom": (0.02, 0.08),
        "top": (0.09, 0.15),
        "units": (0.02, 0.15),
        "mortar": (0.08, 0.09),
        "bottom plate": (0, 0.02),
        "top plate": (0.15, 0.17),
    }
    assert list(reach) == list(expected)
    assert np.allclose(list(reach.values()), list(expected.values()), atol=1e-15)
    assert {name: len(s) for name, s in specimen.sets.items()} == {
        "bottom": 8,
        "top": 8,
        "units": 16,
        "mortar": 16,
        "bottom plate": 1,
        "top plate": 1,
    }
    assert specimen.section == pytest.approx(0.01)
    group_of = {name: specimen.blocks.groups[specimen.blocks.group[s[0]]] for name, s in specimen.sets.items()}
    assert list(group_of.values()) == ["units", "units", "units", "mortar", "plates", "plates"]
    del specimen.sets["units"]
    assert sorted(np.unique(specimen.blocks.unit[s]).tolist() for s in specimen.sets.values()) == [
        [0],
        [1],
        [2],
        [4],
        [5],
    ]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"length": 0.0}, "length is 0 m"),
        ({"height": -0.05}, "0.05 m would be"),
        ({"divisions": (1, 0, 1)}, "along y is 0.*nearest: 1"),
        ({"divisions": (1, 1)}, "has 2 numbers"),
        ({"plates": 0.0}, "plates is 0 m"),
        ({"mortar": (-0.01, (1, 1, 1))}, "mortar thickness"),
        ({"mortar": (0.01, (1, 1, 0.5))}, "mortar divisions along z is 0.5"),
        ({"width": float("nan")}, "width is nan"),
    ],
)
def test_a_couplet_that_cannot_be_built_says_what_would_work(change, message):
    with pytest.raises(GeometryError, match=message):
        couplet(**({"length": 0.2, "width": 0.05, "height": 0.05} | change))


def test_boxes_have_a_set_for_every_name_and_group():
    specimen = boxes(
        [
            ("a", (0, 0, 0), (1, 1, 1), "units", 0, (2, 1, 1)),
            ("b", (1, 0, 0), (1, 1, 1), "units", 1, (1, 1, 1)),
            ("floor", (0, 0, -1), (2, 1, 1), "floor", 2, (1, 1, 1)),
        ],
        section=1.0,
    )
    assert {name: s.tolist() for name, s in specimen.sets.items()} == {
        "units": [0, 1, 2],
        "floor": [3],
        "a": [0, 1],
        "b": [2],
    }
    assert specimen.blocks.unit.tolist() == [0, 0, 1, 2]
    assert np.allclose(centroids(specimen.blocks)[3], (1, 0.5, -0.5))


def test_boxes_with_ambiguous_names_are_refused():
    with pytest.raises(GeometryError, match="2 boxes are called 'a'"):
        boxes([("a", (i, 0, 0), (1, 1, 1), "g", i, (1, 1, 1)) for i in range(2)], 1.0)
    with pytest.raises(GeometryError, match="name of a box and of the group of 'b'"):
        boxes([("a", (0, 0, 0), (1, 1, 1), "g", 0, (1, 1, 1)), ("b", (1, 0, 0), (1, 1, 1), "a", 1, (1, 1, 1))], 1.0)
