"""The independent integration of a rocking block against closed forms."""

import numpy as np
import pytest

from verification.references.rocking import RockingBlock, rock
from verification.scene_runs import result_of
from verification.studies import rocking_statistics
from verification.studies.rocking_statistics import Peaks

SLENDER = RockingBlock(0.125, 0.5, 0.91176)
SMALL = rocking_statistics.BLOCKS[0]
AWAY = np.linspace(0.0, 1.0, 101), np.zeros(101)


def test_a_block_that_is_let_go_comes_down_at_the_times_of_the_closed_form():
    motion = rock(SLENDER, *AWAY, until=1.6, angle=0.5 * SLENDER.alpha)
    assert motion.impacts[:3] == pytest.approx([0.34917, 0.91745, 1.39964], abs=2e-5)
    assert SLENDER.of_housner == pytest.approx(0.91176, abs=1e-5)
    assert not motion.overturned and motion.peak == pytest.approx(0.5 * SLENDER.alpha)


def test_no_energy_is_lost_between_impacts_and_the_share_of_the_spin_at_each():
    block = RockingBlock(0.125, 0.5, 0.8)
    motion = rock(block, *AWAY, until=6.0, angle=0.5 * block.alpha)
    tops = [np.abs(motion.angle[(motion.time >= a) & (motion.time <= b)]).max()
            for a, b in zip(motion.impacts[:4], motion.impacts[1:5], strict=True)]  # fmt: skip
    heights = np.cos(block.alpha - np.array([0.5 * block.alpha, *tops])) - np.cos(block.alpha)
    assert heights[1:] / heights[:-1] == pytest.approx(0.64, rel=2e-3)


@pytest.mark.parametrize(("q", "threshold"), [(1.0, 1.3213), (2.0, 1.8015), (3.0, 2.2974)])
def test_a_half_sine_pulse_overturns_from_its_threshold_on(q, threshold):
    """alpha 0.25, p 2.14; thresholds in g tan(alpha), without an impact before."""
    block = RockingBlock(0.5 * 0.79495, 0.5 * 3.11327, 0.9)
    assert (block.alpha, block.p) == pytest.approx((0.25, 2.14), abs=2e-4)
    length = np.pi / (q * block.p)
    time = np.linspace(0.0, length, 401)

    def falls(size):
        pulse = size * block.g * np.tan(block.alpha) * np.sin(np.pi * time / length)
        return rock(block, time, pulse, until=12.0 / block.p, tolerance=1e-7).overturned

    low, high = 0.98 * threshold, 1.02 * threshold
    assert not falls(low) and falls(high)
    for _ in range(7):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if falls(middle) else (middle, high)
    assert high == pytest.approx(threshold, rel=5e-4)


def test_a_block_that_is_shaken_less_than_its_slenderness_stays():
    time = np.linspace(0.0, 2.0, 401)
    shaking = 0.999 * 9.81 * 0.25 * np.sin(2.0 * np.pi * time)
    motion = rock(SLENDER, time, shaking, until=3.0)
    assert motion.peak == 0.0 and not len(motion.impacts)


def test_a_mirrored_record_mirrors_the_motion_and_a_tighter_tolerance_changes_nothing():
    rng = np.random.default_rng(2)
    time = np.linspace(0.0, 3.0, 301)
    shaking = 4.0 * np.sin(2.0 * np.pi * 1.5 * time) * np.sin(np.pi * time / 3.0) + rng.normal(size=301)
    first, mirrored = rock(SLENDER, time, shaking, 4.0), rock(SLENDER, time, -shaking, 4.0)
    tight = rock(SLENDER, time, shaking, 4.0, tolerance=1e-10)
    assert len(first.impacts) > 3 and first.peak > 0.01
    assert mirrored.angle == pytest.approx(-first.angle)
    assert tight.impacts[:4] == pytest.approx(first.impacts[:4], abs=1e-5)
    assert tight.peak == pytest.approx(first.peak, rel=1e-4)


def test_a_run_on_a_pulse_follows_the_integration():
    """One cycle of a sine, 0.3 g and 0.5 s: the block lifts off, leans, comes back and rocks out."""
    restitution = rocking_statistics.measured_restitution(SMALL)
    assert restitution == pytest.approx(SLENDER.of_housner, abs=0.005)
    keys = {"x": "0.3 g * sin(2 pi t / 0.5 s)", "duration": "0.5 s", "begin": "0.2 s"}
    settings = rocking_statistics.settings_of(SMALL) | {"ground": keys, "solver.duration": "2.2 s"}
    rows = result_of(rocking_statistics.SCENE, settings).history.rows
    time = np.linspace(0.0, 0.5, 201)
    shaking = 0.3 * 9.80665 * np.sin(2.0 * np.pi * time / 0.5)
    motion = rock(RockingBlock(0.125, 0.5, restitution), time, shaking, until=2.0)
    lean = np.sin(SLENDER.alpha) - np.abs(rows["sway"]) / np.hypot(0.125, 0.5)
    angle = np.sign(rows["sway"]) * (SLENDER.alpha - np.arcsin(lean))
    integrated = np.interp(rows["time"] - 0.2, motion.time, motion.angle)
    assert motion.peak > 0.1 * SLENDER.alpha and len(motion.impacts) >= 2
    assert angle == pytest.approx(integrated, abs=0.03 * motion.peak)


def test_statistics_of_trials_by_hand():
    both = [(0.1, 0.11), (0.3, 0.3), (np.inf, 0.9), (np.inf, np.inf), (1e-5, 2e-4)]
    peaks = [Peaks(run, (integrated, 0.9 * integrated, 1.1 * integrated)) for run, integrated in both]
    statistics = rocking_statistics.statistics_of(peaks)
    assert statistics.fell == (2, 1, 1, 1) and statistics.medians == (0.3, 0.3, 0.9 * 0.3, 1.1 * 0.3)
    assert statistics.median_off == 0.0 and statistics._replace(
        medians=(0.2, 0.3, 0.25, 0.4)
    ).median_off == pytest.approx(0.2)
    assert statistics.more_fell == 1 and statistics._replace(fell=(3, 1, 2, 5)).more_fell == 0
    assert statistics._replace(fell=(3, 5, 4)).more_fell == 1
    assert statistics.distance == pytest.approx(0.2) and statistics.holds(5)
    assert not rocking_statistics.statistics_of(8 * peaks).holds(40)


@pytest.mark.slow
def test_blocks_on_made_motions_fall_as_often_as_the_equation_says():
    chapter = rocking_statistics.chapter(lambda _: None, quick=True)
    assert [verdict.kind for verdict in chapter.verdicts] == ["ok"]
