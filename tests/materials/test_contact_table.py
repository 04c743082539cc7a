"""A contact table has the modulus and the strengths that were asked for, names its sources, and fits its scene."""

import math
import tomllib

import pytest

import masonry
from masonry.errors import SceneError
from masonry.laboratory import laboratory
from masonry.materials.eurocode_6 import bending_strength, compressive_strength, shear_strength
from masonry.materials.joint_stiffness import MasonryCourse, course_of_parts, joint_stiffness

STACK = """
law = "elastic"
specimen = {kind = "prism", units = 8, length = "250 mm", width = "115 mm", height = "123 mm"}
material.units = {density = "1900 kg/m^3", young_modulus = "16.7 GPa", poisson_ratio = 0.0}
contact.unit_unit = {normal_stiffness = "1 GPa/m", shear_stiffness = "1 GPa/m"}
contact.within_units = {normal_stiffness = "1 GPa/m", shear_stiffness = "1 GPa/m"}
support = [{on = "bottom", fix = "all"}]
traction = [{on = "top.z+", stress = {z = "-1 MPa"}}]
settle.steps = 4000
gauge = [{name = "shortening", at = "unit 7", direction = "-z", relative_to = "unit 5"}]
"""
CODE = {"unit": "clay", "unit_strength": "20 MPa", "mortar": "M5", "joint": "10 mm"}
MODULI = {"unit_modulus": "16.7 GPa", "mortar_modulus": "2.9 GPa", "joint": "10 mm", "poisson": 0.2}
TRIPLETS = [(p, 0.24e6 + 0.7 * p) for p in (0.2e6, 0.6e6, 1.0e6) for _ in range(3)]


@pytest.fixture
def stack(tmp_path):
    (tmp_path / "stack.toml").write_text(STACK)
    return masonry.load(tmp_path / "stack.toml")


@pytest.mark.parametrize(
    "settings",
    [
        {"kinematics": "rigid"},
        {"specimen.divisions": [1, 1, 4]},
        {"kinematics": "affine"},
        {"kinematics": "affine", "specimen.divisions": [1, 1, 2]},
    ],
)
def test_a_stack_has_the_modulus_that_units_and_mortar_make(stack, settings):
    model = stack.with_(settings)
    table = masonry.contact(model, law="elastic", **{**MODULI, "poisson": 0.0})
    result = masonry.run(model.with_(table))
    modulus = 1e6 * 0.246 / result.summary["gauges"]["shortening"]["final_m"]
    by_hand = 0.123 / (0.113 / 16.7e9 + 0.010 / 2.9e9)
    assert modulus == pytest.approx(by_hand, rel=1e-4)
    assert table.modulus == pytest.approx(by_hand, rel=1e-9)


def test_a_couplet_has_the_shear_strength_of_the_triplets_at_a_pressure():
    table = masonry.contact("couplet", triplets=TRIPLETS, residual_friction=0.6, **MODULI)
    result = masonry.run(masonry.load("couplet", {"confinement": "0.4 MPa"}).with_(table))
    assert result.peak.stress == pytest.approx(0.24e6 + 0.7 * 0.4e6, rel=1e-3)
    assert result.curve["stress"].iloc[-1] == pytest.approx(0.6 * 0.4e6, rel=0.05)


@pytest.mark.parametrize("name", ["couplet", "wallette-mode-1", "wallette-mode-2", "bending-0", "shear-wall"])
def test_a_packaged_scene_with_a_table_of_the_code_passes_the_check(name):
    scene = masonry.load(name)
    joint = {} if getattr(scene.specimen, "joint_thickness", 0.0) else {"joint": "10 mm"}
    if getattr(scene.specimen, "cells", None):
        joint["divisions"] = 2
    data = {key: value for key, value in CODE.items() if key != "joint"}
    table = masonry.contact(scene, unit_modulus="16.7 GPa", law="exponential", **data, **joint)
    assert laboratory.check(scene.with_(table))["warnings"] == []


@pytest.mark.parametrize("law", ["exponential", "linear", "brittle", "elastic", "friction"])
def test_the_text_of_a_table_is_that_of_a_scene_with_a_source_for_each_number(law):
    table = masonry.contact(unit_height="65 mm", law=law, **CODE)
    read = tomllib.loads(str(table))
    assert read == table.tables
    numbers = [key for key in read["contact"]["unit_unit"] if key not in ("law", "crushing")]
    assert list(read["assumptions"]) == [f"contact.unit_unit.{key}" for key in numbers]
    assert masonry.load("couplet").with_(table).contact["unit_unit"].law == law


@pytest.mark.parametrize("crushing", ["cap", "cut-off"])
def test_crushing_of_the_code_is_read_by_a_scene(crushing):
    joint = masonry.load("couplet").with_(masonry.contact("couplet", crushing=crushing, **CODE)).contact["unit_unit"]
    mean = 1.2 * 0.55 * 20**0.7 * 5**0.3 * 1e6
    assert joint.crushing == crushing
    assert joint.compressive_strength == pytest.approx(mean, rel=1e-5)
    assert joint.fracture_energy_compression == pytest.approx(1.6e-3 * mean, rel=1e-5)


def test_ranges_hold_the_values_and_are_those_of_keys_of_the_scene():
    table = masonry.contact("couplet", **CODE)
    scene = masonry.load("couplet").with_(table)
    for key, (low, high) in table.ranges.items():
        value = getattr(scene.contact["unit_unit"], key.rpartition(".")[2])
        assert low * (1 - 1e-5) <= value <= high * (1 + 1e-5), key


def test_a_sweep_varies_what_has_a_range_and_every_sample_is_a_scene(tmp_path):
    table = masonry.contact("couplet", **CODE)
    scene = masonry.load("couplet", {"drive.accuracy": "10 %"}).with_(table)
    sweep = masonry.sweep(scene, table.hypercube(samples=4), tmp_path / "sweep", workers=0)
    assert len(sweep.rows) == 4 and {row["status"] for row in sweep.rows} == {"OK"}
    peaks = [row["peak_stress_pa"] for row in sweep.rows]
    assert min(peaks) > 0.2e6 + 0.4 * 0.5e6 and max(peaks) < 0.5e6 + 0.8 * 0.5e6


def test_a_whole_table_that_is_set_takes_the_assumptions_about_the_old_one_with_it():
    scene = masonry.load("couplet")
    assert "contact.unit_unit.tensile_strength" in scene.assumptions
    friction = scene.with_(masonry.contact(scene, mortar="none", friction=0.6, unit_modulus="10 GPa"))
    mine = [key for key in friction.assumptions if key.startswith("contact.unit_unit.")]
    assert sorted(mine) == [
        f"contact.unit_unit.{key}" for key in ("normal_stiffness", "shear_stiffness", "tan_friction_angle")
    ]


def test_means_and_characteristic_values_stand_beside_each_other():
    mean = masonry.contact(unit_height="65 mm", **CODE)["contact.unit_unit"]
    low = masonry.contact(unit_height="65 mm", strengths="characteristic", **CODE)["contact.unit_unit"]
    assert (mean["cohesion"], low["cohesion"]) == ("0.25 MPa", "0.2 MPa")
    assert (mean["tan_friction_angle"], low["tan_friction_angle"]) == (0.5, 0.4)
    text = str(masonry.contact(unit_height="65 mm", **CODE))
    assert 'cohesion = "0.25 MPa"' in text and "characteristic 0.2 MPa" in text
    own = masonry.contact(unit_height="65 mm", cohesion="0.2 MPa", basis="characteristic", **CODE)
    assert own["contact.unit_unit"]["cohesion"] == "0.25 MPa"


def test_the_line_through_triplets_is_found_and_its_scatter_is_the_range():
    noise = (0.02e6, -0.02e6, 0.0)
    tests = [(p, 0.24e6 + 0.7 * p + off) for p in (0.2e6, 0.6e6, 1.0e6) for off in noise]
    table = masonry.contact("couplet", triplets=tests, **MODULI)
    joint = table["contact.unit_unit"]
    assert joint["cohesion"] == "0.24 MPa" and joint["tan_friction_angle"] == pytest.approx(0.7)
    variance = 6 * 0.02**2 / 7
    by_hand = 2 * math.sqrt(variance * (1 / 9 + 0.6**2 / (9 * 0.32 / 3)))
    low, high = table.ranges["contact.unit_unit.cohesion"]
    assert (high - low) / 2e6 == pytest.approx(max(by_hand, 0.024), rel=1e-6)


def test_tension_beyond_the_apex_of_the_coulomb_line_is_cut_and_said():
    table = masonry.contact("couplet", cohesion="0.2 MPa", friction=0.8, tensile_strength="0.4 MPa", **MODULI)
    assert table["contact.unit_unit"]["tensile_strength"] == "0.25 MPa"
    assert any("apex" in note for note in table.notes)


def test_mortar_as_stiff_as_units_is_said_and_the_stack_is_nearly_as_stiff_as_they_are():
    hard = {**MODULI, "mortar_modulus": "20 GPa"}
    table = masonry.contact(unit_height="113 mm", kinematics="affine", law="elastic", **hard)
    assert any("nothing for a joint" in note for note in table.notes)
    assert table.modulus == pytest.approx(16.7e9 / 1.1)
    assert masonry.contact(unit_height="113 mm", law="elastic", **hard).modulus > 16.7e9, "rigid units take it all"


def test_energies_too_small_for_a_linear_law_are_refused_with_the_least_one():
    with pytest.raises(SceneError, match=r"must be above .* snap back"):
        masonry.contact(
            unit_height="65 mm",
            law="linear",
            cohesion="3 MPa",
            bond_strength="4 MPa",
            fracture_energy_mode_1="0.5 N/m",
            **MODULI,
        )


@pytest.mark.parametrize(
    ("divisions", "deforms", "bed"),
    [(1, False, 97.8977e9), (4, False, 213.2e9), (1, True, 350.92e9)],
)
def test_the_stiffnesses_of_the_page_come_out(divisions, deforms, bed):
    course = course_of_parts(0.113, 0.010, 16.7e9, 2.9e9)
    joint = joint_stiffness(course, divisions, deforms)
    assert joint.bed == pytest.approx(bed, rel=1e-3)
    assert joint.modulus(course, divisions, deforms) == pytest.approx(course.modulus, rel=1e-12)


@pytest.mark.parametrize("law", ["exponential", "linear", "brittle"])
def test_a_joint_without_cohesion_or_tension_is_a_table_that_runs(law):
    table = masonry.contact("couplet", cohesion="0 MPa", friction=0.7, law=law, **MODULI)
    result = masonry.run(masonry.load("couplet", {"confinement": "0.4 MPa"}).with_(table))
    assert result.peak.stress == pytest.approx(0.7 * 0.4e6, rel=2e-3)
    assert all(low > 0.0 or not key.endswith(("mode_1", "mode_2")) for key, (low, _) in table.ranges.items())


def test_mortar_in_a_dry_scene_makes_joints_that_bond_and_a_dry_scene_stays_dry_without():
    bonded = masonry.contact("wall-with-window", **CODE)
    assert bonded.law == "exponential" and "cohesion" in bonded["contact.unit_unit"]
    assert masonry.contact("wall-tilted", unit_modulus="20 GPa", mortar="none", friction=0.6).law == "friction"


def test_a_scene_whose_default_table_serves_all_contacts_takes_the_table():
    table = masonry.contact("rubble-pile", **CODE)
    assert masonry.load("rubble-pile").with_(table).contact["unit_unit"].cohesion == 0.25e6


def test_a_large_displacement_scene_with_a_table_bears_what_its_joint_bears():
    scene = masonry.load("couplet-slid-off")
    table = masonry.contact(scene, cohesion="0.1 MPa", friction=0.6, **MODULI)
    assert laboratory.check(scene.with_(table))["warnings"] == laboratory.check(scene)["warnings"]


def test_masonry_stiffer_than_its_divided_units_is_bounded():
    joint = joint_stiffness(MasonryCourse(0.1, 0.1 / 30e9, 10e9), 4)
    assert joint.is_bounded and joint.bed == pytest.approx(10 * 10e9 / 0.1)


@pytest.mark.parametrize(
    ("strength", "value"),
    [
        (compressive_strength("clay", 1, 20e6, 5e6), 0.55 * 20**0.7 * 5**0.3),
        (compressive_strength("clay", 2, 15e6, 10e6), 0.45 * 15**0.7 * 10**0.3),
        (compressive_strength("clay", 1, 10e6, 50e6), 0.55 * 10**0.7 * 20**0.3),
        (compressive_strength("clay", 3, 10e6, None), 0.50 * 10**0.7),
        (compressive_strength("calcium-silicate", 2, 20e6, None), 0.65 * 20**0.85),
        (compressive_strength("aac", 1, 4e6, None), 0.80 * 4**0.85),
        (shear_strength("clay", 10e6), 0.30),
        (shear_strength("clay", 9e6), 0.20),
        (shear_strength("natural-stone", 2e6), 0.10),
        (shear_strength("calcium-silicate", None), 0.40),
        (bending_strength("clay", 2.5e6), 0.10),
        (bending_strength("concrete", 2.5e6), 0.05),
        (bending_strength("aac", None), 0.15),
    ],
)
def test_numbers_of_the_code(strength, value):
    assert strength.value == pytest.approx(value * 1e6, rel=1e-12)


def test_what_the_tables_leave_out_is_no_number():
    assert compressive_strength("aac", 2, 4e6, 5e6) is None
    assert shear_strength("clay", 0.5e6) is None
    assert bending_strength("manufactured-stone", None) is None


def test_strengths_that_a_dry_joint_leaves_out_are_noted():
    known = {"unit_modulus": "10 GPa", "unit_height": "200 mm", "mortar": "none", "friction": 0.6}
    assert not any("leaves out" in note for note in masonry.contact(**known).notes)
    (note,) = (note for note in masonry.contact(**known, cohesion="0.2 MPa").notes if "leaves out" in note)
    assert "a cohesion of 0.2 MPa" in note


@pytest.mark.parametrize(("joint", "noted"), [("3 mm", False), ("10 mm", True)])
def test_thin_layer_mortar_in_thick_joints_is_noted(joint, noted):
    table = masonry.contact(unit="clay", unit_strength="20 MPa", unit_height="65 mm", mortar="thin-layer", joint=joint)
    assert any("thin layer mortar has joints of 0.5 to 3 mm" in note for note in table.notes) is noted


def test_pairs_of_numbers_in_mpa_are_questioned():
    with pytest.raises(SceneError, match="numbers are in Pa: write '0.41 MPa'"):
        masonry.contact("couplet", triplets=[(0.2, 0.41), (0.6, 0.7), (1.0, 0.95)], **CODE)
