"""A wall with two cracks that are alike, of which one opens."""

from dataclasses import replace
from functools import cache

import numpy as np

from masonry import scene
from masonry.laboratory import laboratory
from masonry.laboratory.symmetry import symmetry_lost

SHORT = {"drive.displacement": "0.06 mm"}


@cache
def run(**changes):
    return laboratory.run(scene.load("wallette-mode-1", SHORT | changes))


def test_a_symmetric_wall_says_that_one_of_two_cracks_opened():
    result = run()
    assert result.summary["symmetry_lost"] == "x"
    assert "have left the symmetry of the specimen across x" in result.trust
    assert not result.trust.startswith("with care")


def test_a_symmetric_wall_whose_cracks_are_symmetric_says_nothing():
    cracks = run(**{"drive.displacement": "0.03 mm"})
    assert cracks.history.frames[-1].damage.max() > 0.3
    assert cracks.summary["symmetry_lost"] == ""


def test_a_wall_whose_strengths_scatter_decides_by_itself():
    strengths = {"scatter.unit_unit.tensile_strength": 0.3, "scatter.unit_unit.cohesion": 0.3}
    assert run(**strengths).summary["symmetry_lost"] == ""


def test_a_wall_that_is_not_symmetric_has_none_to_lose():
    result = run()
    joints = result.joints
    shifted = np.where(np.arange(len(joints.point)) == 0, 1e-3, 0.0)[:, None] * (1.0, 0.0, 0.0)
    assert symmetry_lost(joints, result.history.frames) == "x"
    assert symmetry_lost(replace(joints, point=joints.point + shifted), result.history.frames) == ""
