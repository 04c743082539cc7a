"""The points that stand for patches in the place of a dry joint are those that detection gives a closed patch."""

from types import SimpleNamespace

import numpy as np
import pytest

from geometry.joints.faces.second_moments import of_polygons
from masonry.detection.spread import rounds_of, spread, spread_in_rounds
from masonry.estimates.bearing_points import SPREAD, patch_points

CORNERS = np.array([[0.1, 0.2, 0.0], [0.8, 0.4, 0.0], [0.7, 0.75, 0.0], [0.0, 0.55, 0.0]])
"""Of a parallelogram, askew."""


@pytest.mark.parametrize("along", [2, 4, 10, "spread"])
def test_points_of_a_patch_lie_where_detection_puts_them(along):
    rounds = SPREAD if along == "spread" else rounds_of(along)
    middle, normal = CORNERS.mean(axis=0), np.array([0.0, 0.0, 1.0])
    faces = SimpleNamespace(polygons=[[CORNERS]], normal=normal[None])
    point, area = patch_points(faces, 0, rounds)
    room = 4 * len(rounds)
    own, gap, feature, part = np.zeros((room, 3)), np.zeros(room), np.zeros(room, dtype=np.int64), np.zeros(room)
    own[:4], part[:4], feature[:4] = CORNERS, area.reshape(-1, 4).sum(axis=0).mean(), np.arange(4)
    if along == "spread":
        assert spread(own, gap, part, feature, 4) == room
    elif along > 2:
        assert spread_in_rounds(own, gap, part, feature, 4, rounds) == room
    order, others = (np.lexsort(np.round(p, 9).T) for p in (point, own))
    assert point[order] == pytest.approx(own[others]) and area[order] == pytest.approx(part[others])
    polar = np.trace(of_polygons(CORNERS[None], normal[None], middle[None])[0])
    assert along == 2 or area @ ((point - middle) ** 2).sum(axis=1) == pytest.approx(polar)
