"""The pace of a drive to an accuracy by hand: what is twice a bound on increments halves the speed."""

from dataclasses import replace

import numpy as np
import pytest

from masonry.assembly.assemble import assemble
from masonry.loading.drive.adaptive import AdaptiveLoading, Controlled
from masonry.loading.drive.adaptive_settings import SETTINGS
from masonry.loading.drive.increments import DriveRow
from masonry.loading.drive.utilisation import Dry
from masonry.loading.programs import rise
from masonry.monitors.events import Event, SuddenCracks, table
from masonry.rows.cycles import bounds
from masonry.rows.peak import at_peak, peak_row
from masonry.scene import load

STORED, FORCE, MADE = 50.0, 2000.0, 1e-3


def paced(accuracy: float = 0.01) -> AdaptiveLoading:
    """A drive behind an increment of 1 mm, at 2 kN; 50 J are stored, and so much work was done."""
    pace = AdaptiveLoading(assemble(load("couplet")).model, Controlled(rise(10, 10), 1.0, accuracy), 100)
    last = pace.increments
    last.stored = last.most_stored = last.work = STORED
    last.most_force, last.made = FORCE, MADE
    return pace


def factor(pace, stored=STORED, broken=0.0, support=FORCE, expected=0.0, kinetic=0.0, damped=0.0) -> float:
    row = DriveRow(FORCE, support, None, stored, broken, kinetic, damped)
    return pace.bounds.factor(row, pace.increments, expected, damped, takes_few_steps=False)


BOUNDS = {
    "change of the stored energy, 20 accuracies, by its root": {"stored": STORED * (1.0 - 4.0 * 0.2)},
    "energy of fracture, 5 accuracies, by its root": {"broken": STORED * 4.0 * 0.05},
    "root of kinetic over stored energy, 7 accuracies": {"kinetic": STORED * (2.0 * 0.07) ** 2},
    "difference of the ends, 0.4 accuracies": {"support": FORCE * (1.0 - 2.0 * 0.004)},
    "what damping took of the increment, half an accuracy": {"damped": 2.0 * 0.005 * FORCE * MADE},
}


@pytest.mark.parametrize("bound", BOUNDS)
def test_what_is_twice_its_bound_halves_the_speed(bound):
    assert factor(paced(), **BOUNDS[bound]) == pytest.approx(0.5)


def test_what_runs_ahead_by_twice_the_accuracy_halves_the_speed():
    """2 root(K W) over the work: K = (0.01)^2 W."""
    assert factor(paced(), expected=1e-4 * STORED) == pytest.approx(0.5)


def test_the_speed_changes_by_no_more_than_it_may():
    assert factor(paced()) == 1.3
    assert factor(paced(), support=0.0) == 0.2


def test_a_sudden_crack_is_no_drag_and_drag_at_the_peak_is_that_of_the_force_that_is_highest():
    """Of 6 J that damping took 4 J had been stored, and none of them broke anything."""
    pace = paced()
    factor(pace, stored=STORED - 4.0, damped=6.0)
    assert pace.bounds.looks[-1] == (pytest.approx(0.0), MADE, pytest.approx(2.0 / (FORCE * MADE)), FORCE)
    pace.bounds.looks = [
        (0.01, 1.0, 0.5, 10.0),
        (0.03, 3.0, 0.02, 30.0),
        (0.0, 4.0, 0.03, 40.0),
        (0.02, 2.0, 0.9, 20.0),
    ]
    outcome = pace.outcome(40.0)
    assert outcome.mean_lag == pytest.approx((0.01 + 0.09 + 0.04) / 10.0)
    assert outcome.largest_lag == 0.03 and outcome.drag_at_peak == 0.03
    pace.increments.settled_force = 40.0
    assert pace.outcome(40.0).drag_at_peak == 0.0, "the force was as high before the drive"
    pace.increments.settled_force = -60.0
    assert pace.outcome(40.0).drag_at_peak == 0.03, "the drive held the specimen back before"


def test_where_contacts_are_dry_what_was_not_borne_in_three_steady_rows_on_end_is_drag_as_well():
    """Pushed back: 38 N were borne; 40 N in a swing, 39 N between two rows that were not expected, 50 N in a fall."""
    dry = Dry(paced().model, SETTINGS, 0.01)
    assert (dry.excess(0.0), dry.excess(-40.0)) == (0.0, 1.0), "nothing moved, nothing was borne"
    for force in (38.0, 38.5, 38.1, 37.0, 40.0, 37.5):
        dry.see(-force, 1.0)
    for force, trust in ((39.0, 0.9), (39.0, 1.0), (39.0, 0.9), (50.0, 1.0), (50.0, 1.0), (50.0, 1.0)):
        dry.see(-force, trust)
    assert dry.excess(-40.0) == pytest.approx(1.0 - 38.0 / 40.0)
    again = Dry(paced().model, SETTINGS, 0.01)
    again.restore(dry.state())
    assert again.excess(-40.0) == dry.excess(-40.0)
    for _ in range(10):
        dry.see(-39.0, 0.1)
    assert dry.excess(-40.0) == pytest.approx(1.0 - 39.0 / 40.0), "a block that slides: nothing of it is expected"
    assert dry.excess(-50.0 * (1.0 - 1e-15)) == 0.0, "a plateau, but for rounding"


def test_what_dry_faces_may_part_by_and_how_the_force_may_rise_go_with_the_accuracy():
    coarse, fine = (Dry(paced().model, SETTINGS, accuracy) for accuracy in (0.1, 0.01))
    coarse.parting = fine.parting = 1e-6
    assert coarse.shortest(0.0) == 1e-6 and fine.shortest(0.0) == pytest.approx(0.2e-6)
    assert coarse.shortest(0.1) == 1e-4 and fine.shortest(0.1) == pytest.approx(0.2e-4)
    assert coarse.factor(0.05, 0.025) == pytest.approx(0.5) and fine.factor(0.005, 0.01) == pytest.approx(0.5)


def test_an_increment_makes_four_tenths_of_the_way_that_is_left_to_the_first_damage():
    """Used by 0.5, after 0.3 before this millimetre: 2.5 mm are left; at the present speed an increment is 1 mm."""
    pace = paced()
    pace.approach.used, pace.increments.count = 0.3, 9
    pace.speed.target = MADE / pace.speed.duration
    assert pace.towards_damage(0.5) == pytest.approx(0.4 * 2.5) and pace.approach.used == 0.5
    assert pace.towards_damage(0.501) == 2.0, "no more than twice as fast"
    assert pace.towards_damage(0.999) == pytest.approx(0.1), "no less than a tenth"


def test_a_looser_accuracy_is_aimed_at_less_than_in_proportion_and_deforming_units_at_half():
    assert paced(0.01).bounds.unit == pytest.approx(0.01) and paced(0.001).bounds.unit == pytest.approx(0.001)
    assert paced(0.05).bounds.unit == pytest.approx(0.01 * 5.0**0.4)
    built = assemble(load("couplet", {"kinematics": "affine"}))
    assert AdaptiveLoading(built.model, Controlled(rise(10, 10), 1.0, 0.01), 100).bounds.unit == pytest.approx(0.005)


def test_a_sudden_crack_is_what_damping_took_since_all_was_calm_and_the_contact_that_broke_most():
    model = assemble(load("couplet")).model
    cracks, body, area = SuddenCracks(model), model.bodies.rigid, model.joints.area
    body.work[:, 1] = -1.0, -2.0
    cracks.calm(10)
    body.work[1, 1], model.state.dissipated[2, 1] = -2.5, 4.0 / area[2]
    cracks.sudden(20)
    body.work[1, 1], model.state.dissipated[3, 0] = -3.5, 9.0 / area[3]
    cracks.sudden(30)
    assert cracks.events == [Event(10, 30, pytest.approx(1.5), 3)], "what goes on is one with what came before"
    cracks.calm(40)
    body.work[1, 1] = -4.0
    cracks.sudden(50)
    assert cracks.events[1] == Event(40, 50, pytest.approx(0.5), -1)
    rows = {"step": np.array([0.0, 25.0, 50.0]), "displacement": np.array([0.0, 1e-3, 2e-3])}
    entries = table(model, cracks.events, rows, 0.6)
    assert [(one["first_step"], one["last_step"], one["displacement_m"]) for one in entries] == [(10, 30, 2e-3)]
    assert "between" in entries[0]["place"] or entries[0]["place"] == model.contact(3)


def test_readings_at_the_peak_lie_between_its_rows_and_on_a_plateau_the_first_row_counts():
    rows = {"displacement": np.array([0.0, 0.0, 1.0, 2.0, 3.0]), "stress": np.array([9.0, 0.0, 5.0, 6.0, 6.003])}
    assert at_peak(rows, np.array([0.0, 0.0, 10.0, 20.0, 30.0]), 2.25) == pytest.approx(22.5)
    assert peak_row(rows) == 3, "within a thousandth; what was before the drive is no peak"
    back = rows | {"displacement": np.array([0.0, 0.0, 1.0, 2.0, 1.0])}
    assert at_peak(back, np.array([0.0, 0.0, 10.0, 20.0, 30.0]), 1.5) == 30.0, "the highest row"
    assert bounds(np.array([0.0, 1.0, -1.0, 1.0])) == pytest.approx([0.0, 2.5, 3.0])


def test_rows_of_the_settling_are_fewer_and_a_paced_drive_takes_each_increment_as_a_row():
    pace = paced()
    chunk = replace(pace.increment(np.linspace(0.0, 1.0, 81)), row=True)
    assert chunk.steps == 80 and chunk.row
    assert pace.increments.made == pytest.approx(np.linspace(0.0, 1.0, 81)[:-1].sum() * pace.model.dt)
    assert (pace.speed.now, pace.increments.count) == (1.0, 1)
    assert pace.path.moved == pytest.approx(pace.increments.made)
