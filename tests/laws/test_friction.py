"""Law friction: dry joints press and rub, and do nothing else."""

import numpy as np
import pytest

from masonry import scene
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.laboratory.text import summary_text
from masonry.laws.building.contact_properties import ContactProperties
from masonry.laws.building.factory import build
from masonry.laws.mechanism import elastic_trial, return_mapping, stored_energy
from masonry.laws.state import ContactHistory
from masonry.results.frame_choice import choose

KN, KS, MU = 30e9, 12e9, 0.65
GIVEN = {"law": "friction", "normal_stiffness": KN, "shear_stiffness": KS, "tan_friction": MU}
FRESH = ContactHistory(1e-9, 1.0, 1.0, 0.0, None, None, None)


@pytest.fixture(scope="module")
def triplet():
    return laboratory.run(scene.load("triplet-dry"))


def test_the_triplet_slides_on_both_joints_at_the_force_of_coulomb(triplet):
    confined = 0.5e6 * 0.25 * 0.12
    assert triplet.summary["peak_force_n"] == pytest.approx(2 * MU * confined, rel=1e-9)
    assert triplet.summary["final_stress_pa"] == pytest.approx(triplet.summary["peak_stress_pa"], rel=1e-9)
    slid = 1e-3 - MU * 0.5e6 / KS
    assert triplet.energies["friction"] == pytest.approx(2 * MU * confined * slid, rel=1e-6)
    assert triplet.energies["fracture_mode_1"] == triplet.energies["fracture_mode_2"] == 0.0
    assert triplet.summary["kinetic_over_internal_max"] < 0.01 and triplet.summary["damping_over_external"] >= 0.0


def test_the_peak_of_a_plateau_is_where_it_begins(triplet):
    begins = MU * 0.5e6 / KS
    assert triplet.summary["displacement_at_peak_m"] == pytest.approx(begins, rel=0.02)
    rows = triplet.history.rows
    first = rows["displacement"][np.argmax(rows["stress"] >= 0.999 * rows["stress"].max())]
    frame = choose(triplet, "peak").frame
    assert frame.displacement == pytest.approx(first, rel=1e-12)
    assert triplet.summary["reactions"]["peak"]["displacement_m"] == pytest.approx(first, rel=1e-12)


def test_joints_that_slid_are_counted_and_nothing_is_called_undamaged(triplet):
    assert triplet.summary["joints_opened_or_slid"] == 2
    words = summary_text(triplet.summary)
    assert "2 joints opened or slid" in words and "no contact was damaged" not in words


def test_a_section_of_your_own_turns_the_force_into_the_stress_of_both_joints(triplet):
    both = laboratory.run(scene.load("triplet-dry", {"specimen.section": "0.06 m^2"})).summary
    assert both["peak_force_n"] == triplet.summary["peak_force_n"]
    assert both["peak_stress_pa"] == pytest.approx(MU * 0.5e6, rel=1e-9)
    assert "0.325 MPa (force 19.5 kN over a section of 0.06 m2)" in summary_text(both)


def test_a_joint_that_only_sticks_is_neither_opened_nor_slid():
    stuck = laboratory.run(scene.load("triplet-dry", {"drive.displacement": "0.01 mm"}))
    assert stuck.summary["joints_opened_or_slid"] == 0 and "no contact was damaged" in summary_text(stuck.summary)
    assert stuck.energies["friction"] == 0.0


def test_brittle_with_zeros_has_the_same_curve(triplet):
    zeros = {"law": "brittle", "contact.unit_unit.tensile_strength": "0 Pa", "contact.unit_unit.cohesion": "0 Pa"}
    other = laboratory.run(scene.load("triplet-dry", zeros))
    for key in ("peak_force_n", "final_stress_pa"):
        assert triplet.summary[key] == pytest.approx(other.summary[key], rel=1e-9), key
    assert triplet.energies["friction"] == pytest.approx(other.energies["friction"], rel=1e-6)


def test_a_contact_presses_rubs_and_lets_go():
    parameters, joint = build("unit_unit", ContactProperties.of(GIVEN))
    assert elastic_trial(parameters, joint, FRESH, -1e-5, 0.0) == (-3e5, True)
    assert elastic_trial(parameters, joint, FRESH, 1e-5, 0.0) == (0.0, False)
    assert not elastic_trial(parameters, joint, FRESH, -1e-5, (MU * 3e5 * 1.001) ** 2)[1]
    opened = return_mapping(parameters, joint, FRESH, 1e-5, 0.0, 0.0)
    assert (opened.sigma, opened.history.intact_n, opened.history.intact_s) == (0.0, 0.0, 1.0)
    tau = 2.5e5
    slid = return_mapping(parameters, joint, FRESH, -1e-5, tau / KS, tau)
    assert slid.fraction * tau == pytest.approx(MU * 3e5, rel=1e-12) and slid.history.intact_s == 0.0
    assert (slid.mode_1, slid.mode_2) == (0.0, 0.0)
    before, after = (stored_energy(parameters, joint, FRESH, -1e-5, t * t) for t in (tau, slid.fraction * tau))
    excess = (tau - MU * 3e5) ** 2 / (2 * KS)
    assert before - after == pytest.approx(slid.friction + excess, rel=1e-9), "the overshoot of a step is its error"
    assert (
        np.isfinite(stored_energy(parameters, joint, FRESH, 1e-5, 0.0))
        and stored_energy(parameters, joint, FRESH, 1e-5, 0.0) == 0
    )


def test_it_needs_stiffnesses_and_friction_and_reads_no_strength():
    with pytest.raises(SceneError, match="friction_angle"):
        build("unit_unit", ContactProperties.of({**GIVEN, "tan_friction": None}))
    with_strength = {**GIVEN, "tensile_strength": 1e6, "cohesion": 1e6, "dilation_angle": 0.3, "unloading": "elastic"}
    assert build("unit_unit", ContactProperties.of(with_strength)) == build("unit_unit", ContactProperties.of(GIVEN))
