"""The line of `masonry check` that names the command which refines a scene."""

import masonry
from masonry.sweeps.error_bars.check_line import error_bar_line
from tests.convergence.samples import TIPPED


def test_check_names_the_command_and_what_it_refines():
    report = masonry.check(TIPPED)
    assert report.error_bar.startswith("masonry run --error-bar says how far its numbers are off by ")
    assert "pace" in report.error_bar and "contact points" in report.error_bar
    line = next(line for line in repr(report).splitlines() if line.startswith("error bar "))
    assert line.split(maxsplit=2)[2] == report.error_bar


def test_a_scene_that_no_run_takes_has_no_such_line():
    """A vehicle without an accuracy: limit analysis alone."""
    assert error_bar_line(masonry.load("bridge")) == ""
    assert "error bar " not in repr(masonry.check("bridge"))


def test_a_motion_is_refined_in_its_time_step_and_tets_in_their_size():
    swings = error_bar_line(masonry.load("block-rocking"))
    assert "time step" in swings and "pace" not in swings
    tets = masonry.load("couplet", {"kinematics": "tets", "specimen.mesh_size": "0.05 m"})
    assert error_bar_line(tets).endswith("contact points and size of tets")
