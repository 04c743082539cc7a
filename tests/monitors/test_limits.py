"""A slip of a unit must not fill the memory, and a run says when it cannot be trusted."""

import os
import signal

import pytest

from masonry import scene
from masonry.errors import SceneError
from masonry.judgement.sentence import trust
from masonry.laboratory import laboratory
from masonry.pictures.style import plain
from masonry.runtime.interrupts import interrupt_afterwards


@pytest.mark.parametrize(
    ("overrides", "message"),
    [
        ({"specimen.divisions": [1000, 1000, 1000]}, r"specimen\.divisions.*2e\+09 blocks"),
        ({"specimen.points_per_edge": 1000}, r"specimen\.points_per_edge.*contact points"),
        ({"kinematics": "tets", "specimen.mesh_size": "0.1 mm"}, r"specimen\.mesh_size.*tets"),
        ({"drive.rate": "1e-9 m/s"}, r"drive.*steps.*at most"),
        ({"specimen.width": "1e-300 m"}, r"specimen\.width.*1e-300"),
    ],
)
def test_a_scene_too_large_for_any_machine_is_refused_before_it_is_built(overrides, message):
    with pytest.raises(SceneError, match=message):
        laboratory.check(scene.load("couplet", overrides))


def test_a_run_whose_dead_loads_did_not_come_to_rest_says_so():
    hasty = {"settle.steps": 20, "drive.steps": 200, "kinematics": "affine"}
    summary = laboratory.run(scene.load("couplet", hasty)).summary
    assert summary["unbalanced_after_settling"] > 0.01
    assert "dead loads had not come to rest" in trust(summary)
    patient = laboratory.run(scene.load("couplet", {"drive.steps": 200, "kinematics": "affine"})).summary
    assert patient["unbalanced_after_settling"] < 1e-6


def test_the_mismatch_of_the_two_ends_is_looked_for_at_the_peak_too():
    """Twenty times too fast: the ends differ most round the peak, which comes before the end of the ramp."""
    summary = laboratory.run(scene.load("wallette-mode-1", {"drive.rate": "20 mm/s", "drive.ramp": 0.9})).summary
    assert summary["reaction_mismatch_max"] > 0.02 and "drive and support differ" in trust(summary)


def test_ctrl_c_while_compiling_counts_when_the_compiler_is_done():
    done = []
    with pytest.raises(KeyboardInterrupt), interrupt_afterwards():
        os.kill(os.getpid(), signal.SIGINT)
        done.append(True)
    assert done


def test_a_title_is_drawn_as_it_is_written():
    assert plain("a $5 \\frac{$\nb") == "a \\$5 \\frac{\\$ b"
