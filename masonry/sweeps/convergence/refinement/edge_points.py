"""Points from edge to edge of joints that turn about an edge: what a number that they do not move says of its limit.

A joint without tension that turns presses on a strip beside its edge. As long as the outermost row of points bears
alone, more points bear the same, wherever in the strip the resultant should lie: two, four and at times eight agree,
and are wrong alike.
"""

from collections.abc import Sequence
from math import sqrt

from geometry.joints.point_density import edge_rule
from masonry.sweeps.convergence.refinement.answers import BORNE
from masonry.sweeps.convergence.refinement.campaign import TOGETHER, Refinement
from masonry.sweeps.run_store import Row

PRESSURE = "compression_max_pa"
STRENGTHS = ("peak_stress_pa", "final_stress_pa", "peak_force_n", BORNE)
"""Numbers that are as large as the arm of the resultant in a joint."""
ALONE = 0.5
"""Of the growth of the largest pressure, if the outermost row bore alone, from which on it does."""


def lost_arm(points: int) -> float:
    """By how much, over half the edge, the resultant lies inside of the edge at most where the outermost row of so many
    points bears alone: there the strip is no wider than sqrt(2 w h), with w the row's part of the edge and h the
    distance of the next row, which stays open; the resultant lies a third of the strip from the edge."""
    place, weight = edge_rule("vertex", points)
    return 2.0 / 3.0 * sqrt(2.0 * weight[0] * (place[1] - place[0]))


def unresolved(ended: Sequence[tuple[Refinement, Row]]) -> dict[str, float]:
    """By resolution along edges whose outermost rows bear alone in its finest run: what a strength may lose yet."""
    finest: dict[str, tuple[Refinement, Row]] = {}
    for trial, row in ended:
        if trial.at_edges is not None and trial.name != TOGETHER and row.get(PRESSURE):
            finest[trial.name] = max(finest.get(trial.name, (trial, row)), (trial, row), key=lambda run: run[0].factor)
    pressure = ended[0][1].get(PRESSURE)
    if not pressure:
        return {}
    return {
        name: lost_arm(trial.at_edges)
        for name, (trial, row) in finest.items()
        if trial.at_edges is not None and row[PRESSURE] / pressure > ALONE * _growth(trial)
    }


def _growth(trial: Refinement) -> float:
    """Of the pressure on the outermost row that bears alone, from the scene as it is to a run."""
    assert trial.at_edges is not None
    before = round(trial.at_edges / trial.factor)
    return float(edge_rule("vertex", before)[1][0] / edge_rule("vertex", trial.at_edges)[1][0])
