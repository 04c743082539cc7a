"""From properties to a law: what is refused, and that the least value named in a refusal is indeed the least."""

import re
from math import atan, inf, log, pi

import pytest

from masonry.errors import SceneError
from masonry.laws import law_names
from masonry.laws.building.contact_properties import ContactProperties
from masonry.laws.building.factory import build
from verification.fixtures.one_contact import TABLE_1, along, law, walk

ENERGIES = {
    "linear": ["fracture_energy_mode_1", "fracture_energy_mode_2"],
    "exponential": ["fracture_energy_mode_1", "fracture_energy_mode_2"],
    "polynomial": ["fracture_energy_mode_1", "fracture_energy_mode_2", "exponent_tension", "exponent_shear"],
}


def least_of(message: str) -> float:
    match = re.search(r"above ([-+.\de]+?)(?:[ ;]|$)", message)
    assert match, message
    return float(match[1])


def table_1(law: str, **changes) -> ContactProperties:
    """The properties of Table 1 with a law, some of them changed."""
    return ContactProperties.of({"law": law, **TABLE_1, **changes})


def refusal(name, compressions=(0.0,), **changes) -> str:
    with pytest.raises(SceneError) as refused:
        build("unit_unit", table_1(name, **changes), compressions)
    message = str(refused.value)
    assert message.startswith("contact.unit_unit")
    return message


def test_the_laws_are_found_in_their_folder():
    assert law_names() == ("brittle", "elastic", "exponential", "friction", "linear", "polynomial")


@pytest.mark.parametrize("missing", ["tensile_strength", "cohesion", "tan_friction"])
@pytest.mark.parametrize("name", ["brittle", "linear", "polynomial", "exponential"])
def test_a_missing_strength_is_named(name, missing):
    message = refusal(name, **{missing: None})
    assert f"law '{name}' needs {'friction_angle' if missing == 'tan_friction' else missing}" in message
    assert "elastic" in message


@pytest.mark.parametrize(("name", "missing"), [(n, key) for n, keys in ENERGIES.items() for key in keys])
def test_a_missing_energy_or_exponent_is_named(name, missing):
    for dilates in ({}, {"dilation_angle": 0.1}):
        assert f"needs {missing}" in refusal(name, **{missing: None}, **dilates)


@pytest.mark.parametrize(("name", "key"), [(n, key) for n, keys in ENERGIES.items() for key in keys])
@pytest.mark.parametrize("value", [0.0, -1.0])
def test_an_energy_or_exponent_that_is_not_positive_is_refused(name, key, value):
    for dilates in ({}, {"dilation_angle": 0.1}):
        assert f"contact.unit_unit.{key}" in refusal(name, **{key: value}, **dilates)


def test_brittle_and_elastic_need_no_energy():
    bare = {key: value for key, value in TABLE_1.items() if "energy" not in key and "exponent" not in key}
    build("unit_unit", ContactProperties.of({"law": "brittle", **bare}))
    build("unit_unit", ContactProperties.of({"law": "elastic", "normal_stiffness": 1e9, "shear_stiffness": 0.0}))


def test_snap_back_in_tension_is_refused_up_to_the_least_energy_and_runs_just_above():
    least = 0.58e6**2 / (2 * 150e9)
    assert least_of(refusal("linear", fracture_energy_mode_1=least * 0.5)) == pytest.approx(least, rel=1e-5)
    assert "fracture_energy_mode_1" in refusal("linear", fracture_energy_mode_1=least * (1 - 1e-9))
    assert "fracture_energy_mode_1" in refusal("linear", fracture_energy_mode_1=least)
    trace = walk(law("linear", fracture_energy_mode_1=least * (1 + 1e-6)), along([(0, 0, 0), (0, 0, 10e-6)], 0.01e-6))
    assert trace.sigma.max() <= 0.58e6 * (1 + 1e-12)


@pytest.mark.parametrize("compression", [0.0, 0.1e6, 1.0e6])
@pytest.mark.parametrize("slope", [None, 1e-6])
def test_snap_back_in_shear_is_refused_up_to_the_least_energy_at_that_compression(compression, slope):
    drop = 0.87e6 + compression * (1.01 - 0.73)
    least = drop**2 / (2 * 70e9) - (slope or 0.0) * compression
    for given in (least * 0.5, least * (1 - 1e-9)):
        message = refusal("linear", [compression], fracture_energy_mode_2=given, fracture_energy_mode_2_slope=slope)
        assert "fracture_energy_mode_2 " in message
        assert least_of(message) == pytest.approx(least, rel=1e-5)
        assert f"{compression:g} Pa" in message
    numbers = {"fracture_energy_mode_2": least * (1 + 1e-6), "fracture_energy_mode_2_slope": slope}
    build("unit_unit", table_1("linear", **numbers), [compression])


def test_the_least_energy_that_is_named_works_at_every_compression_of_the_scene():
    compressions = (0.0, 0.5e6, 1.0e6)
    changes = {"fracture_energy_mode_2": 1.0, "fracture_energy_mode_2_slope": None}
    least = least_of(refusal("linear", compressions, **changes))
    changes["fracture_energy_mode_2"] = least * (1 + 1e-5)
    build("unit_unit", table_1("linear", **changes), compressions)
    changes["fracture_energy_mode_2"] = least * (1 - 1e-5)
    refusal("linear", compressions, **changes)


def test_nothing_snaps_back_where_nothing_is_lost():
    strong = {"residual_cohesion": 0.87e6, "tan_residual_friction": 1.01, "fracture_energy_mode_2": 1e-9}
    build("unit_unit", table_1("linear", **strong), [0.0, 1e6])
    build("unit_unit", table_1("linear", tensile_strength=0.0, fracture_energy_mode_1=1e-9))


@pytest.mark.parametrize("key", ["exponent_tension", "exponent_shear"])
def test_an_exponent_up_to_1_leaves_an_infinite_energy_and_is_refused(key):
    for value in (0.5, 1.0):
        message = refusal("polynomial", **{key: value})
        assert f"contact.unit_unit.{key}" in message
        assert least_of(message) == 1.0
    build("unit_unit", table_1("polynomial", **{key: 1.0 + 1e-9}))


def test_a_residual_above_the_peak_is_refused():
    for name in ("brittle", "linear", "polynomial", "exponential"):
        assert "residual_cohesion" in refusal(name, residual_cohesion=0.88e6)
        assert "residual_friction_angle" in refusal(name, tan_residual_friction=1.02)
        build("unit_unit", table_1(name, residual_cohesion=0.87e6, tan_residual_friction=1.01))


def test_a_dilation_steeper_than_the_residual_friction_is_refused():
    for name in ("brittle", "linear", "polynomial", "exponential"):
        assert "dilation_angle" in refusal(name, dilation_angle=atan(0.73) + 1e-6)
        build("unit_unit", table_1(name, dilation_angle=atan(0.73) - 1e-9))


@pytest.mark.parametrize(
    ("name", "slip"),
    [
        ("linear", 0.99 * (2 * 58.0 / 0.87e6 - 0.87e6 / 70e9)),
        ("exponential", log(100.0) * 58.0 / 0.87e6),
        ("polynomial", 2 * 58.0 / 0.87e6 * (100.0 ** (1 / 2.5) - 1)),
        ("brittle", 0.0),
    ],
)
def test_dilation_ends_where_the_cohesion_has_gone_unless_the_scene_says_where(name, slip):
    joint = build("unit_unit", table_1(name, fracture_energy_mode_2=58.0, dilation_angle=0.1))[1]
    if name != "brittle":
        assert joint.dilation_cutoff == pytest.approx(slip, rel=1e-12)
    pressed = build("unit_unit", table_1(name, dilation_angle=0.1), (0.0, 1e6))[1]
    energy, peak, drop = 58.0 + 130.0, 0.87e6 + 1.01e6, 0.87e6 + 0.28e6
    wanted = {
        "linear": 0.99 * (2 * energy / drop - drop / 70e9),
        "exponential": log(100.0) * energy / 0.87e6,
        "polynomial": 2 * energy / peak * (100.0 ** (1 / 2.5) - 1),
        "brittle": 0.0,
    }
    assert pressed.dilation_cutoff == pytest.approx(wanted[name], rel=1e-12, abs=1e-17)
    given = build("unit_unit", table_1(name, dilation_angle=0.1, dilation_cutoff=1e-4))[1]
    assert given.dilation_cutoff == 1e-4
    frictional = build("unit_unit", table_1(name, dilation_angle=0.1, cohesion=0.0))[1]
    assert frictional.dilation_cutoff == inf


def test_options_that_are_not_asked_for_are_absent():
    joint = law("linear", coupling="independent")[1]
    absent = ("tan_dilation", "dilation_cutoff", "elastic_unloading", "plastic_softening", "combined")
    assert all(getattr(joint, key) is None for key in absent)
    asked = law("linear", dilation_angle=pi / 90, unloading="elastic", softening_variable="plastic")[1]
    assert all(getattr(asked, key) is not None for key in absent)
