"""`masonry.sweep`: a table from Python, points that are checked first, other executors, a map of two keys."""

import os
import signal
import subprocess
import sys
import threading
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path

import numpy as np
import pytest

import masonry
from masonry.cli.main import main
from masonry.errors import SceneError
from masonry.sweeps import engine, point_checks
from masonry.sweeps.job import Job
from masonry.sweeps.pictures.sweep_map import map_figure
from masonry.sweeps.pictures.varied_keys import keys_that_vary
from masonry.sweeps.planned_runs import Planned, plan
from masonry.sweeps.read import sweep_of_tables
from tests.python.test_scenes_of_tables import NAMED
from tests.sweep.samples import SHORT, marks, mistaken, untimed
from tests.sweep.test_sweep_picture import grid

ROOT = Path(__file__).resolve().parents[2]
STRENGTH, SHEAR = "contact.unit_unit.tensile_strength", "contact.unit_unit.fracture_energy_mode_2"
BRITTLE = {"law": "linear", "contact.unit_unit.fracture_energy_mode_2_slope": "0 N/m/MPa"}


@pytest.fixture
def couplet(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return masonry.load("couplet", SHORT)


def test_a_table_of_pandas_has_a_row_a_run_with_strengths_as_they_are_used(couplet):
    result = masonry.sweep(couplet, {"confinement": ["0.1 MPa", "250 kPa"], STRENGTH: ["0.5 MPa", "3 MPa"]}, workers=0)
    table = result.table
    assert table["confinement [Pa]"].tolist() == [1e5, 1e5, 2.5e5, 2.5e5] and len(result.rows) == 4
    assert table[f"{STRENGTH} used [Pa]"].to_numpy() == pytest.approx(np.tile([0.5e6, 0.87e6 / 1.01], 2))
    assert ["beyond the apex" in words for words in table["warnings"]] == [False, True] * 2
    assert ["tension_cut" in words for words in table["doubts"]] == [False, True] * 2
    assert result.result(-1).peak.stress == table["peak_stress_pa"].iloc[-1]
    assert "4 OK" in repr(result) and {"sweep.csv", "sweep.png", "sweep-map.png"} < set(os.listdir(result.folder))
    assert "0.8614" not in repr(result) and "(8.614e+05 Pa used)" in listed(couplet)


SCRIPT = f"""
import sys
sys.path.append({str(ROOT)!r})
import masonry
print("run")
scene = masonry.load("couplet", {SHORT})
print(masonry.sweep(scene, {{"confinement": ["0.1 MPa", "0.5 MPa"]}}, "out", workers=2).columns["status"])
"""


def test_a_script_without_a_main_guard_is_not_run_again_by_the_processes_of_its_sweep(tmp_path):
    (tmp_path / "script.py").write_text(SCRIPT)
    done = subprocess.run([sys.executable, "script.py"], cwd=tmp_path, capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("run\n['OK', 'OK']\n", "")


def test_pictures_in_another_format_take_the_place_of_the_first(couplet):
    values = {"confinement": ["0.1 MPa", "0.2 MPa"], "solver.damping": [0.7, 0.8]}
    masonry.sweep(couplet, values, "here", workers=0)
    result = masonry.sweep(couplet, values, "here", workers=0, form="svg")
    pictures = {name for name in os.listdir("here") if Path(name).suffix in (".png", ".svg")}
    assert pictures == {"sweep.svg", "sweep-map.svg"} < set(result.files)
    assert Path("here/sweep.svg").read_text(encoding="utf-8").startswith("<?xml")
    with pytest.raises(SceneError, match="^form = 'jpg'; "):
        masonry.sweep(couplet, values, "here", workers=0, form="jpg")


def listed(scene):
    from masonry.sweeps.planned_runs import listing

    return listing(plan(sweep_of_tables(scene, {STRENGTH: ["3 MPa"]})))


def test_the_same_sweep_goes_on_in_its_folder_and_from_the_command_line(couplet, monkeypatch, capsys):
    first = masonry.sweep(couplet, {"confinement": ["0.1 MPa"]}, "here", workers=0)
    before = marks(Path("here"))
    with pytest.raises(SceneError, match="another sweep"):
        masonry.sweep(couplet, {"confinement": ["0.2 MPa"]}, "here", workers=0)
    with pytest.raises(SceneError, match="a sweep of another scene"):
        masonry.sweep(couplet.with_(law="linear"), {"confinement": ["0.1 MPa"]}, "here", workers=0)
    with monkeypatch.context() as patch:
        patch.setattr(engine, "compute", mistaken)
        again = masonry.sweep(couplet, {"confinement": ["0.1 MPa"]}, "here", workers=0)
    assert untimed(again.rows) == untimed(first.rows) and marks(Path("here")) == before
    assert main(["sweep", str(first.folder / "sweep.toml"), "--list"]) == 0
    assert "confinement = '0.1 MPa'" in capsys.readouterr().out


def test_a_scene_of_blocks_that_were_handed_over_is_swept(couplet):
    scene = {"base": "triplet-dry", "specimen": NAMED, "drive.displacement": "0.05 mm"}
    result = masonry.sweep(scene, {"confinement": ["0.1 MPa", "0.2 MPa"]}, workers=0)
    assert result.columns["status"] == ["OK", "OK"]
    assert result.rows[1]["peak_force_n"] == pytest.approx(2 * result.rows[0]["peak_force_n"], rel=1e-3)


def test_points_that_cannot_be_built_end_it_before_the_first_run_with_reason_and_cure(couplet, monkeypatch):
    values = {"settings": BRITTLE, "grid": {SHEAR: ["58 N/m", "1e-3 N/m", "60 N/m", "2e-3 N/m"]}}
    with monkeypatch.context() as patch, pytest.raises(SceneError) as caught:
        patch.setattr(engine, "compute", mistaken)
        masonry.sweep(couplet, values, workers=0)
    first, second, last = caught.value.lines
    assert "run 2 of 4" in first and "it must be above" in first and "run 4 of 4" in second
    assert last == "2 of 4 runs can be built: refused=keep runs them, and keeps the others as rows"
    assert not os.listdir("results")
    result = masonry.sweep(couplet, values, workers=0, refused="keep")
    assert result.columns["status"] == ["OK", "REFUSED", "OK", "REFUSED"]
    assert "it must be above" in result.rows[1]["reason"] and len(result.plot().axes[0].lines) == 2
    with pytest.raises(SceneError, match="run 1 left no result: REFUSED"):
        result.result(1)


def test_points_are_checked_side_by_side_where_that_takes_long(couplet, monkeypatch):
    monkeypatch.setattr(point_checks, "PATIENCE", -1.0)
    values = {"settings": BRITTLE, "grid": {SHEAR: ["58 N/m", "1e-3 N/m", "60 N/m"]}}
    with pytest.raises(SceneError, match="run 2 of 3"):
        masonry.sweep(couplet, values, workers=2)


def test_what_is_wrong_with_many_points_is_told_once(couplet):
    with pytest.raises(SceneError) as caught:
        masonry.sweep(couplet, {"confinement": ["1", "0.1 MPa", "2"], "solver.damping": [0.7, 7]}, workers=0)
    assert [line.split(":")[0] for line in caught.value.lines] == [f"sweep, run {k}" for k in WRONG_POINTS]


WRONG_POINTS = ("1 of 6 and 1 more", "4 of 6", "5 of 6 and 1 more")


@pytest.mark.parametrize(
    ("vary", "message"),
    [
        (None, "say what varies"),
        ({}, "say what varies"),
        ({"grid": {}}, "nothing to vary"),
        ({"grd": {"law": ["linear"]}}, "grd: unknown key; .*did you mean 'grid'"),
        ({"confinement": "0.1 MPa"}, "must be a list of values"),
        ({"confinement": []}, "must be a list of values"),
        ({"confinemen": ["0.1 MPa"]}, "did you mean 'confinement'"),
        ({"latin_hypercube": {"samples": 0, "law": {"values": ["linear"]}}}, "samples: must be a whole number from 1"),
        ({"confinement": [{1.0}]}, "is no value of a scene"),
        ({"grid": {"law": ["linear"]}, "list": [{"law": "brittle"}]}, r"law is given in \[\[list\]\] and in \[grid\]"),
    ],
    ids=str,
)
def test_what_varies_is_looked_at_first(couplet, vary, message):
    with pytest.raises(SceneError, match=message):
        masonry.sweep(couplet, vary, workers=0)
    assert not Path("results").exists()


@pytest.mark.parametrize(
    "words", [{"workers": -1}, {"workers": "2"}, {"executor": 5}, {"refused": "kep"}, {"progress": 1}]
)
def test_a_wrong_word_is_named(couplet, words):
    with pytest.raises(SceneError, match=f"{next(iter(words))} = "):
        masonry.sweep(couplet, {"confinement": ["0.1 MPa"]}, **words)
    assert not Path("results").exists()


def test_an_executor_of_threads_gives_the_rows_of_this_process(couplet):
    values, lines = {"confinement": ["0.1 MPa", "0.2 MPa"]}, []
    here = masonry.sweep(couplet, values, "here", workers=0, progress=lines.append)
    with ThreadPoolExecutor(2) as executor:
        there = masonry.sweep(couplet, values, "there", executor=executor)
    assert untimed(here.rows) == untimed(there.rows) and sum("left" in line or "in all" in line for line in lines) == 2
    with pytest.raises(SceneError, match="the executor does nothing more .*; what is done stays"):
        masonry.sweep(couplet, {"confinement": ["0.3 MPa"]}, executor=executor)


class Dying(Executor):
    """Does one task, and then its processes are gone."""

    def __init__(self):
        self.done = 0

    def submit(self, act, /, *arguments, **words):
        future: Future = Future()
        self.done += 1
        if self.done == 1:
            future.set_result(act(*arguments, **words))
        else:
            future.set_exception(BrokenProcessPool("a process died"))
        return future


def test_of_an_executor_that_dies_what_is_done_stays(couplet):
    values = {"confinement": ["0.1 MPa", "0.2 MPa", "0.3 MPa"]}
    with pytest.raises(SceneError, match="a process died"):
        masonry.sweep(couplet, values, "here", executor=Dying())
    before = marks(Path("here"))
    result = masonry.sweep(couplet, values, "here", workers=0)
    assert result.columns["status"] == ["OK"] * 3 and len(before) <= 1 and before.items() <= marks(Path("here")).items()


def test_ctrl_c_ends_it_and_what_is_done_stays(couplet):
    values = {"confinement": ["0.1 MPa", "0.2 MPa"]}

    def interrupting(line):
        if line.startswith("[1/2]"):
            threading.Timer(0.01, os.kill, (os.getpid(), signal.SIGINT)).start()

    with pytest.raises(KeyboardInterrupt):
        masonry.sweep(couplet.with_({"drive.steps": 400_000}), values, "here", workers=0, progress=interrupting)
    assert len(marks(Path("here"))) == 1


def test_a_map_has_a_cell_for_each_pair_and_a_word_where_there_is_no_peak():
    runs = grid(["0.2 MPa", "0.1 MPa"], [0.7, 0.8])
    rows = [{"key": "", "status": "OK", "peak_stress_pa": 1e6 * n} for n in range(3)]
    rows += [{"key": "", "status": "REFUSED"}]
    figure = map_figure("pressures", runs, rows)
    axes, bar = figure.axes
    assert axes.get_xlabel() == "confinement" and bar.get_ylabel() == "peak stress [MPa]"
    assert [text.get_text() for text in axes.get_xticklabels()] == ["0.1 MPa", "0.2 MPa"]
    words = {text.get_position(): text.get_text() for text in axes.texts}
    assert words == {(1, 0): "0", (1, 1): "1", (0, 0): "2", (0, 1): "refused"}


def test_a_map_of_samples_has_points_in_units_that_people_read():
    samples = [{"confinement": f"{2e5 + 1e4 * n} Pa", "solver.damping": 0.5 + n * n % 7} for n in range(10)]
    runs = [Planned(Job("couplet"), sample, {}) for sample in samples]
    figure = map_figure("samples", runs, [{"key": "", "status": "OK", "peak_stress_pa": 1e6} for _ in runs])
    assert figure.axes[0].get_xlabel() == "confinement [MPa]" and figure.axes[0].get_ylabel() == "damping (solver)"


@pytest.mark.parametrize(
    ("first", "second", "count"),
    [(["1 kPa"], [0.7], 0), (["1 kPa"], [0.7, 0.8], 1), (["1 kPa", "2 kPa"], ["a", "b"], 2)],
)
def test_keys_that_do_not_vary_are_no_axes(first, second, count):
    assert len(keys_that_vary(grid(first, second))) == count
