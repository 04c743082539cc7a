"""Cycles take no more of mode II than the law has, and numbers that cannot do what they say are remarked."""

import re

import pytest

from masonry import scene
from masonry.assembly.assemble import assemble
from masonry.judgement.judgement import judge
from masonry.judgement.sentence import trust
from masonry.laboratory import laboratory
from masonry.monitors.mode_2_area import area
from verification.fixtures.one_contact import law
from verification.references.closed_forms import Joint, shear_area

JOINT = "contact.unit_unit."


@pytest.mark.parametrize("variable", [None, "displacement"])
def test_cycles_of_a_couplet_take_what_the_law_has(variable):
    over = {} if variable is None else {JOINT + "softening_variable": variable}
    summary = laboratory.run(scene.load("couplet-cyclic", over)).summary
    elastic = 0.5 * (0.87e6 + 0.28 * 0.5e6) ** 2 / 70e9 if variable else 0.0
    wanted = 123.0 * (0.87 + 0.28 * 0.5) / 0.87 + elastic
    assert summary["energy_j"]["fracture_mode_2"] / summary["section_m2"] == pytest.approx(wanted, rel=0.02)
    assert summary["mode_2_over_law"] == pytest.approx(1.0, abs=0.02)
    assert "mode II" not in trust(summary)
    assert "1.1 times the energy of mode II" in judge({**summary, "mode_2_over_law": 1.1}).doubts[0].sentence


def test_only_a_scene_that_turns_back_and_names_no_variable_softens_over_plastic_slip():
    def plastic(name, over=None):
        return assemble(scene.load(name, over or {})).model.groups.properties[0].plastic_softening is not None

    assert plastic("couplet-cyclic") and not plastic("couplet")
    assert not plastic("couplet-cyclic", {JOINT + "softening_variable": "displacement"})
    assert not scene.load("couplet").turns_back


@pytest.mark.parametrize("name", ["brittle", "linear", "polynomial", "exponential"])
@pytest.mark.parametrize("compression", [0.0, 1e6])
def test_the_area_of_a_law_is_that_of_its_closed_form(name, compression):
    assert area(*law(name), compression) == pytest.approx(shear_area(name, Joint(), compression), rel=2e-3)


@pytest.mark.parametrize(
    ("over", "said"),
    [
        ({"tensile_strength": "0.9 MPa"}, "beyond the apex of the Coulomb line.* = 861386 Pa"),
        ({"tensile_strength": "1 Pa"}, "less than 1e-5 of the cohesion of 870000 Pa: it is taken as 0"),
        ({"tensile_strength": "12 Pa"}, "over an opening of 0.483 m, more than a block"),
        (
            {"dilation_angle": "2 deg", "fracture_energy_mode_2": "1e6 N/m"},
            "dilation does not end within the drive's 1 mm",
        ),
        ({"dilation_angle": "2 deg"}, None),
        ({"law": "friction", "dilation_angle": "2 deg"}, "law 'friction' does not dilate"),
    ],
)
def test_a_number_that_cannot_do_what_it_says_is_remarked(over, said):
    report = laboratory.check(scene.load("couplet", {JOINT + key: value for key, value in over.items()}))["warnings"]
    if said is None:
        assert not report
    else:
        assert len(report) == 1 and re.search(said, report[0])


def test_a_joint_that_dilates_beyond_the_skin_is_remarked_in_large_displacement_alone():
    over = {JOINT + "law": "brittle", JOINT + "dilation_angle": "2 deg", JOINT + "dilation_cutoff": "5 mm"}
    assert not laboratory.check(scene.load("couplet", over))["warnings"]
    (found,) = laboratory.check(scene.load("couplet", {**over, "displacements": "large"}))["warnings"]
    assert "have slid 1.59 mm are detected anew, and dilate no more" in found
    within = {**over, JOINT + "dilation_cutoff": "1 mm", "displacements": "large"}
    assert not laboratory.check(scene.load("couplet", within))["warnings"]
