"""Where the points of a patch lie: what a closed joint bends by, and when the trust says that corners alone decide."""

import pytest

from masonry.laboratory import laboratory
from masonry.results.trust import trust
from tests.large.made import DENSITY, dry, leaning, slab
from tests.scenes import box

WORD = "three times as stiff"


def leant(points: str, slope: float = 2.0, friction: float = 2.0) -> dict:
    """The summary of a block of 0.1 x 0.2 x 0.2 m that rests on a slope (deg), or slides on it."""
    boxes = [slab(), box("block", (-0.05, -0.1, 0.0), (0.1, 0.2, 0.2), "units", 1)]
    given = f'patch_points = "{points}"' if points else ""
    return laboratory.run(dry(boxes, friction, leaning(slope), 0.01, given, "", settle=40000)).summary


@pytest.mark.parametrize(("points", "stiffer"), [("", 3.0), ("corners", 3.0), ("spread", 1.0)])
def test_a_closed_joint_bends_as_its_pressure_does_only_with_points_inside(points, stiffer):
    """The moment of the weight about the middle of the face, over k_n times its second moment of area."""
    across, _, up = leaning(2.0)
    mass = DENSITY * 0.1 * 0.2 * 0.2
    summary = leant(points)
    tilt = mass * across * 0.1 / (stiffer * 1e10 * 0.2 * 0.1**3 / 12.0 + mass * up * 0.1)
    assert summary["rotation_max_rad"] == pytest.approx(tilt, rel=1e-3)
    assert (WORD in trust(summary)) == (points == "")


def test_a_block_that_topples_is_not_judged_by_its_closed_joint():
    assert WORD not in trust(leant("", slope=35.0))
