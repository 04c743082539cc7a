"""The law of docs/own-laws.md, as an installed package: its physics, its keys, and what is said of mistakes."""

import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from masonry.drawings.law_portrait import portrait
from masonry.drawings.one_contact import follow
from masonry.errors import SceneError
from masonry.laws.building import entry_points
from masonry.laws.building.contact_properties import ContactProperties
from masonry.laws.building.factory import build
from masonry.scene import load, to_toml
from masonry.sweeps.job import Job
from tests.laws.own_package import files_of_page, install, law_by_slip, law_in_lanes, law_with_if, on_the_path
from tests.laws.test_random_paths import corners, legs, numbers, require_dissipation, unhurried
from verification.fixtures.one_contact import TABLE_1, along, law, walk

KNEE = {"opening_at_knee": 8e-6, "share_at_knee": 0.3}
GIVEN = {"contact.unit_unit.opening_at_knee": "8 um", "contact.unit_unit.share_at_knee": 0.3}
TRIANGLE = 0.5 * 0.58e6**2 / 150e9
AT_PEAK = 0.58e6 / 150e9


@pytest.fixture(scope="module", autouse=True)
def page(tmp_path_factory):
    """The package of the page, and the same law with `if`, in lanes and by the slip alone under other names."""
    files = files_of_page()
    files["bilinear_with_if.py"] = law_with_if()
    files["bilinear_in_lanes.py"] = law_in_lanes()
    files["bilinear_by_slip.py"] = law_by_slip()
    files["other_words.py"] = in_other_words(files["bilinear.py"])
    files["other_words_by_slip.py"] = in_other_words(files["bilinear_by_slip.py"])
    files["weaker.py"] = re.sub(r"parameters\.G_I\b", "(0.8 * parameters.G_I)", files["bilinear.py"])
    more = '\nwith-if = "bilinear_with_if"\nin-lanes = "bilinear_in_lanes"'
    more += '\nby-slip = "bilinear_by_slip"\nweaker = "weaker"'
    more += '\nother-words = "other_words"\nother-words-by-slip = "other_words_by_slip"\nbilinear'
    files["pyproject.toml"] = files["pyproject.toml"].replace("\nbilinear", more, 1)
    folder = install(tmp_path_factory.mktemp("page"), files)
    with on_the_path(folder):
        yield folder


def in_other_words(text: str) -> str:
    """The law of the page with other names for what its functions are given."""
    for word, other in (("parameters", "shape"), ("joint", "interface"), ("intact", "left_before"), ("slip", "s")):
        text = re.sub(rf"\b{word}\b", other, text)
    return text


def own(name: str = "bilinear", **changes) -> tuple:
    return law(name, **{**KNEE, **changes})


def test_the_law_of_the_page_has_no_more_than_30_lines():
    text = files_of_page()["bilinear.py"].partition("from masonry.laws import Refusal")[0]
    assert len(text.strip().splitlines()) <= 30


@pytest.mark.parametrize(
    "law_and_other",
    [("bilinear", "other-words"), pytest.param(("by-slip", "other-words-by-slip"), marks=pytest.mark.slow)],
)
def test_names_of_arguments_are_free(law_and_other):
    path = along([(0.0, 0.0, -2e-6), (60e-6, 0.0, 4e-6), (-20e-6, 0.0, 9e-6), (90e-6, 0.0, 1e-6)], 0.5e-6)
    one, other = (walk(own(name), path) for name in law_and_other)
    for field in ("stress", "dissipated_by_mode", "stored", "intact_n", "intact_s"):
        assert np.array_equal(getattr(one, field), getattr(other, field)), field
    assert one.dissipated_by_mode[-1, :2].min() > 0.0


def test_opening_follows_the_two_lines():
    end = AT_PEAK + (2 * 5.8 / 0.58e6 - 8e-6) / 0.3
    corner = np.array([0.0, AT_PEAK, AT_PEAK + 8e-6, end, 1.2 * end])
    trace = walk(own(), along([(0.0, 0.0, z) for z in corner], 0.1e-6))
    wanted = np.interp(trace.path[:, 2], corner, 0.58e6 * np.array([0.0, 1.0, 0.3, 0.0, 0.0]))
    np.testing.assert_allclose(trace.sigma, wanted, rtol=0, atol=1e-9 * 0.58e6)


@pytest.mark.parametrize("widest", [5e-6, 10e-6, 25e-6, 80e-6])
def test_energy_of_opening_is_the_area_at_any_step(widest):
    trace = walk(own(), along([(0.0, 0.0, 0.0), (0.0, 0.0, widest)], 3.3e-6))
    path = np.linspace(0.0, widest, 200001)
    sigma = np.interp(path, [0.0, AT_PEAK, AT_PEAK + 8e-6, AT_PEAK + 40e-6], 0.58e6 * np.array([0.0, 1.0, 0.3, 0.0]))
    wanted = np.trapezoid(sigma, path) - 0.5 * sigma[-1] * widest
    assert trace.dissipated_by_mode[-1, 0] == pytest.approx(wanted, rel=1e-6)


def test_the_energies_of_the_portrait_are_those_given():
    measured = portrait(*own())
    assert measured.mode_1.beyond == pytest.approx(5.8, rel=1e-4)
    assert measured.mode_1.whole == pytest.approx(5.8 + TRIANGLE, rel=1e-4)
    assert measured.mode_1.booked == pytest.approx(5.8 + TRIANGLE, rel=1e-9)
    for energy in measured.mode_2.values():
        assert energy.beyond == pytest.approx(58.0, rel=1e-4)


@settings(unhurried, max_examples=60)
@given(points=corners(), values=numbers, steps=st.sampled_from([1, 7, 60]), share=st.sampled_from([0.05, 0.3, 0.9]))
def test_dissipation_of_an_own_law_never_decreases_and_strength_never_grows(points, values, steps, share):
    values = {**values, "residual_cohesion": values["residual_cohesion"] * values["cohesion"], "share_at_knee": share}
    require_dissipation(own(**values), legs(points, steps))


def test_two_laws_whose_tuples_have_one_name_are_two_laws_in_compiled_code():
    path = along([(0.0, 0.0, 0.0), (0.0, 0.0, 80e-6)], 3e-6)
    for name, energy in (("bilinear", 5.8), ("weaker", 0.8 * 5.8)):
        assert walk(own(name), path).dissipated_by_mode[-1, 0] == pytest.approx(energy + TRIANGLE, rel=1e-9)


@settings(unhurried, max_examples=20)
@given(points=corners(), steps=st.sampled_from([7, 60]))
@pytest.mark.parametrize("name", ["bilinear", "in-lanes"])
def test_written_with_if_or_for_eight_at_once_or_in_python_a_law_does_the_same(name, points, steps):
    path = legs(points, steps) * (1.0, 0.0, 1.0)
    one, other = walk(own("with-if"), path), walk(own(name), path, ninth=True)
    plain = follow(*own(), path[:, 2], path[:, 0])
    size = np.abs(one.stress).max() + 1.0
    np.testing.assert_allclose(other.stress, one.stress, rtol=0, atol=1e-9 * size)
    np.testing.assert_allclose(plain.sigma, one.sigma, rtol=0, atol=1e-9 * size)
    np.testing.assert_allclose(plain.tau, one.stress[:, 0], rtol=0, atol=1e-9 * size)
    np.testing.assert_allclose(
        plain.fracture,
        one.dissipated_by_mode[:, :2].sum(axis=1),
        rtol=0,
        atol=1e-9 * (1 + one.dissipated_by_mode.max()),
    )


@pytest.mark.parametrize("variable", ["displacement", pytest.param("plastic", marks=pytest.mark.slow)])
@pytest.mark.parametrize("compression", [0.0, 1e6])
def test_a_law_that_knows_its_curve_alone_goes_on_from_the_share_that_is_left(compression, variable):
    """Slid, let go, pressed otherwise, and slid back: as the law that says what is left of a share."""
    z, rest = -compression / 150e9, -0.3e6 / 150e9
    path = along([(0, 0, z), (60e-6, 0, z), (40e-6, 0, z), (40e-6, 0, rest), (90e-6, 0, rest), (-300e-6, 0, rest)])
    whole, alone = (walk(own(name, softening_variable=variable), path) for name in ("bilinear", "by-slip"))
    np.testing.assert_allclose(alone.stress, whole.stress, rtol=0, atol=1e-9 * np.abs(whole.stress).max())
    np.testing.assert_allclose(
        alone.dissipated_by_mode, whole.dissipated_by_mode, rtol=0, atol=1e-9 * whole.dissipated[-1]
    )
    assert whole.intact_s[-1] < 0.2 < whole.intact_s[path[:, 0] >= 60e-6 - 1e-12][0] < 1.0


def test_dilation_ends_where_the_curve_of_the_law_has_lost_the_cohesion():
    joint = own(dilation_angle=0.1)[1]
    end = 58.0 / 0.87e6 * (2.0 - 0.8) / 0.3
    gone = end - 0.01 / 0.3 * (end - 0.8 * 58.0 / 0.87e6)
    assert joint.dilation_cutoff == pytest.approx(gone, rel=1e-5)


def test_the_keys_of_the_law_have_units_and_survive_being_written(tmp_path):
    scene = load("couplet", {"law": "bilinear", **GIVEN})
    assert scene.contact["unit_unit"].opening_at_knee == pytest.approx(8e-6, rel=1e-15)
    file = tmp_path / "couplet.toml"
    file.write_text(to_toml(scene), encoding="utf-8")
    assert load(file) == scene and to_toml(load(file)) == to_toml(scene)


def test_the_keys_of_the_law_do_not_disturb_another_law():
    scene = load("couplet", {"law": "linear", **GIVEN})
    assert build("unit_unit", scene.contact["unit_unit"].properties()) == law("linear", exponent_shear=None)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"opening_at_knee": "8 s"}, "s is a time; opening_at_knee is a length"),
        ({"opening_at_knee": "2 m"}, "opening_at_knee must be in (0, 1)"),
        ({"share_at_knee": 1.0}, "share_at_knee must be in (0, 1)"),
        ({"opening_at_kne": "8 um"}, "unknown key; did you mean 'opening_at_knee'?"),
    ],
)
def test_a_mistake_in_the_keys_of_the_law_is_told_as_any_other(changes, said):
    with pytest.raises(SceneError, match="unit_unit") as refused:
        load("couplet", {"law": "bilinear", **GIVEN, **{f"contact.unit_unit.{key}": v for key, v in changes.items()}})
    assert said in str(refused.value) and len(str(refused.value).splitlines()) == 1


def test_a_key_that_is_missing_or_refused_is_named():
    with pytest.raises(SceneError, match="law 'bilinear' needs opening_at_knee, share_at_knee.*exponential.*bilinear"):
        build("unit_unit", ContactProperties.of({"law": "bilinear", **TABLE_1}))
    with pytest.raises(SceneError, match="fracture_energy_mode_1 = 5.8 .* must be above 11.31 N/m; the area up to"):
        own(opening_at_knee=3e-5)


def test_a_law_that_is_not_there_is_told_with_all_that_are():
    with pytest.raises(SceneError, match="did you mean 'bilinear'.*linear, polynomial, bilinear, .*by-slip.*with-if"):
        load("couplet", {"law": "bilinea"})


def test_a_scene_of_our_own_laws_does_not_look_for_others(monkeypatch):
    def look(group):
        raise AssertionError(f"looked for {group}")

    monkeypatch.setattr("importlib.metadata.entry_points", look)
    entry_points.plugins.cache_clear()
    try:
        Job("wallette-mode-1", {"law": "linear"}).key()
    finally:
        entry_points.plugins.cache_clear()


def test_the_key_of_a_result_changes_with_the_source_of_its_law(tmp_path):
    ours, before = Job("couplet").key(), Job("couplet", {"law": "bilinear", **GIVEN}).key()
    files = files_of_page()
    files["bilinear.py"] += "\n# edited\n"
    with on_the_path(install(tmp_path / "edited", files)):
        assert Job("couplet", {"law": "bilinear", **GIVEN}).key() != before
        assert Job("couplet").key() == ours
