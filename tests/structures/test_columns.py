"""A column turns over the edge of a drum: by hand, by limit analysis, and in a simulation."""

import numpy as np
import pytest

import masonry
from geometry.blocks import Specimen
from geometry.polyhedra.measures import bounds, centroids, volumes


def by_hand(specimen: Specimen, push: float | None) -> float:
    """N at a height `push` (m) that turn what stands on some joint over its edge, the least of all joints; without a
    height the share of the weight sideways that does."""
    weight, middle = 2500 * 9.81 * volumes(specimen.blocks), centroids(specimen.blocks)[:, 2]
    low, high = bounds(specimen.blocks)
    areas = []
    for k in specimen.sets["drums"]:
        above = np.arange(k, specimen.sets["units"][-1] + 1)
        edge = half_width(specimen, float(low[k, 2]))
        sideways = weight[above] @ (middle[above] - low[k, 2])
        areas.append(edge * weight[above].sum() / (sideways if push is None else push - low[k, 2]))
    return float(min(areas))


def half_width(specimen: Specimen, level: float) -> float:
    """m, from the axis to the edge of the drum that stands at this level."""
    points = specimen.blocks.points
    drums = points[np.abs(points[:, 2] - level) < 1e-9]
    across = drums[np.hypot(drums[:, 0], drums[:, 1]) < 0.3 + 1e-9]
    return float(across[:, 0].max())


HEAD = 3.6 + 0.175
"""m, the middle of the capital of the packaged column."""
TILT = {"drive": None, "limit": {"pattern": "tilt", "about": "y"}}


def test_a_push_at_its_head_turns_it_over_the_edge_of_a_joint():
    limit = masonry.limit("column-pushed")
    assert limit.factor == pytest.approx(by_hand(limit.specimen, HEAD), rel=1e-6)


def test_a_straight_column_falls_sideways_at_half_its_width_over_half_its_height():
    straight = masonry.load("column-pushed", {**TILT, "specimen.top_diameter": None, "specimen.capital": None})
    assert masonry.limit(straight).factor == pytest.approx(0.3 * np.cos(np.pi / 24) / 1.8, rel=1e-6)
    tapered = masonry.limit(masonry.load("column-pushed", TILT))
    assert tapered.factor == pytest.approx(by_hand(tapered.specimen, None), rel=1e-6)


def test_a_simulation_turns_it_over_at_the_same_push():
    result = masonry.run("column-pushed")
    assert result.summary["peak_force_n"] == pytest.approx(by_hand(result.specimen, HEAD), rel=0.01)
