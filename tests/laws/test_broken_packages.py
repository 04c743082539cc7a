"""A package with a mistake in its law: one message that names the package, and no other scene is disturbed."""

import re

import pytest

from masonry.cli.main import main
from masonry.errors import SceneError
from masonry.scene import load
from masonry.simd import PLAIN
from tests.laws.own_package import files_of_page, install, law_with_if, on_the_path
from verification.fixtures.one_contact import along, law, walk

KNEE = {"contact.unit_unit.opening_at_knee": "8 um", "contact.unit_unit.share_at_knee": 0.3}
GOOD = files_of_page()["bilinear.py"]
BROKEN = {
    "an import that fails": (
        "from typing",
        "import numbat\nfrom typing",
        "ModuleNotFoundError: No module named 'numbat'",
    ),
    "an error on import": (
        "EXAMPLE =",
        "1 / 0\nEXAMPLE =",
        "ZeroDivisionError: division by zero (.*bilinear.py, line 1",
    ),
    "a leaving": ("EXAMPLE =", "raise SystemExit(3)\nEXAMPLE =", "cannot be loaded: SystemExit"),
    "bad syntax": ("def left(", "def left((", "SyntaxError"),
    "no curve of shear": (
        "def shear_intact",
        "def sheared",
        "has no function shear_intact(parameters, joint, intact, slip",
    ),
    "another order": (
        "def tension_intact(parameters, joint, opening",
        "def tension_intact(joint, parameters, opening",
        "tension_intact(joint, parameters, opening) must be tension_intact(parameters, joint, opening), in this order",
    ),
    "a word too few": (
        "def tension_area(parameters, joint, opening, intact",
        "def tension_area(parameters, joint, opening",
        "tension_area(parameters, joint, opening) must be tension_area(parameters, joint, opening, intact)",
    ),
    "no table": ("PARAMETERS =", "PARAMETER =", "must have a table PARAMETERS"),
    "no field": (
        '"share": "share_at_knee"}',
        '"part": "share_at_knee"}',
        "'part' of PARAMETERS is no field of Bilinear",
    ),
    "no key": ("KEYS = {", 'KEYS = {"toughness": "stress", ', "'toughness' of KEYS is the key of no parameter"),
    "no tuple": ("class Bilinear(NamedTuple)", "class Bilinear", "must define one NamedTuple of parameters, not 0"),
    "no such kind": (
        '"length (0, 1)"',
        '"lenght"',
        "'lenght' of 'opening_at_knee' is no kind .* did you mean 'length'",
    ),
    "no interval": ('"length (0, 1)"', '"length (0, 1"', "is no interval"),
    "no such property": ('"fracture_energy_mode_2"', '"toughness"', "no contact has the key 'toughness'"),
}


def with_bilinear(text: str) -> dict[str, str]:
    return {**files_of_page(), "bilinear.py": text}


def pattern(said: str) -> str:
    """A regular expression: `.*` stands for any words, all else for itself."""
    return re.escape(said).replace(r"\.\*", ".*")


@pytest.mark.parametrize("mistake", BROKEN)
def test_a_mistake_is_told_in_one_line_that_names_the_package(mistake, tmp_path, capsys):
    old, new, said = BROKEN[mistake]
    assert old in GOOD
    with on_the_path(install(tmp_path / "broken", with_bilinear(GOOD.replace(old, new, 1)))):
        with pytest.raises(SceneError, match=pattern(said)) as told:
            load("couplet", {"law": "bilinear", **KNEE})
        assert "law 'bilinear' of my-masonry 0.1" in str(told.value)
        assert len(str(told.value).splitlines()) == 1
        load("couplet")
        assert main(["check", "couplet", "--set", "law=bilinear"]) == 2
    said = capsys.readouterr()
    assert "Traceback" not in said.err and said.out == ""


def test_a_curve_that_cannot_be_compiled_is_named(tmp_path):
    files = with_bilinear(GOOD.replace("fT, un0 =", "print(open('x'))\n    fT, un0 =", 1))
    with on_the_path(install(tmp_path / "broken", files)):
        wrong = law("bilinear", opening_at_knee=8e-6, share_at_knee=0.3)
        with pytest.raises(SceneError, match="bilinear.tension_area cannot be compiled by Numba: .*open"):
            walk(wrong, along([(0.0, 0.0, 0.0), (0.0, 0.0, 9e-6)], 1e-6))


@pytest.mark.skipif(PLAIN, reason="single numbers have no lanes")
def test_a_law_with_an_if_that_asks_for_lanes_is_told_why_it_cannot_have_them(tmp_path):
    files = with_bilinear(law_with_if() + "\nLANES = True\n")
    with on_the_path(install(tmp_path / "lanes", files)):
        wrong = law("bilinear", opening_at_knee=8e-6, share_at_knee=0.3)
        said = r"bilinear.tension_\w+ cannot be compiled by Numba for lanes \(LANES = True\), which have no `if`"
        with pytest.raises(SceneError, match=said):
            walk(wrong, along([(0.0, 0.0, 0.0), (0.0, 0.0, 9e-6)], 1e-6))


def test_two_packages_with_one_name_are_both_named_and_stop_only_who_asks(tmp_path):
    one = install(tmp_path / "one", name="one-masonry")
    other = install(tmp_path / "other", name="other-masonry")
    with on_the_path(one, other):
        with pytest.raises(SceneError, match="law 'bilinear' is brought by one-masonry 0.1 and other-masonry 0.1"):
            load("couplet", {"law": "bilinear", **KNEE})
        load("couplet", {"law": "linear"})


def test_a_law_with_the_name_of_one_of_ours_is_not_used_and_the_list_says_so(tmp_path, capsys):
    files = files_of_page()
    files["pyproject.toml"] = files["pyproject.toml"].replace("\nbilinear =", "\nlinear =", 1)
    with on_the_path(install(tmp_path / "same", files)):
        assert law("linear")[0].__class__.__module__ == "masonry.laws.linear"
        assert main(["law"]) == 0
    lines = [line for line in capsys.readouterr().out.splitlines() if line.startswith("linear ")]
    assert len(lines) == 2 and "my-masonry 0.1" in lines[1] and "not used: masonry has a law of this name" in lines[1]
