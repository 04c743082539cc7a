"""curve.png of gauges over the time: a panel for each quantity, in its unit."""

import numpy as np
import pytest

from masonry.movies.movie import paths_of
from tests.results.sample import sample
from tests.results.test_pictures import resting
from tests.results.test_pictures_in_real_time import falling


def shaken(curve=""):
    """A motion in real time with gauges of three quantities."""
    count = len(sample().history.rows["step"])
    swing = np.sin(np.linspace(0.0, 20.0, count))
    result = falling(sway=2e-3 * swing, speed=0.3 * swing, head=9.80665 * 0.4 * swing)
    result.history.units = {"speed": "m/s", "head": "m/s2"}
    result.scene_toml = f"{curve}\n[settle]\nsteps = 100\n"
    result.summary |= {"time_step_s": 1e-4}
    return result


def test_gauges_of_three_quantities_have_three_panels_in_their_units_over_the_time_after_the_settling():
    *panels, ledger = shaken().plot().axes
    assert [axes.get_ylabel() for axes in panels] == ["displacement [mm]", "velocity [m/s]", "acceleration [g]"]
    assert [axes.get_lines()[0].get_label() for axes in panels] == ["sway", "speed", "head"]
    assert [float(np.abs(axes.get_lines()[0].get_ydata()).max()) for axes in panels] == pytest.approx(
        [2.0, 0.3, 0.4], rel=1e-2
    )
    assert ledger.get_xlabel() == "time after the settling [s]"
    time = panels[0].get_lines()[0].get_xdata()
    assert (time[0], time[-1]) == pytest.approx((-0.01, 0.09))
    assert ledger.get_xlim()[0] == 0.0


def test_a_curve_draws_the_gauges_that_it_names():
    result = shaken('[curve]\nx = "time"\ny = ["head", "sway"]\n')
    *panels, _ = result.plot().axes
    assert [axes.get_ylabel() for axes in panels] == ["displacement [mm]", "acceleration [g]"]


def test_a_bar_with_a_name_has_a_panel_in_kn_and_takes_nobodys_place():
    result = shaken('[curve]\nx = "time"\ny = "tie"\n')
    result.history.rows["tie"] = np.linspace(0.0, 5e3, len(result.history.rows["step"]))
    result.history.units["tie"] = "N"
    force, _ = result.plot().axes
    assert force.get_ylabel() == "force of bars [kN]" and force.get_lines()[0].get_ydata()[-1] == pytest.approx(5.0)
    result = resting(tie=result.history.rows["tie"])
    result.scene_toml, result.history.units = '[curve]\nx = "time"\n', {"tie": "N"}
    moved, _, _ = result.plot().axes
    assert moved.get_ylabel() == "displacement [mm]" and moved.get_lines()[0].get_label().startswith("top")


def test_a_movie_shows_lengths_beside_its_picture_and_no_acceleration_in_mm():
    paths, _, up = paths_of(shaken())
    assert [path.name for path in paths] == ["sway"]
    assert up == "displacement [mm]"


def test_a_drive_is_drawn_over_the_time_where_the_scene_asks():
    result = sample()
    result.scene_toml = '[curve]\nx = "time"\n'
    curve, ledger = result.plot().axes
    assert ledger.get_xlabel() == "time [s]"
    assert curve.get_lines()[0].get_xdata() == pytest.approx(result.history.rows["time"])
