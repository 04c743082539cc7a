"""Blocks of which each overhangs the one below: it stands below the harmonic overhang, and falls above."""

import pytest

from masonry.laboratory import laboratory
from tests.large.made import dry
from tests.scenes import box

LONG, HIGH, COUNT = 0.2, 0.06, 4


def stack(share: float):
    """Block i from the top overhangs the one below by a share of LONG / (2 i); the lowest one the slab."""
    boxes, right = [box("slab", (-1.0, -0.5, -0.1), (1.0, 1.0, 0.1), "units", 0)], 0.0
    for level, i in enumerate(range(COUNT, 0, -1)):
        right += share * LONG / (2 * i)
        boxes.append(box(f"block {i}", (right - LONG, -0.05, level * HIGH), (LONG, 0.1, HIGH), "units", level + 1))
    return laboratory.run(dry(boxes, 0.7, settle=4000, duration=0.8))


def test_it_stands_just_below_the_harmonic_overhang():
    result = stack(0.995)
    assert result.summary["collapse"] is None
    assert result.summary["rotation_max_rad"] < 1e-3
    assert result.history.rows["kinetic"][-1] < 1e-12 * abs(result.history.rows["external_work"]).max()
    assert result.summary["energy_imbalance"] < 1e-12


def test_it_falls_just_above_and_the_summary_says_which_block_went_first_and_when():
    result = stack(1.005)
    fallen, rows = result.summary["collapse"], result.history.rows
    assert fallen is not None
    assert "block 1" in fallen["sets"], "the whole stack turns about the edge of the slab; its top goes down most"
    assert fallen["at_m"][2] == pytest.approx((COUNT - 0.5) * HIGH)
    began = fallen["began"]
    assert 0.0 < began["time_s"] < fallen["time_s"] < rows["time"][-1]
    kinetic = dict(zip(rows["step"], rows["kinetic"], strict=True))
    assert kinetic[began["step"]] < 1e-4 * kinetic[fallen["step"]]
    assert result.summary["energy_imbalance"] < 1e-12
