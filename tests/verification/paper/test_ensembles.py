"""The stochastic sequel: its walls differ by what they draw alone, and what is read off them is what happened."""

from dataclasses import replace

import numpy as np
import pytest

from masonry import scene
from masonry.laboratory import laboratory
from masonry.pictures.crack_lines import CrackLines
from verification.paper.ensembles import claims
from verification.paper.ensembles.realisations import POINTS, Ensemble, Wall, wall
from verification.paper.experiments import scatter

LINES = CrackLines(
    *(np.zeros((2, 3)), np.ones((2, 3)), np.arange(2), np.zeros(2), np.ones(2, dtype=bool), np.zeros(2)),
    dry=np.zeros(2, dtype=bool),
    crushed=np.zeros(2, dtype=bool),
)
WALL = Wall(0.1e6, np.linspace(0.0, 0.1e6, POINTS), np.array([True, False]), frozenset({(0, 1)}), "stepped", 0.4)


def ensemble(*peaks: float, **changes) -> Ensemble:
    """Walls with these peaks (Pa), otherwise alike."""
    walls = [replace(WALL, peak=peak, stress=WALL.stress * peak / 0.1e6, **changes) for peak in peaks]
    return Ensemble(walls, np.linspace(0.0, 1e-3, POINTS), LINES, np.array([True, True]))


def modes(*peaks: float, **changes) -> dict:
    """A scene with walls of these peaks, each four times."""
    return {"mode": (ensemble(0.1e6), {"correlated": ensemble(*4 * peaks, **changes)})}


@pytest.mark.parametrize("quick", [True, False])
def test_the_walls_of_a_scene_differ_by_seed_and_correlation_alone(quick):
    made = scatter.runs(quick)
    for mode, name in scatter.SCENES.items():
        labels = [label for label in made if label.startswith(f"{mode}, ")]
        seen = [(made[k].settings["scatter.seed"], made[k].settings["scatter.unit_unit.correlation"]) for k in labels]
        assert len(set(seen)) == len(labels) == sum((scatter.QUICK_COUNTS if quick else scatter.COUNTS).values())
        plain, drawn = (scene.load(name, made[label].settings) for label in (mode, labels[0]))
        assert drawn.model_copy(update={"scatter": None}) == plain
        assert {g: set(s.variations.values()) for g, s in drawn.scatter.groups.items()} == {
            "unit_unit": {0.3},
            "within_units": {0.2},
        }


@pytest.mark.parametrize(
    ("name", "path", "opening"),
    [("wallette-mode-1", "stepped", (0.2, 0.6)), ("wallette-mode-2", "straight", (0.9, 1.0))],
)
def test_the_way_of_a_crack_is_read_off_the_contacts_that_broke(name, path, opening):
    result = laboratory.run(scene.load(name, {"drive.accuracy": "4 %"}))
    found = wall(result, np.linspace(0.0, float(result.history.rows["displacement"][-1]), POINTS))
    assert found.path == path and opening[0] < found.by_opening <= opening[1]
    assert any(a == b for a, b in found.places) == (path == "straight")
    assert found.peak >= found.stress.max() > 0.97 * found.peak


def test_a_band_holds_nine_walls_in_ten_and_the_frequency_is_that_of_the_walls():
    many = ensemble(*np.linspace(0.08e6, 0.12e6, 101))
    low, high, middle = many.band()
    assert (low[-1], middle[-1], high[-1]) == pytest.approx((0.082e6, 0.1e6, 0.118e6))
    assert many.frequency.tolist() == [1.0, 0.0] and many.patterns == 1
    assert many.paths == {"stepped": 101, "mixed": 0, "straight": 0}


def test_no_claim_of_scatter_holds_of_walls_that_are_all_alike():
    same = modes(0.1e6, 0.1e6, 0.1e6)
    for claim in (claims.envelope_claim, claims.mixed_claim, claims.weakest_claim):
        assert claim(same).holds is False


def test_of_few_walls_nothing_is_told():
    few = {"mode": (ensemble(0.1e6), {"correlated": ensemble(0.05e6, 0.1e6)})}
    assert claims.envelope_claim(few).holds is None and "2 walls" in claims.envelope_claim(few).why


def test_the_claims_see_weaker_walls_that_crack_in_another_way():
    other = modes(0.08e6, 0.07e6, 0.09e6, path="straight")
    assert claims.weakest_claim(other).holds
    assert claims.qualitative_claim(other).holds is False
    assert claims.averaging_claim(other).holds
    assert claims.averaging_claim(modes(0.02e6, 0.1e6, 0.18e6)).holds is False
