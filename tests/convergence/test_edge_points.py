"""What points from edge to edge of a joint that turns about its edge have not seen."""

import numpy as np
import pytest
from scipy.optimize import brentq

from geometry.joints.point_density import edge_rule
from masonry.sweeps.convergence.refinement.answers import Answer, Value
from masonry.sweeps.convergence.refinement.campaign import Refinement
from masonry.sweeps.convergence.refinement.edge_points import PRESSURE, lost_arm, unresolved
from masonry.sweeps.convergence.refinement.numerical_errors import error_of
from masonry.sweeps.work import OK

PEAK = Answer("peak_stress_pa", "peak")


def resultant(points, strip):
    """From the edge, over the edge's length, and the largest pressure, where a wedge as wide as the strip would press
    if points were many; the force is that wedge's."""
    place, weight = edge_rule("vertex", points)
    force = 0.5 * strip**2
    depth = brentq(lambda d: weight @ np.maximum(d - place, 0.0) - force, 0.0, 10.0)
    pressure = np.maximum(depth - place, 0.0)
    return weight @ (pressure * place) / force, pressure[0]


@pytest.mark.parametrize("points", [3, 4, 8, 13, 16])
def test_a_row_that_bears_alone_hides_at_most_the_lost_arm(points):
    """The resultant of a strip lies a third of it from the edge, and the arm is half the edge."""
    strips = [strip for strip in np.geomspace(1e-4, 0.5, 400) if resultant(points, strip)[0] == 0.0]
    assert 0.97 * lost_arm(points) < 2.0 * max(strips) / 3.0 <= lost_arm(points) * (1.0 + 1e-9)


def runs_of(strip, numbers):
    """A block on a bed that turns about its edge: the peak is as large as the arm of the resultant."""
    for number in numbers:
        place, pressure = resultant(number, strip)
        factor = number / numbers[0]
        trial = Refinement("points along x" if factor > 1 else "as it is", factor, {}, at_edges=number)
        row = {"status": OK, PEAK.key: 1e4 * (0.5 - place), PRESSURE: pressure}
        yield (Refinement("as it is", 1.0, {}) if factor == 1 else trial), row


@pytest.mark.parametrize("strip", np.geomspace(0.003, 0.3, 12))
@pytest.mark.parametrize("numbers", [(2, 8), (2, 8, 16), (4, 8), (4, 8, 16), (3, 12)])
def test_a_strength_that_points_at_edges_do_not_move_has_a_bar(strip, numbers):
    runs = list(runs_of(strip, numbers))
    error, limit = error_of(PEAK, runs), 1e4 * (0.5 - strip / 3.0)
    assert abs(error.limit - limit) <= error.half_width
    assert error.half_width < 0.35 * limit


def test_a_joint_that_stays_closed_has_no_such_bar():
    """Its pressure is even, whatever the points."""
    runs = list(runs_of(0.01, (2, 8)))
    for _, row in runs:
        row[PRESSURE] = 3e5
    assert unresolved(runs) == {}
    assert error_of(PEAK, runs).half_width == 0.0


def test_only_strengths_are_as_large_as_an_arm():
    runs = [(trial, row | {"gauges.top.final_m": 0.01}) for trial, row in runs_of(0.01, (2, 8))]
    assert error_of(Answer("gauges.top.final_m", "top"), runs).half_width == 0.0
    assert error_of(PEAK, runs).half_width == pytest.approx(lost_arm(8) * Value(runs[0][1][PEAK.key]).number)
