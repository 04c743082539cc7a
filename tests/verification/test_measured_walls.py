"""Measured walls beside computed ones: their scenes, what is varied, what statics say, the chapter of two of them."""

import pytest

from masonry.scene import load
from verification.studies.walls import measured_walls as study
from verification.studies.walls.measured_walls import PARAMETERS, UNBALANCED, UNITS, WALLS, WallForces


@pytest.mark.parametrize("wall", WALLS, ids=lambda wall: wall.name)
def test_each_wall_and_its_variations_are_scenes(wall):
    varied = study.variations(wall)
    assert set(varied) | {UNITS} == set(PARAMETERS)
    for settings in varied.values():
        for changed in settings:
            assert load(wall.scene, {**wall.settings, **changed}) != load(wall.scene, wall.settings)


def test_walls_that_bore_more_than_a_load_that_stays_can_balance_are_named():
    length, thickness, weight = 1.5, 0.38, 18.0
    for wall in WALLS:
        if wall.name.startswith("MI"):
            height = 2.0 if wall.name in ("MI1", "MI2") else 3.0
            pressed = 1e3 * float(wall.settings["confinement"].split()[0]) * length * thickness
            most = (pressed + 0.5 * weight * length * thickness * height) * length / height
            assert (wall.mean > most) == (wall.failure == UNBALANCED)
            assert wall.failure != UNBALANCED or f"balance {most:.0f} kN" in wall.assumed


def test_changes_are_shares_and_bars_reach_to_the_farthest():
    forces = WallForces(100.0, {UNITS: [80.0, 130.0]}, "")
    assert forces.changes(UNITS) == pytest.approx([-0.2, 0.3]) and forces.changes("points") == []
    assert forces.reach == (80.0, 130.0)


def test_the_chapter_of_two_walls_holds_them_against_what_was_measured(tmp_path):
    lines: list[str] = []
    chapter = study.chapter(lines.append, quick=True, folder=tmp_path)
    assert [verdict.kind for verdict in chapter.verdicts] == ["ok"]
    assert {record["case"] for record in chapter.records} == {"SW0.1", "SW0.2"}
    assert all(abs(record["error"]) < 0.1 for record in chapter.records)
    again = study.chapter(lines.append, quick=True, folder=tmp_path)
    assert again.records == chapter.records and "2 of 2 runs are done already" in lines
