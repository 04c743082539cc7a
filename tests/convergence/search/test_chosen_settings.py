"""Settings that are chosen for an error: of numbers that are made up, as functions of the settings of a scene."""

import tomllib
from dataclasses import dataclass, field
from math import inf
from typing import Any

import pytest

from masonry.scene import Scene, changed, load
from masonry.sweeps.convergence.error_picture import figure_of
from masonry.sweeps.convergence.refinement.answers import ANSWERS
from masonry.sweeps.convergence.refinement.campaign import BASE, SCATTER, Campaign, Refinement
from masonry.sweeps.convergence.refinement.numerical_errors import error_of
from masonry.sweeps.convergence.search.next_settings import Proposal, Steps, narrower
from masonry.sweeps.convergence.search.settings_search import choose
from tests.convergence.samples import TIPPED

PEAK, THERE = "peak_stress_pa", "displacement_at_peak_m"


@dataclass
class MadeUp:
    """Numbers of a scene whose values without end are 1.

    of_points, of_pace  error of the peak with one point along x, and with an accuracy of 1 (of order 2 and 1)
    scatter             by which the displacement there differs, whatever is set
    seconds             of the scene as it is
    cliff               the accuracy from which on the peak is another one
    stops               points along x from which on a run is stopped
    """

    of_points: float = 0.0
    of_pace: float = 0.0
    scatter: float = 0.0
    seconds: float = 1.0
    cliff: float = 1.0
    stops: float = inf
    verdicts: dict[float, str] = field(default_factory=dict)
    measured: int = 0

    def peak(self, scene: Scene) -> float:
        """The number of a run."""
        error = self.of_points / scene.points_per_edge.x**2 + self.of_pace * scene.drive.accuracy
        return (1.0 if scene.drive.accuracy < self.cliff else 1.5) + error

    def row(self, scene: Scene, sign: float) -> dict[str, Any]:
        accuracy, points = scene.drive.accuracy, scene.points_per_edge.x
        return {
            "status": "OK" if points < self.stops else "STOPPED",
            "key": f"{points} {accuracy}",
            PEAK: self.peak(scene),
            THERE: 1.0 + sign * self.scatter,
            "seconds_processor_run": self.seconds * 0.01 / accuracy * (0.5 + points / 6.0),
            "verdict": self.verdicts.get(accuracy, "sound"),
            "doubts": "",
        }

    def measure(self, scene: Scene) -> Any:
        """As its runs would tell."""
        self.measured += 1
        campaign = Campaign(scene)
        trials = [Refinement(BASE, 1.0, {}), Refinement(SCATTER, 1.0, {})]
        trials += [trial for r in campaign.resolutions if (trial := campaign.trial(r, 2.0)) is not None]
        runs = [(trial, self.row(changed(scene, trial.settings), float(trial.name == SCATTER))) for trial in trials]
        if runs[0][1]["status"] != "OK":
            return [], runs
        answers = [answer for answer in ANSWERS if answer.key in (PEAK, THERE)]
        return [error for answer in answers if (error := error_of(answer, runs)) is not None], runs

    def choose(self, to: float, lines: list[str] | None = None) -> Any:
        scene = load(TIPPED)
        return choose(scene, self.measure(scene), to, self.measure, tell=(lines if lines is not None else []).append)


def test_what_makes_up_the_error_is_refined_and_nothing_else():
    made_up, lines = MadeUp(of_points=2.0, of_pace=0.01, seconds=0.05), []
    chosen = made_up.choose(0.01, lines)
    assert chosen.error <= 0.01 and abs(made_up.peak(changed(load(TIPPED), chosen.settings)) - 1.0) <= 0.01
    assert (
        set(chosen.settings) == {"specimen.points_per_edge"} and chosen.settings["specimen.points_per_edge"]["y"] == 3
    )
    assert len(lines) == len(chosen.tried) - 1
    assert "round 1: peak within" in lines[0] and "points along x" in lines[0] and "points_per_edge = {x = " in lines[0]


def test_of_two_resolutions_that_matter_both_are_refined_each_with_its_reason():
    made_up = MadeUp(of_points=0.2, of_pace=4.0, seconds=0.01)
    chosen = made_up.choose(0.03)
    assert chosen.error <= 0.03 and chosen.unreached == {}
    read = chosen.as_toml("scene.toml")
    assert "points along x finer" in read and "pace finer" in read
    assert tomllib.loads(read)["drive"]["accuracy"] < 0.01 and tomllib.loads(read)["base"] == "scene.toml"


def test_a_number_that_scatters_does_not_drive_the_cost():
    """Far beyond the error asked for nothing is tried; near it one slower pace is, in vain."""
    for scatter, rounds in {0.3: 0, 0.002: 1}.items():
        made_up = MadeUp(scatter=scatter)
        chosen = made_up.choose(0.01)
        assert len(chosen.tried) - 1 == rounds and chosen.settings == {}
        assert list(chosen.unreached) == [THERE] and chosen.error <= 0.01
        assert "The displacement there is within" in chosen.words and "differ in nothing of meaning" in chosen.words


def test_what_is_within_reach_is_refined_beside_what_scatters():
    chosen = MadeUp(of_points=2.0, scatter=0.3).choose(0.01)
    assert chosen.error <= 0.01 and list(chosen.unreached) == [THERE] and "specimen.points_per_edge" in chosen.settings


def test_what_would_cost_too_much_is_left():
    chosen = MadeUp(of_pace=100.0).choose(0.001)
    assert "would take more than 10 times its time" in chosen.unreached[PEAK] and chosen.best.largest() > 0.001
    assert max(tried.seconds for tried in chosen.tried) < 20.0
    assert chosen.best.largest() < 0.5 * chosen.tried[0].largest(), "as good as it became"


def test_a_search_ends_where_all_its_runs_took_a_hundred_times_the_scene(monkeypatch):
    monkeypatch.setattr("masonry.sweeps.convergence.search.settings_search.LONGEST", 3.0)
    chosen = MadeUp(of_points=2.0, seconds=0.05).choose(0.001)
    assert chosen.unreached == {PEAK: "the search took 3 times the time of the scene"}
    assert len(chosen.tried) == 1 and chosen.settings == {}


def test_settings_whose_run_is_stopped_are_not_chosen():
    chosen = MadeUp(of_points=2.0, stops=7, seconds=0.05).choose(0.01)
    assert chosen.settings == {} and chosen.unreached == {PEAK: "the run with finer settings was stopped"}


def test_what_costs_and_buys_nothing_becomes_coarser_unless_the_verdict_is_worse():
    made_up = MadeUp(of_points=0.01)
    chosen = made_up.choose(0.05)
    assert chosen.settings["drive.accuracy"] > 0.01 and chosen.best.seconds < chosen.tried[0].seconds
    assert "coarser" in chosen.best.reasons["drive.accuracy"]["pace"]
    doubtful = MadeUp(of_points=0.01, verdicts=dict.fromkeys((0.02, 0.04, 0.08), "with care")).choose(0.05)
    assert doubtful.best.verdict == "sound" and doubtful.settings.get("drive.accuracy", 0.01) == 0.01


def test_what_turns_out_to_be_too_coarse_is_not_chosen():
    """The error of a coarser pace is expected from that of the scene, and larger than that."""
    chosen = MadeUp(of_points=0.01, cliff=0.015).choose(0.05)
    assert chosen.error <= 0.05 and chosen.settings.get("drive.accuracy", 0.01) == 0.01


def test_a_short_run_is_left_as_it_is():
    assert MadeUp(of_points=0.01, seconds=0.05).choose(0.05).settings == {}


def test_a_pace_that_cannot_be_coarser_is_left_as_it_is():
    assert Steps(Campaign(load("couplet", {"drive.accuracy": 0.2}))).coarser([]) is None


@pytest.mark.parametrize("factors", [{"points along x": 2.0, "points along z": 0.5}])
def test_points_along_two_axes_are_set_at_once(factors):
    steps = Steps(Campaign(load("wallette-mode-1", {"specimen.points_per_edge": {"x": 3, "y": 2, "z": 4}})))
    assert steps.settings(Proposal(factors, 1.0))["specimen.points_per_edge"] == {"x": 6, "y": 2, "z": 2}


def test_the_picture_marks_the_scene_as_it_is_and_the_cheapest_good_settings():
    """The number is that which is worst within reach, and errors are those from the finest value without end."""
    made_up, scene = MadeUp(of_points=2.0, scatter=0.3), load(TIPPED)
    chosen = made_up.choose(0.01)
    errors, runs = made_up.measure(scene)
    axes = figure_of("made up", errors, runs, chosen).axes[0]
    marked = {line.get_label(): line.get_xydata() for line in axes.lines}
    assert axes.get_ylabel() == "error of the peak [%]"
    assert {"pace", "points along x", "scatter", "1 % asked for", "tried one after the other"} <= set(marked)
    (first,), (best,) = marked["scene as it is"], marked["cheapest good: converged.toml"]
    assert first == pytest.approx([1.0, 100 * 2.0 / 3**2], rel=0.05)
    assert best[0] == pytest.approx(chosen.best.seconds) and best[1] < 1.0


def test_the_interval_of_a_load_factor_becomes_a_quarter_of_the_error_asked_for():
    scene = load("wall-tied")
    assert narrower(scene, 0.01) == {"limit.accuracy": 0.0025}
    assert narrower(scene, 0.2) == {} and narrower(load(TIPPED), 0.01) == {}
