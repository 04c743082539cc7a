"""A joint with strength in large displacement: the curve of small displacement, as long as blocks hardly turn."""

from functools import cache

import numpy as np
import pytest

from masonry import scene
from masonry.configuration import large
from masonry.laboratory import laboratory

BASE = {"drive.displacement": "0.4 mm", "settle.steps": 3000, "specimen.contact_points": "vertex"}
BASE |= {"specimen.points_per_edge": 2}
PACES = {
    "steps": {"drive.accuracy": None, "drive.steps": 12000},
    "accuracy": {"drive.accuracy": "5 %"},
}
SHARED = ("displacement", "stress", "elastic_contacts", "fracture_mode_1", "fracture_mode_2", "friction")


@cache
def couplet(pace: str, **settings):
    return laboratory.run(scene.load("couplet", BASE | PACES[pace] | settings))


@pytest.mark.parametrize("pace", [pytest.param("steps", marks=pytest.mark.slow), "accuracy"])
def test_the_curve_is_that_of_small_displacement(pace):
    small, large = couplet(pace), couplet(pace, displacements="large")
    assert small.summary["peak_stress_pa"] == pytest.approx(1.375e6, rel=2e-3)
    for key in SHARED:
        one, other = (run.history.rows[key][run.history.rows["step"] > BASE["settle.steps"]] for run in (small, large))
        assert other == pytest.approx(one, rel=0, abs=1e-6 * np.abs(one).max()), key
    for key in ("peak_stress_pa", "displacement_at_peak_m", "final_stress_pa"):
        assert large.summary[key] == pytest.approx(small.summary[key], rel=1e-9)
    assert large.summary["energy_imbalance"] < 1e-12
    assert large.summary["dissipation_mismatch"] < 1e-6
    for line in ("rotor", "dashpot", "redetection", "area"):
        assert abs(large.history.rows[line]).max() < 1e-9 * large.history.rows["fracture_mode_2"].max()
        assert line not in small.history.rows


def test_what_patches_bear_once_the_bonds_are_gone_is_not_held_against_the_peak_of_the_bonds():
    """`damping took 70 % of the force at the peak`: what is left bears 70 % less."""
    loosened = {"drive.displacement": "1 mm", "confinement": "0.3 MPa", "law": "linear"}
    result = laboratory.run(scene.load("couplet", BASE | loosened | {"displacements": "large"}))
    assert result.summary["peak_stress_pa"] == pytest.approx(0.87e6 + 1.01 * 0.3e6, rel=1e-3)
    assert result.summary["final_stress_pa"] == pytest.approx(0.73 * 0.3e6, rel=1e-6)
    assert result.summary["control"]["drag_at_peak"] < 1e-6
    assert result.verdict == "sound", result.doubts


def test_the_word_small_changes_no_bit():
    plain, said = couplet("steps").history.rows, couplet("steps", displacements="small").history.rows
    assert plain.keys() == said.keys()
    assert all(plain[key].tobytes() == said[key].tobytes() for key in plain)


def test_small_displacement_calls_nothing_of_large_displacement(monkeypatch):
    def refuse(*_):
        raise AssertionError("compiled for large displacement only")

    for module, name in ((large, "step"), (large, "Patches"), (large, "BearingPoints")):
        monkeypatch.setattr(module, name, refuse)
    again = laboratory.run(scene.load("couplet", BASE | PACES["steps"])).history.rows
    assert again["stress"].tobytes() == couplet("steps").history.rows["stress"].tobytes()
    with pytest.raises(AssertionError, match="large displacement only"):
        laboratory.run(scene.load("couplet", BASE | PACES["steps"] | {"displacements": "large"}))


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["affine", "tets"])
def test_units_that_deform_give_the_curve_of_small_displacement_within_their_strains(kind):
    small, large = (couplet("steps", kinematics=kind, displacements=word) for word in ("small", "large"))
    strain = abs(large.history.frames[-1].stress).max() / 16.7e9
    assert 1e-6 < strain < 1e-3
    for key in (*SHARED, "elastic_blocks"):
        one, other = (run.history.rows[key][run.history.rows["step"] > BASE["settle.steps"]] for run in (small, large))
        assert other == pytest.approx(one, rel=0, abs=5.0 * strain * np.abs(one).max()), key
    for key in ("peak_stress_pa", "displacement_at_peak_m", "final_stress_pa"):
        assert large.summary[key] == pytest.approx(small.summary[key], rel=5.0 * strain), key
    assert large.summary["energy_imbalance"] < 1e-12
    assert large.summary["dissipation_mismatch"] < 1e-5
