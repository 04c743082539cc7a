"""The barrel vault: courses in bond over a ring, joints that are whole, and an arch of the same section."""

import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.joints.find import find_joints
from geometry.polyhedra.measures import centroids, volumes
from geometry.structures.arch import arch
from geometry.structures.vault import vault
from tests.geometry.structures.drawing import joint_areas, require_sound

SIZES = {
    **{"radius": 1.2, "angle": np.radians(150.0), "courses": 9, "thickness": 0.2},
    **{"length": 2.0, "units_per_course": 4},
}
RING = 0.5 * np.sin(np.radians(150.0) / 9) * (1.3**2 - 1.1**2)
"""m2, front of one piece of the ring."""


def test_units_fill_the_ring_and_joints_are_those_of_the_drawing():
    specimen = vault(**SIZES)
    require_sound(specimen, 9 * RING * 2.0 + 2 * 0.2 * 0.1 * 2.0)
    assert specimen.blocks.count == 5 * 4 + 4 * 5 + 2
    joints = find_joints(specimen.blocks)
    heads = np.abs(joints.normal[:, 1]) > 1 - 1e-9
    assert joints.area[heads].sum() == pytest.approx((5 * 3 + 4 * 4) * RING, rel=1e-9)
    assert joints.area[~heads].sum() == pytest.approx(10 * 0.2 * 2.0, rel=1e-9)
    middle = joints.point[~heads] * (1.0, 0.0, 1.0)
    assert np.abs(np.einsum("ij,ij->i", middle, joints.normal[~heads])).max() < 1e-12, "bed joints are radial"
    assert specimen.section == pytest.approx(0.4)


@pytest.mark.parametrize(("units", "lap"), [(4, 0.25), (3.5, 2.0 / 7)])
def test_head_joints_stand_at_the_middle_of_the_units_of_the_next_course(units, lap):
    specimen = vault(**(SIZES | {"units_per_course": units}))
    joints = find_joints(specimen.blocks)
    heads = np.abs(joints.normal[:, 1]) > 1 - 1e-9
    around = np.arctan2(joints.point[heads, 0], joints.point[heads, 2]) + np.radians(75.0)
    course = np.floor(around / (np.radians(150.0) / 9)).astype(int)
    for c in range(8):
        here, above = (np.unique(np.round(joints.point[heads][course == k, 1], 9)) for k in (c, c + 1))
        assert np.abs(np.subtract.outer(here, above)).min() == pytest.approx(lap, rel=1e-6)


def test_a_vault_of_one_unit_in_a_course_is_an_arch():
    one = vault(**(SIZES | {"units_per_course": 1, "bond": "stack"}))
    same = arch(1.2, np.radians(150.0), 9, 0.2, 2.0)
    assert np.abs(centroids(one.blocks) - centroids(same.blocks)).max() < 1e-12
    assert one.sets["keystone"].tolist() == same.sets["keystone"].tolist()


def test_the_ends_and_the_crown_are_named():
    specimen = vault(**SIZES)
    middle = centroids(specimen.blocks)
    assert len(specimen.sets["front"]) == len(specimen.sets["back"]) == 9
    assert middle[specimen.sets["front"], 1].max() < 0.3 and middle[specimen.sets["back"], 1].min() > 1.7
    assert np.abs(middle[specimen.sets["keystone"], 0]).max() < 1e-12
    assert specimen.sets["left abutment"].tolist() == [40] and specimen.sets["right abutment"].tolist() == [41]


@pytest.mark.parametrize("facets", [2, 5])
def test_facets_bring_arch_and_vault_nearer_to_the_ring_and_leave_the_joints(facets):
    exact = 0.5 * np.radians(150.0) * (1.3**2 - 1.1**2)
    specimen = arch(1.2, np.radians(150.0), 9, 0.2, 0.3, facets)
    piece = np.radians(150.0) / (9 * facets)
    ring = volumes(specimen.blocks)[specimen.sets["voussoirs"]].sum()
    assert ring == pytest.approx(0.3 * exact * np.sin(piece) / piece, rel=1e-9)
    areas = joint_areas(find_joints(specimen.blocks))
    assert list(areas.values()) == pytest.approx([0.06] * 10, rel=1e-9)
    vaulted = vault(**SIZES, facets=facets)
    within = volumes(vaulted.blocks)[vaulted.sets["voussoirs"]].sum()
    assert within == pytest.approx(2.0 * exact * np.sin(piece) / piece, rel=1e-9)
    joints = find_joints(vaulted.blocks)
    heads = np.abs(joints.normal[:, 1]) > 1 - 1e-9
    assert joints.area[~heads].sum() == pytest.approx(10 * 0.2 * 2.0, rel=1e-9)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"courses": 1}, "number of courses is 1, it must be 2 or more; nearest: 2"),
        ({"units_per_course": 0}, "number of units along y is 0"),
        ({"units_per_course": 2.3}, "whole number"),
        ({"bond": "english"}, "bond 'english' is unknown; allowed: running, stack"),
        ({"thickness": 1.3}, "thickness is 1.3 m, it must be less than the radius"),
        ({"angle": 4.0}, "nearest: 180 deg"),
        ({"length": -1.0}, "length is -1 m"),
        ({"facets": 0}, "number of facets"),
    ],
)
def test_a_vault_that_cannot_be_built_says_what_would_work(change, message):
    with pytest.raises(GeometryError, match=message):
        vault(**(SIZES | change))
