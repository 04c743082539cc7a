"""The arch: voussoirs of a ring that meet over whole joints, and abutments that go on beyond the springings."""

import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.joints.find import find_joints
from geometry.polyhedra.measures import bounds, centroids, volumes
from geometry.structures.arch import arch

SIZES = {"radius": 1.2, "angle": np.radians(140.0), "voussoirs": 9, "thickness": 0.2, "depth": 0.3}


def test_the_volumes_are_those_of_a_ring_of_straight_pieces_and_of_two_abutments():
    specimen, piece = arch(**SIZES), SIZES["angle"] / 9
    volume = volumes(specimen.blocks)
    ring = 0.5 * np.sin(piece) * (1.3**2 - 1.1**2) * 0.3
    assert volume[specimen.sets["voussoirs"]] == pytest.approx(np.full(9, ring), rel=1e-13)
    for side in ("left abutment", "right abutment"):
        assert volume[specimen.sets[side]] == pytest.approx([0.2 * 0.1 * 0.3], rel=1e-13)
    assert specimen.blocks.count == 11 and len(np.unique(specimen.blocks.unit)) == 11
    assert specimen.section == pytest.approx(0.2 * 0.3)


def test_every_joint_is_whole_and_points_at_the_centre_of_the_circle():
    specimen = arch(**SIZES)
    joints = find_joints(specimen.blocks)
    left, right = specimen.sets["left abutment"][0], specimen.sets["right abutment"][0]
    neighbours = {(k, k + 1) for k in range(8)} | {(0, left), (8, right)}
    area = {pair: 0.0 for pair in neighbours}
    for a, b, part in zip(joints.block_a, joints.block_b, joints.area, strict=True):
        area[(int(a), int(b))] += part
    assert list(area.values()) == pytest.approx([0.06] * 10, rel=1e-12)
    middle = joints.point * (1.0, 0.0, 1.0)
    assert np.abs(np.einsum("ij,ij->i", middle, joints.normal)).max() < 1e-12, "joints are radial"
    reach = np.linalg.norm(joints.patch_points[:, [0, 2]], axis=1)
    assert (reach.min(), reach.max()) == pytest.approx((1.1, 1.3), rel=1e-13), "from intrados to extrados"


def test_the_arch_is_its_own_mirror_image_with_the_crown_on_top():
    specimen = arch(**SIZES)
    centre = centroids(specimen.blocks)
    mirrored = centre[[*range(8, -1, -1), 10, 9]] * (-1.0, 1.0, 1.0)
    assert np.allclose(centre, mirrored, atol=1e-14)
    assert centre[specimen.sets["left abutment"][0], 0] < 0.0 < centre[specimen.sets["right abutment"][0], 0]
    assert int(np.argmax(centre[:, 2])) == specimen.sets["keystone"].item()


@pytest.mark.parametrize(("voussoirs", "keystone"), [(2, [0, 1]), (3, [1]), (8, [3, 4]), (15, [7])])
def test_the_keystone_is_at_the_crown_and_both_stones_beside_it_where_their_number_is_even(voussoirs, keystone):
    assert arch(**(SIZES | {"voussoirs": voussoirs})).sets["keystone"].tolist() == keystone


def test_a_semicircle_stands_level_on_its_abutments():
    specimen = arch(**(SIZES | {"angle": np.pi}))
    low, high = bounds(specimen.blocks)
    for side, x in (("left abutment", -1.2), ("right abutment", 1.2)):
        block = specimen.sets[side][0]
        assert np.allclose([low[block], high[block]], [[x - 0.1, 0, -0.1], [x + 0.1, 0.3, 0]], atol=1e-15)


@pytest.mark.parametrize("angle", [60.0, 140.0, 180.0])
def test_skewbacks_stand_upright_below_the_springings_and_meet_them_whole(angle):
    specimen = arch(**(SIZES | {"angle": np.radians(angle)}), abutments="skewbacks")
    spring = np.array([np.sin(np.radians(angle / 2)), np.cos(np.radians(angle / 2))])
    inner, outer = 1.1 * spring, 1.3 * spring
    mean = 0.5 * (inner[1] + outer[1]) - inner[1] + 0.1
    both = [int(specimen.sets[f"{side} abutment"][0]) for side in ("left", "right")]
    assert volumes(specimen.blocks)[both] == pytest.approx(np.full(2, (outer - inner)[0] * mean * 0.3), rel=1e-9)
    low, high = bounds(specimen.blocks)
    assert high[both[1], 0] == pytest.approx(outer[0]) and low[both[1], 0] == pytest.approx(inner[0])
    assert low[both, 2] == pytest.approx(np.full(2, inner[1] - 0.1), abs=1e-12)
    joints = find_joints(specimen.blocks)
    at = np.isin(joints.block_a, both) | np.isin(joints.block_b, both)
    assert joints.area[at].sum() == pytest.approx(2 * 0.06, rel=1e-9)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"abutments": "soft"}, "abutments is 'soft', allowed: square, skewbacks"),
        ({"voussoirs": 1}, "voussoirs is 1, it must be 2 or more; nearest: 2"),
        ({"voussoirs": 2.5}, "whole number"),
        ({"angle": np.radians(190)}, "angle is 190 deg.*nearest: 180 deg"),
        ({"angle": 0.0}, "angle is 0 deg"),
        ({"angle": float("nan")}, "angle is nan"),
        ({"thickness": 1.2}, "thickness is 1.2 m, it must be less than the radius of the centre line, 1.2 m"),
        ({"radius": -1.0}, "radius is -1 m.*1 m would be"),
        ({"depth": 0.0}, "depth is 0 m"),
    ],
)
def test_an_arch_that_cannot_be_built_says_what_would_work(change, message):
    with pytest.raises(GeometryError, match=message):
        arch(**(SIZES | change))
