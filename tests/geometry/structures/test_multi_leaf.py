"""The multi-leaf wall: leaves in bond, a core that fills what is between, and headers at the share that is asked."""

import numpy as np
import pytest

from geometry.blocks import GeometryError
from geometry.cells.request import CellRequest
from geometry.joints.find import connected, find_joints
from geometry.polyhedra.measures import bounds, volumes
from geometry.polyhedra.overlaps import check_overlaps
from geometry.structures.multi_leaf import multi_leaf
from tests.geometry.structures.drawing import area_across, require_bond

CORE = CellRequest(total=60, space=True, spread=0.3, regularise=False)
SIZES = {
    **{"length": 1.2, "height": 0.8, "leaf_thickness": 0.12, "core_thickness": 0.2},
    **{"unit_length": 0.4, "unit_height": 0.1, "core": CORE},
}
WHOLE = 4 * 3 + 4 * 2
"""Whole units of a leaf: courses of three, and of two between halves."""


@pytest.mark.parametrize("share", [0.0, 0.1, 0.25, 0.5, 0.8, 1.0])
def test_leaves_headers_and_core_fill_the_wall(share):
    specimen = multi_leaf(**SIZES, headers=share, base=0.1, beam=0.15)
    check_overlaps(specimen.blocks)
    volume = volumes(specimen.blocks)
    assert volume.sum() == pytest.approx(1.2 * 0.44 * (0.8 + 0.25), rel=1e-9)
    headers = specimen.sets.get("headers", np.arange(0))
    assert len(headers) == round(share * WHOLE)
    assert volume[headers] == pytest.approx(np.full(len(headers), 0.4 * 0.1 * 0.44), rel=1e-9)
    assert len(specimen.sets["core"]) == 60
    core = 1.2 * 0.8 * 0.2 - len(headers) * 0.4 * 0.1 * 0.2
    assert volume[specimen.sets["core"]].sum() == pytest.approx(core, rel=1e-9)
    low, high = bounds(specimen.blocks)
    assert (low[headers, 1] == 0.0).all() and high[headers, 1] == pytest.approx(np.full(len(headers), 0.44))
    joints = find_joints(specimen.blocks)
    assert len(np.unique(connected(specimen.blocks, joints))) == 1


def test_every_face_of_the_core_is_a_joint_but_for_its_ends():
    """Leaf to core, 2 x length x height less the headers; core to plates; all areas along y are those."""
    specimen = multi_leaf(**SIZES, headers=0.25, base=0.1, beam=0.1)
    joints = find_joints(specimen.blocks)
    core = np.isin(np.stack([joints.block_a, joints.block_b]), specimen.sets["core"])
    outer = core[0] ^ core[1]
    along_y = np.abs(joints.normal[:, 1]) > 1 - 1e-9
    face = 1.2 * 0.8 - len(specimen.sets["headers"]) * 0.4 * 0.1
    assert joints.area[outer & along_y].sum() == pytest.approx(2 * face, rel=1e-9)
    plates = outer & (np.maximum(joints.block_a, joints.block_b) >= specimen.sets["base"][0])
    ends = np.concatenate([specimen.sets["bottom course"], specimen.sets["top course"]])
    ending = len(np.intersect1d(ends, specimen.sets["headers"]))
    assert joints.area[plates].sum() == pytest.approx(2 * 1.2 * 0.2 - ending * 0.4 * 0.2, rel=1e-9)
    assert joints.area[plates].sum() <= area_across(joints, 2)


def test_leaves_and_headers_are_in_bond():
    specimen = multi_leaf(**SIZES, headers=0.25)
    for leaf in ("front leaf", "back leaf"):
        specimen.sets["face"] = np.concatenate([specimen.sets[leaf], specimen.sets["headers"]])
        require_bond(specimen, "face", 0, 0.1, 0.2)


def test_headers_are_spread_over_the_height():
    tall = {"height": 2.4, "length": 2.0, "core": CellRequest(total=40, space=True, regularise=False)}
    specimen = multi_leaf(**(SIZES | tall), headers=0.1)
    low, _ = bounds(specimen.blocks)
    courses = np.unique(np.round(low[specimen.sets["headers"], 2] / 0.1))
    assert len(courses) >= 4 and np.diff(courses).max() <= 2 * np.diff(courses).min()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"headers": 1.5}, "headers is 1.5, the share of the units that go through must be from 0 to 1; nearest: 1"),
        ({"headers": float("nan")}, "headers is nan"),
        ({"bond": "english"}, "bond 'english' is unknown; allowed: running, stack"),
        ({"length": 1.3}, "length is 1.3 m.*nearest: 1.2 m|nearest: 1.4 m"),
        ({"core": CellRequest(total=60)}, "the core is cut into cells in space"),
        ({"core_thickness": 0.0}, "core_thickness is 0 m"),
        ({"core": CellRequest(total=1, space=True), "headers": 0.5}, "total is 1, but there are"),
    ],
)
def test_a_multi_leaf_wall_that_cannot_be_built_says_what_would_work(change, message):
    with pytest.raises(GeometryError, match=message):
        multi_leaf(**(SIZES | change))
