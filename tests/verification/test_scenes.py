"""The scenes of the verification run by themselves, and a run of one is judged as it ended."""

import pytest

from masonry import scene
from masonry.laboratory import laboratory
from verification.catalogue import catalogue
from verification.scene_runs import FOLDER, load, run, source_of, text_of
from verification.studies.refinement import problems

MADE = ("column-with-quiet-ends",)
"""Scenes whose blocks are made by their case."""
NAMES = sorted(file.stem for file in FOLDER.glob("*.toml"))


@pytest.mark.parametrize("name", [name for name in NAMES if name not in MADE])
def test_each_scene_can_be_built_and_has_a_name_of_its_own(name):
    report = laboratory.check(load(name))
    touches = report["blocks"] > 1 and report["contact_points"] > 0
    assert touches or load(name).motion or load(name).bar, "alone it flies, or hangs on a bar"
    assert load(name).title and name not in scene.packaged()


def test_each_case_and_problem_names_a_scene_that_is_there():
    names = {case.scene for case in catalogue().values() if case.scene and "\n" not in case.scene}
    names |= {problem.scene for problem in problems()}
    assert {name for name in names if name not in NAMES} <= scene.packaged().keys()
    assert all("kind =" in text_of(name) or "base =" in text_of(name) for name in names)
    assert source_of("couplet") == "couplet"


def test_a_run_is_judged_by_how_it_ended():
    few = {"drive.steps": 200, "settle.steps": 200}
    fine = run("couplet", few)
    assert fine.ok and fine.imbalance < 1e-10 and fine.seconds > 0.0 and fine.result is not None
    refused = run("couplet", {"solver.damping": 1.0})
    assert (refused.status, refused.result) == ("REFUSED", None) and "damping" in refused.reason
    stopped = run("couplet", few | {"solver.step_fraction": 5.0})
    assert stopped.status == "STOPPED" and "step" in stopped.reason and stopped.result is not None
