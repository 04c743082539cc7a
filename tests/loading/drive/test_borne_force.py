"""What of the force of a drive is borne at rest, by hand: inertia along what a unit of the drive moves, by block."""

import numpy as np
import pytest

from geometry.polyhedra.measures import widths
from masonry.assembly.assemble import assemble
from masonry.configuration.energy import velocities
from masonry.loading.drive.adaptive import AdaptiveLoading, Controlled
from masonry.loading.drive.borne import AT_REST, BALANCED, MORE, BorneForce
from masonry.loading.programs import rise
from masonry.rows.columns import EXCESS
from masonry.rows.peak import borne, peak_row
from masonry.runtime.state_file import read, write
from masonry.scene import load

ACCURACY = 0.02
TOLERANCE = BALANCED * ACCURACY


def followed(towards: float = 1.0, highest: float = 900.0, slope: float = 0.0, of: str = "couplet") -> BorneForce:
    """At 2 mm, where so many N were borne, in balance."""
    force = BorneForce(assemble(load(of)).model, ACCURACY, towards)
    force.place, force.borne, force.highest, force.last, force.slope = towards * 2e-3, 900.0, highest, 900.0, slope
    return force


def counted(force: BorneForce, steps: list[float], excess: float = 0.0, **state) -> np.ndarray:
    """What counts of forces (N, along the drive) at steps of 0.1 mm."""
    force.balanced, force.excess = excess == 0.0, force.towards * excess
    for name, value in state.items():
        setattr(force, name, value)
    path = force.place + force.towards * 1e-4 * np.arange(1, len(steps) + 1)
    return force.towards * force.count(path, force.towards * np.array(steps))


@pytest.mark.parametrize("towards", [1.0, -1.0])
def test_inertia_counts_along_the_move_of_a_unit_of_the_drive_force_by_way_and_moment_by_turn(towards):
    force = followed(towards)
    model, rigid, speed = force.model, force.model.bodies.rigid, 0.02
    before, free = velocities(model), rigid.dt_over_mass > 0.0
    row = int(np.flatnonzero(free.any(axis=1))[0])
    gained = np.where(free, np.array([0.3, -0.2, 0.5, 0.7, -0.4, 0.9]), 0.0)[row]
    expected = np.where(free[row], [0.5, 0.1, 0.25, -2.0, 3.0, 1.0], 0.0)
    rigid.guess[row], rigid.hold[row] = expected, np.where(free[row], 3.0, rigid.hold[row])
    rigid.v[row] += gained
    taken = model.masses["rigid"][row] * gained / model.dt - 3.0 * free[row]
    either = float(taken @ expected), float(taken @ rigid.v[row]) / (towards * speed)
    most = 1e3 * max(map(abs, either))
    force.feel(before, towards * speed, towards * most, 0.0)
    assert force.most_off == pytest.approx(max(map(abs, either)))
    assert force.excess == 0.0 and force.balanced, "a thousandth, at an accuracy of 2 %"
    force.feel(before, towards * speed, towards * most / 500.0, 0.0)
    assert not force.balanced
    assert force.excess == pytest.approx(towards * max(MORE * max(towards * one for one in either), 0.0))


def test_a_crack_counts_with_all_that_was_reached_before_it():
    """100 N a step, as before; then it falls to 700 N, and swings."""
    steps = [1000.0, 1100.0, 1200.0, 400.0, 700.0]
    np.testing.assert_array_equal(counted(followed(slope=1e6), steps, excess=30.0), steps)


def test_a_jerk_that_swings_out_counts_with_what_is_borne_at_its_end():
    """Of 1060 N at the end 100 N are not borne."""
    steps = [1000.0, 1100.0, 1200.0, 1100.0, 1060.0]
    wanted = np.minimum(steps, 960.0)
    force = followed(slope=1e6)
    np.testing.assert_array_equal(counted(force, steps, excess=100.0), wanted)
    assert (force.borne, force.highest, force.slope) == (960.0, 960.0, 0.0)


def test_what_is_above_by_less_than_a_quarter_of_the_accuracy_counts_as_it_is():
    steps = [900.0, 1000.0 * (1.0 + 0.99 * TOLERANCE), 1000.0 * (1.0 + 1.01 * TOLERANCE), 1000.0]
    np.testing.assert_array_equal(counted(followed(), steps), [*steps[:2], 1000.0, 1000.0])


def test_a_slope_is_known_between_two_looks_in_balance_and_nowhere_else():
    force = followed()
    counted(force, [950.0, 1000.0])
    assert force.slope == pytest.approx(100.0 / 2e-4)
    counted(force, [1000.0, 1100.0], excess=50.0)
    assert force.slope == 0.0
    counted(force, [1100.0, 1200.0], steady=False)
    assert force.slope == 0.0


def test_while_a_specimen_moves_by_itself_no_force_is_a_new_peak():
    force = followed(highest=950.0)
    np.testing.assert_array_equal(counted(force, [940.0, 1200.0], excess=10.0, follows=False), [940.0, 950.0])
    assert force.excess == 250.0


def test_while_a_specimen_moves_by_itself_no_force_is_a_new_peak_the_other_way_either():
    force = followed()
    force.lowest = -700.0
    counted(force, [-500.0, -800.0], follows=False)
    assert (force.excess, force.borne, force.lowest) == (-100.0, -700.0, -700.0)
    counted(force, [-600.0, -800.0], follows=True)
    assert (force.excess, force.lowest) == (0.0, -800.0), "it follows the drive"


@pytest.mark.parametrize("towards", [1.0, -1.0])
@pytest.mark.parametrize(("share", "follows"), [(0.99, True), (1.01, False)])
def test_what_damping_holds_up_as_it_hardly_moves_counts_in_full_and_by_moment_over_half_the_least_width(
    towards, share, follows
):
    """Half the kinetic energy was not expected, and neither way of moving shows what is left."""
    force = followed(towards, of="column-pushed")
    model, rigid, speed = force.model, force.model.bodies.rigid, 0.02 * towards
    row = int(np.flatnonzero((rigid.dt_over_mass > 0.0).all(axis=1))[0])
    masses = model.masses["rigid"][row]
    rigid.guess[...], rigid.v[...], rigid.hold[...] = 0.0, 0.0, 0.0
    rigid.guess[row, 1] = 1.0
    rigid.v[row, :3] = speed * np.array([1.0, 1.0, 0.0])  # across it as well, as much
    before = velocities(model)
    left = np.array([0.0, 0.0, 30.0, -20.0, 10.0, 40.0])
    rigid.hold[row] = -left
    arm = 0.5 * widths(model.blocks)[model.layout.members["rigid"][row]]
    most = 0.5 * (30.0 + 70.0 / arm) / TOLERANCE
    force.feel(before, speed, towards * most / share, 0.0)
    assert masses[0] == pytest.approx(masses[1]) and force.balanced and force.most_off < 1e-9 * most
    assert force.follows == follows


@pytest.mark.parametrize(("share", "counts"), [(0.9, True), (1.1, False)])
def test_where_the_drive_is_held_a_force_counts_once_the_specimen_is_at_rest(share, counts):
    force = followed(highest=900.0)
    force.last = 1000.0 * (1.0 + share * AT_REST * TOLERANCE)
    force.balanced, force.paused = True, True
    assert float(force.count(np.array([2e-3]), np.array([1000.0]))[0]) == (1000.0 if counts else 900.0)
    assert force.borne == (1000.0 if counts else 900.0), "it goes on from what was borne"


def test_a_drive_looks_more_closely_where_the_force_may_become_the_largest():
    force = followed(highest=1000.1)
    assert not force.may_be_highest
    force.highest = 999.9
    assert force.may_be_highest


def test_the_peak_of_rows_is_that_of_what_is_borne():
    """150 of 200 N in the second row, and half of the third, pulled."""
    rows = {
        "displacement": np.arange(4.0),
        "stress": np.array([0.0, 2.0, -4.0, 1.8]),
        "force": np.array([0.0, 200.0, -400.0, 180.0]),
        EXCESS: np.array([0.0, 50.0, 200.0, 0.0]),
    }
    np.testing.assert_allclose(borne(rows, "stress"), [0.0, 1.5, -2.0, 1.8])
    np.testing.assert_allclose(borne(rows, "force"), [0.0, 150.0, -200.0, 180.0])
    assert peak_row(rows) == 3
    del rows[EXCESS]
    assert peak_row(rows) == 1


def test_a_drive_goes_on_within_an_increment_from_a_file(tmp_path):
    """Three of four pieces are left, and what is borne is known."""
    model = assemble(load("couplet")).model
    one, other = (AdaptiveLoading(model, Controlled(rise(10, 10), 1.0, 0.01), 100) for _ in range(2))
    one.speed.pending, one.increments.borne.highest = np.linspace(1.0, 2.0, 81), 123.0
    np.testing.assert_array_equal(one.speed.piece(4), np.linspace(1.0, 2.0, 81)[:21])
    write(tmp_path / "state.npz", one.state())
    other.restore(read(tmp_path / "state.npz"))
    assert other.increments.borne.state() == one.increments.borne.state() and other.speed.arrives_at == 1.25
    for last in (1.5, 1.75, 2.0):
        for drive in (one, other):
            assert drive.speed.piece(4)[-1] == pytest.approx(last) and drive.speed.arrives_at == pytest.approx(last)
    assert not len(one.speed.pending) and not len(other.speed.pending)
