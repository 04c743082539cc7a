"""The dome: voussoirs between two spheres, joints in planes through the centre, bond from course to course."""

import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.joints.find import connected, find_joints
from geometry.polyhedra.measures import bounds, face_areas_normals_centroids, volumes
from geometry.polyhedra.overlaps import check_overlaps
from geometry.polyhedra.validate import require_sound
from geometry.structures.dome import dome

SIZES = {"radius": 1.0, "thickness": 0.2, "courses": 4, "voussoirs": 6, "crown": 0.25}
INNER, OUTER = 0.9, 1.1


def directions(sides: int, courses: int = 4, angle: float = np.pi) -> np.ndarray:
    """(C + 1, n, 3) unit vectors to the corners of the facets."""
    steep = np.linspace(0.5 * angle, np.arcsin(0.25), courses + 1)[:, None]
    way = 2 * np.pi * np.arange(sides)[None] / sides
    return np.stack([np.sin(steep) * np.cos(way), np.sin(steep) * np.sin(way), np.cos(steep) + 0 * way], axis=-1)


def facet_volume(corner: np.ndarray) -> float:
    """m3 between the spheres over a flat facet (k, 3) that is drawn at radius 1: a pyramid cut off."""
    fan = [corner[0] @ np.cross(corner[k], corner[k + 1]) / 6 for k in range(1, len(corner) - 1)]
    return float(abs(sum(fan)) * (OUTER**3 - INNER**3))


@pytest.mark.parametrize(("bond", "span"), [("running", 2), ("stack", 1)])
@pytest.mark.parametrize("angle", [np.pi, np.radians(120.0)])
def test_volumes_and_joints_are_those_of_the_drawing(bond, span, angle):
    specimen = dome(**SIZES, bond=bond, angle=angle)
    require_sound(specimen.blocks)
    check_overlaps(specimen.blocks)
    sides, way = 6 * span, directions(6 * span, angle=angle)
    volume = volumes(specimen.blocks)
    for c in range(4):
        facet = np.stack([way[c, 0], way[c, 1], way[c + 1, 1], way[c + 1, 0]])
        mine = specimen.sets[f"course {c + 1}"]
        assert volume[mine] == pytest.approx(np.full(6, span * facet_volume(facet)), rel=1e-9)
    assert volume[specimen.sets["keystone"]] == pytest.approx([facet_volume(way[-1])], rel=1e-9)
    joints = find_joints(specimen.blocks)
    ring = 0.5 * (OUTER**2 - INNER**2)
    beds = sum(sides * ring * np.linalg.norm(np.cross(way[c, 0], way[c, 1])) for c in range(5))
    heads = sum(6 * ring * np.linalg.norm(np.cross(way[c, 0], way[c + 1, 0])) for c in range(4))
    below = sides * 0.2 * 0.1  # between the blocks of the base
    assert joints.area.sum() == pytest.approx(beds + heads + below, rel=1e-9)
    above = ~np.isin(joints.block_a, specimen.sets["base"])
    assert np.abs(np.einsum("ni,ni->n", joints.point[above], joints.normal[above])).max() < 1e-12
    assert specimen.section == pytest.approx(sides * ring * np.linalg.norm(np.cross(way[0, 0], way[0, 1])), rel=1e-9)
    assert len(np.unique(connected(specimen.blocks, joints))) == 1


def test_there_are_no_gaps_every_face_is_a_joint_or_looks_out():
    specimen = dome(**SIZES)
    area, normal, centroid = face_areas_normals_centroids(specimen.blocks)
    owner = specimen.blocks.face_block()
    radial = np.abs(np.einsum("fi,fi->f", normal, centroid)) / np.linalg.norm(centroid, axis=1) > 0.5
    shell = ~np.isin(owner, specimen.sets["base"])
    joints = find_joints(specimen.blocks)
    base = np.isin(joints.block_a, specimen.sets["base"]) & np.isin(joints.block_b, specimen.sets["base"])
    bed = np.isin(joints.block_a, specimen.sets["base"]) ^ np.isin(joints.block_b, specimen.sets["base"])
    sides = area[shell & ~radial].sum()
    assert 2 * joints.area[~base & ~bed].sum() + joints.area[bed].sum() == pytest.approx(sides, rel=1e-9)


def test_head_joints_stand_at_the_middle_of_the_voussoirs_of_the_next_course():
    joints = find_joints(dome(**SIZES).blocks)
    heads = np.abs(joints.normal[:, 2]) < 1e-9
    heads &= joints.point[:, 2] > 1e-9
    around = np.round(np.arctan2(joints.point[heads, 1], joints.point[heads, 0]) / (np.pi / 6)) % 12
    steep = np.arccos(joints.point[heads, 2] / np.linalg.norm(joints.point[heads], axis=1))
    course = np.floor((np.pi / 2 - steep) / ((np.pi / 2 - np.arcsin(0.25)) / 4))
    for c in range(4):
        assert set(around[course == c] % 2) == {c % 2}


def test_a_hemisphere_stands_level_and_open_domes_have_no_keystone():
    specimen = dome(**SIZES, closed=False)
    low, high = bounds(specimen.blocks)
    assert np.abs(high[specimen.sets["base"], 2]).max() == 0.0
    assert low[specimen.sets["course 1"], 2].min() == 0.0
    assert "keystone" not in specimen.sets
    assert specimen.blocks.count == 4 * 6 + 12


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"courses": 0}, "number of courses along x is 0"),
        ({"voussoirs": 2}, "number of voussoirs is 2, it must be 3 or more; nearest: 3"),
        ({"crown": 1.0}, "crown is 1 m, it must be less than the radius at the springing, 1 m"),
        ({"crown": 0.0}, "crown is 0 m"),
        ({"thickness": 1.0}, "thickness is 1 m, it must be less than the radius"),
        ({"angle": 4.0}, "angle is 229.183 deg.*nearest: 180 deg"),
        ({"bond": "flemish"}, "bond 'flemish' is unknown; allowed: running, stack"),
        ({"radius": float("nan")}, "radius is nan"),
    ],
)
def test_a_dome_that_cannot_be_built_says_what_would_work(change, message):
    with pytest.raises(GeometryError, match=message):
        dome(**(SIZES | change))
