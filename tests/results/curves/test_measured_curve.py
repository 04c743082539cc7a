"""A measured curve beside the computed one: its file, the numbers of both, their envelopes, and the picture."""

from pathlib import Path

import numpy as np
import pytest

from masonry import scene
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.laboratory.beside_text import measured_lines
from masonry.laboratory.summary.measurements.beside_measured import compared
from masonry.rows.measured_curve import ForcePath, cycles, envelope, numbers_of
from masonry.scene.tables.gauge import Curve

SHORT = {"settle.steps": 100, "drive.steps": 2000, "solver.rows": 40}


def path(place: list[float], force: list[float]) -> ForcePath:
    return ForcePath(np.array(place, dtype=float), np.array(force, dtype=float))


def written(folder: Path, text: str) -> str:
    file = folder / "wall.csv"
    file.write_text(text, encoding="utf-8")
    return str(file)


def test_numbers_of_a_curve_by_hand():
    numbers = numbers_of(path([0, 1, 2, 4], [0, 10, 20, 10]), upto=4.0)
    assert (numbers.peak, numbers.at_peak, numbers.stiffness) == (20.0, 2.0, 10.0)
    assert numbers.energy == pytest.approx(5.0 + 15.0 + 30.0)
    assert numbers_of(path([0, 1, 2, 4], [0, 10, 20, 10]), upto=3.0).energy == pytest.approx(5.0 + 15.0 + 17.5)


def test_loops_dissipate_what_they_enclose_and_have_an_envelope_on_both_sides():
    loop = path([0, 1, 0, -1, 0, 2, 0], [0, 3, -1, -2, 1, 4, -1])
    assert cycles(loop) and not cycles(path([0, 1, 0.7, 2], [0, 1, 0.5, 1]))
    front, back = envelope(loop), envelope(loop, -1.0)
    assert front.place.tolist() == [0, 1, 2] and front.force.tolist() == [0, 3, 4]
    assert back.place.tolist() == [0, -1] and back.force.tolist() == [0, -2]
    assert numbers_of(loop).energy == pytest.approx(1.5 - 1.0 + 1.5 - 0.5 + 5.0 - 3.0)


def test_differences_are_shares_of_the_measured_numbers():
    beside = compared(path([0, 1, 3], [0, 10, 10]), path([0, 1, 2], [0, 12, 12]))
    assert beside.compared_to_m == 2.0 and not beside.in_cycles
    assert [beside.peak_difference, beside.stiffness_difference, beside.energy_difference] == pytest.approx([0.2] * 3)
    assert beside.farthest_apart == pytest.approx(0.2) and beside.lowest_difference is None
    assert "peak 0.012 kN, measured 0.01 kN (+20 %)" in measured_lines(beside)


def test_both_in_cycles_are_compared_by_their_loops():
    loop = path([0, 1, 0, -1, 0], [0, 3, -1, -2, 1])
    beside = compared(loop, ForcePath(loop.place, 1.5 * loop.force))
    assert beside.in_cycles and beside.lowest_difference == pytest.approx(0.5)
    assert beside.energy_difference == pytest.approx(0.5)


def test_a_file_of_the_database_is_read_as_it_is():
    """Names and units in lines of their own."""
    curve = scene.load("wall-ws100").curve
    measured = curve.measurement(0.2)
    assert measured.force.max() == pytest.approx(37e3) and measured.place.max() == pytest.approx(0.0423)
    by_name = curve.model_copy(update={"measured_columns": ("top_displacement", "horizontal_force")})
    assert np.array_equal(by_name.measurement(0.2).force, measured.force)


def test_a_stress_is_turned_into_a_force(tmp_path):
    file = written(tmp_path, "u [mm],s [MPa]\n0,0\n1,0.1\n2,0.2\n")
    assert Curve(measured=file).measurement(0.5).force.tolist() == pytest.approx([0, 0.05e6, 0.1e6])
    file = written(tmp_path, "u [mm];s [MPa]\n0,0;0\n1,0;0,1\n2,0;0,2\n")
    assert Curve(measured=file).measurement(0.5).force.tolist() == pytest.approx([0, 0.05e6, 0.1e6])


@pytest.mark.parametrize(
    ("text", "keys", "message"),
    [
        ("u,F\n0,0\n1,1\n2,2\n", {}, "has no unit behind 'u'"),
        ("u [mm],F [mm]\n0,0\n1,1\n2,2\n", {}, "'mm' is not the unit of a force or a stress"),
        ("u [kN],F [kN]\n0,0\n1,1\n2,2\n", {}, "'kN' is not the unit of a length"),
        ("u [mm],F [kN]\n0,0\n1,x\n2,2\n", {}, "row 2 of the numbers: 'x' is not a finite number"),
        ("u [mm],F [kN]\n0,0\n0,1\n0,2\n", {}, "its displacement does not change"),
        ("u [mm],F [kN]\n0,0\n1,1\n2,2\n", {"measured_columns": ["u", "G"]}, "has no column 'G'"),
        ("u [mm];F [kN]\n0;0\n1;1\n", {}, "has 2 samples"),
        ("u [mm],F [kN]\n0,0\n1,1\n2,2\n", {"x": "time"}, "is a force or stress over a displacement"),
    ],
)
def test_what_cannot_be_read_is_told_in_one_message(tmp_path, text, keys, message):
    settings = {f"curve.{key}": value for key, value in keys.items()}
    with pytest.raises(SceneError, match=r"curve\.measured") as raised:
        scene.load("couplet", {"curve.measured": written(tmp_path, text), **settings})
    assert message in str(raised.value) and str(raised.value).count("\n") == 0


def test_a_missing_file_and_keys_without_one_are_told(tmp_path):
    with pytest.raises(SceneError, match=r"curve\.measured"):
        scene.load("couplet", {"curve.measured": str(tmp_path / "none.csv")})
    with pytest.raises(SceneError, match="belongs to measured"):
        scene.load("couplet", {"curve.measured_units": ["mm", "kN"]})
    with pytest.raises(SceneError, match=r"beside the curve of a \[drive\]"):
        scene.load("arch", {"curve.measured": str(Path(scene.load("wall-ws100").curve.measured))})


def test_a_run_holds_them_and_draws_both(tmp_path):
    file = written(tmp_path, "u [mm],s [MPa]\n0,0\n0.01,0.3\n0.02,0.6\n1,0.6\n")
    result = laboratory.run(scene.load("couplet", {**SHORT, "curve.measured": file}))
    beside = result.summary.beside_measured
    assert beside.measured.peak_n == pytest.approx(0.6e6 * result.specimen.section)
    assert beside.peak_difference == pytest.approx(result.history.rows["stress"].max() / 0.6e6 - 1.0)
    from masonry.curves.curve import curve_figure

    assert "measured" in curve_figure(result).axes[0].get_legend_handles_labels()[1]
