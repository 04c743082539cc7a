"""Response spectra of gauges and of the ground: table, picture, command."""

import numpy as np
import pytest

from masonry.cli.commands import spectrum_command
from masonry.curves.response_spectra import spectra_csv, spectra_of
from masonry.errors import SceneError
from masonry.laboratory.result import Result
from masonry.rows.columns import GRAVITY
from tests.results.over_time.test_pictures_over_time import shaken


def swinging() -> Result:
    """A gauge that swings steadily at 10 Hz with 0.1 g for 10 s, and ground with twice as much, 200 rows a second."""
    result = shaken()
    time = 0.005 * np.arange(2021)
    swing = np.where(time >= 0.1, 0.1 * GRAVITY * np.sin(20.0 * np.pi * (time - 0.1)), 0.0)
    result.summary |= {"time_step_s": 1e-3}
    rows = {name: np.zeros(len(time)) for name in result.history.rows}
    result.history.rows = rows | {"time": time, "step": 1000.0 * time, "head": swing, "ground_x": 2.0 * swing}
    return result


def test_a_steady_swing_is_magnified_ten_times_at_its_period():
    """1 / (2 zeta) for 5 %; and as it is at periods far below it, which rows hardly show."""
    of_head, of_ground = spectra_of(swinging())
    assert [of_head.name, of_ground.name] == ["head", "ground_x"]
    answers = of_head.answers
    at = int(np.argmax(answers.pseudo_acceleration))
    assert answers.periods[at] == pytest.approx(0.1, rel=0.03)
    assert answers.pseudo_acceleration[at] == pytest.approx(10.0 * 0.1 * GRAVITY, rel=0.02)
    assert answers.pseudo_acceleration[0] == pytest.approx(0.1 * GRAVITY, rel=0.06)
    assert of_ground.answers.pseudo_acceleration == pytest.approx(2.0 * answers.pseudo_acceleration)
    assert of_head.shortest == pytest.approx(0.025)


def test_the_table_has_a_column_for_each_and_the_command_writes_it_with_a_picture(tmp_path, capsys):
    result = swinging()
    result.save_numbers(tmp_path)
    assert spectrum_command.main([str(tmp_path), "--of", "head", "--damping", "2 %"]) == 0
    lines = (tmp_path / "spectrum.csv").read_text().splitlines()
    assert lines[0] == "period [s],head [m/s2]"
    assert len(lines) == 232
    assert (tmp_path / "spectrum.png").stat().st_size > 10_000
    assert "head: 2.44 g at most, at 0.1 s; rows show periods from 0.025 s on" in capsys.readouterr().out
    assert spectra_csv(spectra_of(result)).startswith("period [s],head [m/s2],ground_x [m/s2]")


def test_what_is_no_acceleration_is_refused(tmp_path):
    with pytest.raises(SceneError, match="'sway' is no acceleration of this result; allowed: head, ground_x"):
        spectra_of(swinging(), ("sway",))
    result = swinging()
    result.history.units = {}
    del result.history.rows["ground_x"]
    with pytest.raises(SceneError, match="this result has no acceleration"):
        spectra_of(result)
    with pytest.raises(SceneError, match="--damping 'much' is no share"):
        spectrum_command.main([str(tmp_path), "--damping", "much"])
