"""What a scene may say of gauges and of its curve, what it is told where that is wrong, and where readings go."""

import h5py
import numpy as np
import pytest

from masonry.curves.curve_axes import curve_axes
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.laboratory.result import load_result
from masonry.results.table import csv_text
from masonry.scene import load, to_toml

GAUGE = {"name": "slip", "at": "top", "direction": "x", "relative_to": {"x": "middle", "y": "50 mm", "z": "0 mm"}}
SHORT = {"drive.steps": 60, "settle.steps": 40, "solver.rows": 5}


def asked(**changes):
    """A couplet with one gauge, some of its keys changed."""
    return load("couplet", {**SHORT, "gauge": [{**GAUGE, **changes}]})


def test_a_gauge_survives_being_written_out():
    scene = load("couplet", {**SHORT, "gauge": [GAUGE], "curve": {"x": "slip", "y": "force"}})
    assert 'x = "slip"' in to_toml(scene) and "[gauge.relative_to]" in to_toml(scene)


def test_the_scene_that_is_written_out_is_the_same(tmp_path):
    scene = load("bending-0")
    file = tmp_path / "bending-0.toml"
    file.write_text(to_toml(scene), encoding="utf-8")
    assert load(file) == scene and scene.gauge


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"name": "a,b"}, "gauge.0.name: 'a,b' must begin with a letter"),
        ({"name": "stress"}, "'stress' is a column of the results already"),
        ({"direction": "up"}, "gauge.0.direction: 'up' is not allowed"),
        ({"at": {"x": "1 mm"}}, "gauge.0.at: must be a selector such as 'top.z+', or a table of two or three"),
        ({"at": {"x": "1 mm", "q": "1 mm"}}, "two or three of x, y, z"),
        ({"at": {"x": "1 mm", "y": 3}}, "3 has no unit"),
        ({"at": 7}, "must be a selector"),
        ({"relativ_to": "top"}, "unknown key; did you mean 'relative_to'?"),
    ],
)
def test_a_gauge_that_is_wrong_gives_one_message(changes, said):
    with pytest.raises(SceneError) as error:
        asked(**changes)
    assert said in str(error.value) and "\n" not in str(error.value)


def test_a_place_where_there_is_nothing_is_told_with_where_the_specimen_is():
    nowhere = asked(at={"x": "middle", "y": "51 mm"})
    with pytest.raises(SceneError, match=r"gauge.0.at: no block lies at x = 100 mm, y = 51 mm; .* y 0 to 50 mm"):
        laboratory.assemble(nowhere)
    with pytest.raises(SceneError, match="gauge.0.relative_to = 'botom' selects nothing; .*did you mean 'bottom'"):
        laboratory.assemble(asked(relative_to="botom"))


def test_two_gauges_of_one_name_and_a_curve_over_no_gauge_are_refused():
    with pytest.raises(SceneError, match=r"gauge.1.name: 'slip' is a column"):
        load("couplet", {"gauge": [GAUGE, GAUGE]})
    with pytest.raises(SceneError, match=r"curve.x: 'slop' is no gauge; allowed: displacement, time, slip"):
        load("couplet", {"gauge": [GAUGE], "curve": {"x": "slop"}})


def test_readings_are_columns_with_a_unit_in_every_file_and_the_curve_is_drawn_over_them(tmp_path):
    scene = load("couplet", {**SHORT, "gauge": [GAUGE], "curve": {"x": "slip", "y": "force"}})
    result = laboratory.run(scene)
    result.save(tmp_path)
    assert (tmp_path / "curve.csv").read_text().startswith("displacement [m],stress [Pa],slip [m],step [1]")
    with h5py.File(tmp_path / "history.h5") as file:
        assert (file["rows/slip"].attrs["unit"], file["rows/force"].attrs["unit"]) == ("m", "N")
    again = load_result(tmp_path)
    assert csv_text(again.history) == csv_text(result.history)
    axes = curve_axes(again)
    assert (axes.label, axes.name, axes.unit) == ("slip [mm]", "force", "kN")
    assert np.array_equal(axes.across, 1e3 * result.history.rows["slip"])
    assert axes.factor == pytest.approx(1e-3 * result.specimen.section)
