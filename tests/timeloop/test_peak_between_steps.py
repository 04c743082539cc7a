"""A drive in few steps passes its peak between two of them, and the run says by how much more there may have been."""

import numpy as np
import pytest

from masonry.timeloop.around_peak import THROUGH, AroundPeak, missed_between_rows
from verification.scene_runs import result_of

STRENGTH = 0.87e6 + 1.01 * 0.5e6
"""Pa, of the packaged couplet: cohesion and friction at 0.5 MPa."""


@pytest.mark.parametrize("law", ["linear", "exponential", "brittle"])
@pytest.mark.parametrize("steps", [30, 60, 100, 300, 1000])
def test_what_a_couplet_bears_beyond_the_highest_step_is_told(law, steps):
    result = result_of("couplet", {"law": law, "drive.accuracy": None, "drive.steps": steps})
    missed, lacks = result.summary["missed_between_steps"], STRENGTH / result.summary["peak_stress_pa"] - 1.0
    assert lacks <= missed + 1e-3, "the force of a step is that of the slip half a step before, but for rounding"
    assert ("peak_between_steps" in [doubt.name for doubt in result.doubts]) == (missed > 0.01)


@pytest.mark.parametrize("steps", [150, 500, 2000])
def test_what_a_drive_that_turns_back_misses_between_two_rows_is_told(steps):
    there_and_back = {"law": "brittle", "drive.accuracy": None, "drive.steps": steps}
    history = {"drive.displacement": None, "drive.history": ["0.1 mm", "-0.1 mm"]}
    result = result_of("couplet", there_and_back | history)
    missed, lacks = result.summary["missed_between_steps"], STRENGTH / result.summary["peak_stress_pa"] - 1.0
    assert lacks <= missed + 1e-3 and missed > 0.005


def test_nothing_is_missed_where_a_drive_turns():
    place, force = np.array([0.0, 1.0, 2.0, 1.0, 0.0]), np.array([0.0, 4.0, 8.0, 4.0, 0.0])
    assert missed_between_rows(place, force, 2) == 0.0
    assert missed_between_rows(np.arange(5.0), force, 2) > 0.2


@pytest.mark.parametrize("place", np.linspace(0.0, 1.0, 7))
@pytest.mark.parametrize("cuts", [(3,), (6,), (7,), (8,), (5, 6, 7, 8, 9)])
def test_two_straight_lines_pass_no_higher_than_is_told_wherever_chunks_end(place, cuts):
    rise, fall, peak = 2.0, 5.0, 6.0 + place
    at = np.arange(15.0)
    force = 100.0 - np.where(at < peak, rise * (peak - at), fall * (at - peak))
    around, highest = AroundPeak(), 0.0
    for places, piece in zip(np.split(1e-6 * at, cuts), np.split(force, cuts), strict=True):
        k = int(np.argmax(piece))
        around.see(places, piece, k if piece[k] > highest else None)
        highest = max(highest, float(piece[k]))
    assert around.missed() == pytest.approx(rise * fall / (rise + fall) / force.max())
    assert 100.0 / force.max() - 1.0 <= around.missed() * (1.0 + 1e-12)


def test_a_brittle_force_misses_what_it_rises_by_in_the_shorter_step_that_tears_it():
    around = AroundPeak()
    around.see(np.array([0.0, 2.0, 4.0, 4.5, 5.0]), np.array([0.0, 2.0, 4.0, 0.0, 0.0]), 2)
    assert around.missed() == pytest.approx(0.5 * 8.0 / 9.0 / 4.0)


def test_a_fall_in_the_last_step_is_enough():
    around = AroundPeak()
    around.see(np.arange(4.0), np.array([0.0, 4.0, 8.0, 2.0]), 2)
    assert around.missed() == pytest.approx(4.0 * 6.0 / 10.0 / 8.0)


def test_a_plateau_and_a_force_that_still_rises_miss_nothing():
    for force in (np.minimum(np.arange(12.0), 7.5), np.arange(12.0)):
        around = AroundPeak()
        around.see(np.arange(12.0), force, int(np.argmax(force)))
        assert around.missed() == 0.0


@pytest.mark.parametrize("cuts", [[], [14], [12, 16]])
@pytest.mark.parametrize(("share", "struck"), [(0.99, True), (1.01, False)])
def test_a_force_that_was_there_for_less_than_a_ten_thousandth_of_the_way_is_a_blow(cuts, share, struck):
    """8 N are borne at 1 mm; at 100 mm, from nothing, 9 N."""
    rises = 0.1 - share * THROUGH * 0.1
    place = np.concatenate([np.linspace(1e-4, 1e-3, 10), [0.01, 0.05, rises, 0.5 * (rises + 0.1), 0.1, 0.1001, 0.2]])
    force = np.concatenate([np.linspace(0.8, 8.0, 10), [5.0, 0.0, 3.9, 6.0, 9.0, 0.0, 1.0]])
    around, highest, blows = AroundPeak(), 0.0, []
    for places, piece in zip(np.split(place, cuts), np.split(force, cuts), strict=True):
        k = int(np.argmax(piece))
        if around.strikes(places, piece, k, highest):
            blows.append(float(piece[k]))
        else:
            highest = max(highest, float(piece[k]))
    if cuts:
        assert (highest, blows) == ((8.0, [9.0]) if struck else (9.0, []))
        assert around.through == pytest.approx(1.0 if struck else share * THROUGH, rel=1e-9)
    else:
        assert (highest, blows) == (9.0, []), "the first peak of all is none"


def test_no_force_that_is_borne_from_the_first_step_on_is_a_blow():
    around = AroundPeak()
    assert not around.strikes(np.array([0.0]), np.array([100.0]), 0, 0.0) and around.through == 1.0
    assert not around.strikes(1e-9 * np.arange(1.0, 4.0), 1e9 * np.arange(1.0, 4.0), 2, 100.0)
