"""Numbers that pages state in a sentence, beside those of the run that the sentence is about."""

import tomllib

import pytest

import masonry
from tests.docs.pages import blocks, pages


def sentence(page: str, words: str) -> None:
    """The page still says so; line breaks aside."""
    assert words in " ".join(pages()[page].read_text(encoding="utf-8").split()), f"{page} says it no more: '{words}'"


def scene_of(page: str, first: str, tmp_path):
    """The block of TOML on a page that holds a word, as a scene."""
    text = next(block.text for block in blocks(page) if block.language == "toml" and first in block.text)
    (tmp_path / "own.toml").write_text(text, encoding="utf-8")
    return masonry.load(tmp_path / "own.toml")


def rounded(value: float, digits: int = 3) -> str:
    return f"{value / 1e6:.{digits}f}"


def test_the_scene_of_the_readme_is_the_couplet_and_gives_what_it_says(tmp_path):
    sentence("README.md", "= 0.87 + 0.5 x 1.01 = 1.375 MPa")
    sentence("README.md", "The run gives 1.374 and 0.366 MPa")
    scene, couplet = scene_of("README.md", "kind = ", tmp_path), masonry.load("couplet")
    result = masonry.run(scene)
    assert rounded(result.peak.stress) == "1.374"
    assert rounded(float(result.history.rows["stress"][-1])) == "0.366"
    assert result.peak.stress == pytest.approx(masonry.run(couplet).peak.stress, rel=1e-12)


def test_every_key_of_the_scene_of_the_readme_stands_in_the_packaged_one(tmp_path):
    text = next(block.text for block in blocks("README.md") if block.language == "toml")
    from masonry.scene.source import packaged

    whole = tomllib.loads(packaged()["couplet"].read_text(encoding="utf-8"))
    part = tomllib.loads(text)
    for table in (part, part["specimen"], part["contact"]["unit_unit"], part["drive"]):
        for key, value in table.items():
            if not isinstance(value, dict | list):
                place = {id(part): whole, id(part["specimen"]): whole["specimen"], id(part["drive"]): whole["drive"]}
                other = place.get(id(table), whole["contact"]["unit_unit"])
                assert other[key] == value, key
    joint = whole["contact"]["unit_unit"]
    unsaid = set(joint) - set(part["contact"]["unit_unit"]) - {"law", "exponent_tension", "exponent_shear"}
    assert {key for key in unsaid if not str(joint[key]).startswith("0")} == set(), "a key that changes the numbers"


def test_the_shipped_accuracy_of_the_couplet_is_what_the_readme_says():
    sentence("README.md", "| the same with the shipped accuracy of 1 %: peak | 0.04 % |")
    peak = masonry.run("couplet").peak.stress
    assert abs(peak / (0.87e6 + 0.5e6 * 1.01) - 1) < 5e-4


def test_the_first_run_of_the_index_is_as_good_as_it_says():
    sentence("docs/index.md", "= 0.87 + 0.1 x 1.01 = 0.971 MPa. The run gives it to 0.2 %.")
    peak = masonry.run(masonry.load("couplet", {"confinement": "0.1 MPa"})).peak.stress
    assert peak == pytest.approx(0.971e6, rel=2e-3)


def test_the_three_blocks_of_the_scene_page_give_what_it_says(tmp_path):
    sentence("docs/scene.md", "peak 0.3 + 0.2 tan 40° = 0.468 MPa, end 0.2 tan 35° = 0.140 MPa. The run gives both.")
    result = masonry.run(scene_of("docs/scene.md", "Shear triplet", tmp_path))
    assert rounded(result.peak.stress) == "0.468"
    assert rounded(float(result.history.rows["stress"][-1])) == "0.140"


def test_the_wall_that_tilts_falls_where_the_pages_say():
    sentence("docs/limit-analysis.md", "load factor 0.642859, at 32.7353 deg")
    assert masonry.limit("wall-tilted").factor == pytest.approx(0.642859, rel=1e-5)


@pytest.mark.slow
def test_the_wallette_has_the_peak_that_the_page_on_speed_says():
    sentence("docs/speed.md", "mode 1 has its peak at 0.167 MPa with rigid units")
    assert rounded(masonry.run("wallette-mode-1").peak.stress) == "0.167"
