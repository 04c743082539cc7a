"""From rows of a sweep to a fragility curve: what counts as fallen, levels, lines of records, files, messages."""

import csv
import json
import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import tomli_w
from scipy.stats import binomtest

from masonry.cli.main import main
from masonry.errors import SceneError
from masonry.sweeps.fragility.fragility import FELL, fragility_of
from masonry.sweeps.fragility.fragility_files import columns_of, numbers_of, write_fragility
from masonry.sweeps.fragility.intensity import intensities
from masonry.sweeps.fragility.request import FragilityRequest, read_request
from masonry.sweeps.job import Job
from masonry.sweeps.planned_runs import Planned, plan
from masonry.sweeps.read import read
from tests.ground.test_ground_keys import BLOCK
from tests.sweep.samples import text

SEED, SCALE = "ground.made.seed", "ground.scale"
SCALES = [0.2, 0.3, 0.5, 0.8]


def made(records=30, median=0.4, dispersion=0.5):
    """Runs of records whose drift is in proportion to their scale, and which fall where it passes 1."""
    rng = np.random.default_rng(5)
    capacity = median * np.exp(dispersion * rng.normal(size=records))
    planned, rows = [], []
    for seed, own in enumerate(capacity):
        for scale in SCALES:
            planned.append(Planned(Job("couplet"), {SEED: seed, SCALE: scale}, {}))
            fell = {FELL: 2.0} if scale > own else {}
            rows.append({"status": "OK", "drift": scale / own} | fell)
    return planned, rows, capacity


def test_levels_have_the_counts_and_the_bands_of_binomial_trials():
    planned, rows, capacity = made()
    fragility = fragility_of(FragilityRequest(SCALE, measure="drift"), planned, rows)
    assert [level.intensity for level in fragility.levels] == SCALES
    assert [level.fallen for level in fragility.levels] == [(scale > capacity).sum() for scale in SCALES]
    for level in fragility.levels:
        band = binomtest(level.fallen, level.runs).proportion_ci(0.9)
        assert (level.low, level.high) == pytest.approx((band.low, band.high), abs=1e-9)
    drifts = np.where(SCALES[1] > capacity, np.inf, SCALES[1] / capacity)
    assert fragility.levels[1].quantiles == tuple(np.quantile(drifts, q, method="higher") for q in (0.16, 0.5, 0.84))
    assert fragility.fit.median == pytest.approx(0.4, rel=0.25) and "30" not in fragility.why_no_fit
    assert len(np.unique(fragility.record)) == 30


def test_a_limit_of_the_measure_is_a_fall_as_well():
    planned, rows, capacity = made()
    half = fragility_of(FragilityRequest(SCALE, measure="drift", limit=0.5), planned, rows)
    assert [level.fallen for level in half.levels] == [(scale >= 0.5 * capacity).sum() for scale in SCALES]


def test_a_run_that_was_stopped_counts_where_it_fell_before_and_a_lost_one_never():
    planned, rows, _ = made(records=5)
    for row in rows:
        row.pop(FELL, None)
    rows[0] |= {"status": "STOPPED", FELL: 1.0}
    rows[1] |= {"status": "STOPPED"}
    rows[2] = {"status": "ERROR"}
    fragility = fragility_of(FragilityRequest(SCALE), planned, rows)
    assert fragility.left_out == 2 and len(fragility.fallen) == 18 and fragility.fallen.sum() == 1
    assert ", 2 do not count" in fragility.sentence


def test_many_intensities_are_put_into_classes_of_as_many_runs():
    planned = [Planned(Job("couplet"), {SEED: n, SCALE: 0.1 * 1.3**n}, {}) for n in range(40)]
    rows = [{"status": "OK"} | ({FELL: 1.0} if n in (10, *range(20, 40)) else {}) for n in range(40)]
    levels = fragility_of(FragilityRequest(SCALE), planned, rows).levels
    assert [level.runs for level in levels] == [5] * 8 and sum(level.fallen for level in levels) == 21
    assert levels[0].intensity == pytest.approx(0.1 * 1.3**2), "the median, and not the mean"


def test_separated_runs_have_no_curve_and_the_files_say_why(tmp_path):
    planned, rows, _ = made(dispersion=0.0)
    fragility = fragility_of(FragilityRequest(SCALE, measure="drift"), planned, rows)
    write_fragility(tmp_path, "test", fragility, "png")
    numbers = json.loads((tmp_path / "fragility.json").read_text())
    assert numbers["fit"] is None and "0.3 to 0.5" in numbers["why_no_fit"] and "no curve" in fragility.sentence
    assert "fitted" not in columns_of(fragility)
    assert (tmp_path / "fragility.png").read_bytes()[:4] == b"\x89PNG"


def test_the_numbers_are_those_of_the_fit():
    planned, rows, _ = made()
    fragility = fragility_of(FragilityRequest(SCALE), planned, rows)
    numbers, columns = numbers_of(fragility)["fit"], columns_of(fragility)
    assert numbers["median_low"] < numbers["median"] < numbers["median_high"]
    assert columns["fitted_low"] < columns["fitted"] < columns["fitted_high"]
    assert list(columns)[0] == SCALE


def test_the_intensity_can_be_that_of_the_motion_itself_and_records_lie_beside_the_sweep(tmp_path, monkeypatch):
    (tmp_path / "block.toml").write_text(BLOCK)
    time = np.arange(0, 401) * 0.01
    for name, size in (("weak", 1.0), ("strong", 3.0)):
        samples = size * np.sin(2.0 * np.pi * time)
        lines = [f"{t:g},{a:.9g}" for t, a in zip(time, samples, strict=True)]
        (tmp_path / f"{name}.csv").write_text("\n".join(["time (s),a (m/s2)", *lines]))
    grid = 'scene = "block.toml"\n[settings]\n"ground.x" = "a"\n[grid]\n"ground.record" = ["weak.csv", "strong.csv"]\n'
    (tmp_path / "sweep.toml").write_text(grid + '"ground.scale" = [1.0, 2.0]\n')
    monkeypatch.chdir("/")
    planned = plan(read(tmp_path / "sweep.toml"))
    rows = [{"status": "OK"}] * 4
    peak = fragility_of(FragilityRequest("peak_acceleration"), planned, rows)
    assert peak.intensity == pytest.approx([1.0, 2.0, 3.0, 6.0], rel=1e-3) and peak.unit == "m/s^2"
    assert peak.record.tolist() == [1, 1, 0, 0]
    resonant = fragility_of(FragilityRequest("pseudo_acceleration", 1.0), planned, rows)
    assert resonant.intensity / peak.intensity == pytest.approx([7.2] * 4, rel=0.1)  # 4 cycles: 10 (1 - exp(-0.4 pi))
    keys = {run.job.key() for run in planned}
    (tmp_path / "weak.csv").write_text((tmp_path / "strong.csv").read_text())
    assert len(keys & {run.job.key() for run in plan(read(tmp_path / "sweep.toml"))}) == 2


@pytest.mark.parametrize("strong", ["x", "y"])
def test_the_intensity_of_a_motion_along_two_axes_is_that_of_the_stronger_one(strong):
    sines = {axis: f"{0.3 if axis == strong else 0.1} g * sin(2 pi t / 0.5 s)" for axis in "xy"}
    resolved = tomli_w.dumps({"ground": [sines | {"duration": "2 s"}]})
    run = SimpleNamespace(job=SimpleNamespace(resolved=resolved))
    weaker = SimpleNamespace(job=SimpleNamespace(resolved=resolved.replace("0.3 g", "0.1 g")))
    for request in (FragilityRequest("peak_acceleration"), FragilityRequest("pseudo_acceleration", 0.7)):
        (both, one), _ = intensities(request, [run, weaker])
        assert both == pytest.approx(3.0 * one, rel=1e-6)


TABLE = {"intensity": SCALE}


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({}, "intensity: missing"),
        ({"intensity": "ground.scal"}, "did you mean 'ground.scale'"),
        (TABLE | {"period": "1 s"}, "period: goes with"),
        ({"intensity": "pseudo_acceleration"}, "period: goes with"),
        ({"intensity": "pseudo_acceleration", "period": 1.0}, "has no unit"),
        (TABLE | {"limit": 0.1}, "goes with a measure"),
        (TABLE | {"confidence": 90}, "confidence: a number in"),
        (TABLE | {"limt": 0.1}, "did you mean 'limit'"),
    ],
)
def test_wrong_tables_are_one_message(table, words):
    with pytest.raises(SceneError, match=words):
        read_request(table, "sweep.toml: fragility", [SEED, SCALE])


OF_STRESS = 'intensity = "confinement"\n'
TOP = '[[gauge]]\nname = "top"\nat = "units"\ndirection = "x"\n'


@pytest.mark.parametrize(
    ("asks", "words"),
    [
        ('intensty = "confinement"', "intensty: unknown key; .*did you mean 'intensity'"),
        ('intensity = "confinemnt"', "did you mean 'confinement'"),
        ('intensity = "peak_velocity"', "fragility: peak_velocity: the scene has no .ground."),
        ('intensity = "law"', "fragility: law: .*number"),
        (f'{OF_STRESS}measure = "peak_stres"', "no run has 'peak_stres'; .*did you mean 'peak_stress_pa'"),
        (f'{OF_STRESS}measure = "gauges.tpo.final_m"', "gauges.tpo.final_m'; .*did you mean 'gauges.top.final_m'"),
        (f'{OF_STRESS}measure = "shaking.gauges.top.peak_drft"', "did you mean 'shaking.gauges.top.peak_drift'"),
        (f'{OF_STRESS}measure = "shaking.gauges.top.quantity"', "a measure is a number of summary.json"),
        (f'{OF_STRESS}measure = "energy_j.frction"', "did you mean 'energy_j.friction'"),
        (f'{OF_STRESS}measure = "top"', "did you mean 'shaking.gauges.top.peak'"),
        (f'{OF_STRESS}measure = "gauges.top"', "no run has 'gauges.top'"),
        (f'{OF_STRESS}measure = "law"', "no run has 'law'"),
        (f'{OF_STRESS}measure = "peak_stress_pa.top"', "did you mean 'peak_stress_pa'"),
    ],
)
@pytest.mark.parametrize("more", [["--list"], ["--out", "made"]])
def test_what_fragility_asks_for_is_looked_at_before_anything_runs(tmp_path, monkeypatch, capsys, asks, words, more):
    monkeypatch.chdir(tmp_path)
    grid = '[grid]\nconfinement = ["0.1 MPa", "0.2 MPa"]\nlaw = ["brittle", "linear"]\n'
    Path("couplet-with-gauge.toml").write_text(f'base = "couplet"\n{TOP}')
    Path("sweep.toml").write_text(text(f"{grid}[fragility]\n{asks}\n", scene="couplet-with-gauge.toml"))
    assert main(["sweep", "sweep.toml", *more]) == 2
    assert re.search(words, capsys.readouterr().err) and not Path("made").exists()


def test_a_sweep_with_a_fragility_leaves_its_files_and_another_table_runs_nothing_again(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    grid = '[grid]\nconfinement = ["0.1 MPa", "0.2 MPa", "0.3 MPa"]\n"solver.damping" = [0.7, 0.8]\n'
    asks = '[fragility]\nintensity = "confinement"\nmeasure = "peak_stress_pa"\n'
    Path("sweep.toml").write_text(text(grid + asks))
    assert main(["sweep", "sweep.toml", "--out", "out", "--workers", "1"]) == 0
    assert "fragility: 0 of 6 runs fell; no curve: none of 6 runs fell" in capsys.readouterr().out
    Path("sweep.toml").write_text(text(grid + asks + "limit = 1.0\n"))
    assert main(["sweep", "sweep.toml", "--out", "out", "--workers", "1"]) == 0
    said = capsys.readouterr()
    assert "6 of 6 runs are done already" in said.err and "all of 6 runs fell" in said.out
    with Path("out/fragility.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [row["confinement [Pa]"] for row in rows] == ["100000.0", "200000.0", "300000.0"]
    Path("sweep.toml").write_text(text(grid + '[fragility]\nintensity = "confinement"\nmeasure = "peak_stres"\n'))
    assert main(["sweep", "sweep.toml", "--out", "out", "--workers", "1"]) == 2
    said = capsys.readouterr().err
    assert "measure: no run has 'peak_stres'" in said and "did you mean 'peak_stress_pa'" in said
