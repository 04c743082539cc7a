"""Runs with a vehicle that stands somewhere: what supports bear of it, when it falls, and a run that is resumed."""

import signal

import pytest

import masonry
from masonry.cli.main import main
from masonry.scene import load
from tests.faults.samples import ended_after, resume

BRIDGE = "bridge-single-span"
TRUCK = {"vehicle.axles": ["20 kN", "30 kN"], "vehicle.spacings": ["1.5 m"], "vehicle.direction": "-x"}
THERE = {"vehicle.position": "0.4 m"}


def held(result, what: str, axis: int) -> float:
    """Force or moment of both supports together, with all of the load."""
    return sum(result.summary["reactions"]["end"][f"support.{k}"][what][axis] for k in range(2))


@pytest.mark.parametrize(
    "more",
    [
        {},
        {"kinematics": "affine", "material.units.young_modulus": "20 GPa", "material.units.poisson_ratio": 0.2},
        pytest.param({"displacements": "large"}, marks=pytest.mark.slow),
    ],
    ids=["rigid", "affine", "large"],
)
def test_supports_bear_the_axles_where_they_stand(more):
    whole = {"limit.accuracy": "1 %", "limit.up_to": 1.0}
    truck = masonry.run(load(BRIDGE, more | TRUCK | THERE | whole))
    none = masonry.run(load(BRIDGE, more | {"vehicle": None, "limit": None, "assumptions": {}}))
    assert truck.summary["collapse_load"]["borne"] == 1.0
    assert held(truck, "force_n", 2) - held(none, "force_n", 2) == pytest.approx(50e3, rel=2e-3)
    moment = 20e3 * (0.4 - 0.75) + 30e3 * (0.4 + 0.75)  # about y, of forces down
    assert held(truck, "moment_nm", 1) - held(none, "moment_nm", 1) == pytest.approx(-moment, rel=1e-2)
    assert truck.summary["energy_imbalance"] < 1e-12


def test_a_run_at_the_worst_place_encloses_the_factor():
    bound = masonry.limit(load(BRIDGE, {"vehicle.between": ["1.4 m", "1.6 m"]}))
    place = {"vehicle.position": f"{bound.scene.vehicle.position!r} m", "limit.accuracy": "1 %"}
    run = masonry.run(load(BRIDGE, place))
    collapse = run.summary["collapse_load"]
    assert collapse["borne"] <= bound.factor * 1.001 and bound.factor <= collapse["falls"]
    assert run.verdict == "sound" and collapse["undecided"] == 0
    words = [text.get_text() for axes in run.picture().axes for text in (axes.title, *axes.texts)]
    last = run.history.rows["load_factor"][-1]
    assert any(f"load factor {last:.4g}" in text for text in words) and f"{100 * last:.4g} kN" in words


def test_a_run_with_a_vehicle_that_was_ended_goes_on_as_if_it_had_not(tmp_path, monkeypatch):
    words = ["--set", "vehicle.position=1.3 m", "--set", "limit.accuracy=1 %", "--quiet", "--out"]
    assert main(["run", BRIDGE, *words, str(tmp_path / "whole")]) == 0
    with ended_after(30, signal.SIGTERM, monkeypatch):
        assert main(["run", BRIDGE, *words, str(tmp_path / "ended")]) != 0
    assert resume(tmp_path / "ended") == 0
    curves = [(tmp_path / name / "curve.csv").read_text() for name in ("whole", "ended")]
    assert curves[0] == curves[1]
