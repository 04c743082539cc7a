"""`masonry report`: a page that needs nothing beside it, says what a result says, and takes nobody's place."""

import re
from html.parser import HTMLParser

import pytest

import masonry
from masonry.assembly.assemble import joined
from masonry.cli.main import main
from masonry.errors import SceneError
from masonry.judgement.words import readable
from masonry.reporting import run_report
from masonry.reporting.run_report import report_page, write_report
from masonry.runtime.named_file import is_marked
from masonry.scene import to_toml
from tests.results.sample import sample


class Words(HTMLParser):
    """The words of a page, and what its tags refer to."""

    def __init__(self, text):
        super().__init__()
        self.words, self.references, self.open = [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.references += [value for key, value in attributes if key in ("src", "href")]
        self.open += [tag] * (tag not in ("meta", "img", "br"))

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, "tags are closed in their order"

    def handle_data(self, data):
        self.words.append(data)


def reported(**more):
    """The sample as a run of the couplet, with assumptions and a title that would be a tag."""
    result = sample()
    scene = masonry.load("couplet").with_(title="<b>R&D</b>")
    result.scene_toml = to_toml(scene)
    result.summary |= more
    return result


def test_the_page_needs_nothing_beside_it_and_says_what_the_result_says(tmp_path):
    path = write_report(reported(), tmp_path / "page.html")
    page = Words(path.read_text())
    assert page.open == [] and len(page.references) == 2
    assert all(re.match(r"data:image/(svg\+xml|png);base64,", one) for one in page.references)
    text = " ".join(" ".join(page.words).split())
    for words in (
        "<b>R&D</b>",
        reported().trust,
        "peak stress 0.19 MPa",
        "material.units.density not given; a usual clay brick",
        "What it bore as it moved, and where the energy went",
    ):
        assert words in text, words
    assert is_marked(path) and path.read_bytes() == write_report(reported(), tmp_path / "two.html").read_bytes()


def test_doubts_and_a_run_that_stopped_are_told():
    page = report_page(reported(stopped="a block turned too far", interrupted=False))
    assert page.verdict == "stopped" and page.doubts
    told = Words(run_report.page_text(page))
    assert page.doubts[0][0] in told.words


def test_the_specimen_is_drawn_with_its_supports_and_loads_where_the_scene_is_its_own():
    result = reported()
    result.specimen, result.joints = joined(masonry.load("couplet"))
    result.joint_group = result.joint_group[: len(result.joints.area)]
    result.history.rows, result.history.frames = {}, []
    page = report_page(result)
    assert [picture.caption for picture in page.pictures][0] == "The specimen, its supports and loads"
    assert len(page.pictures) == 3 and page.put_in[-1][0] == "material units"


def test_what_is_no_scene_any_more_has_a_page_without_the_picture_of_the_specimen(tmp_path, monkeypatch):
    result = sample()
    result.history.rows, result.history.frames = {}, []
    assert [picture.caption.split()[0] for picture in report_page(result).pictures] == ["The", "What"]
    monkeypatch.setattr(run_report, "LARGEST", 1000)
    assert {picture.form for picture in report_page(result).pictures} == {"png"}


def test_a_load_factor_says_of_what_and_bars_belong_to_the_materials(monkeypatch):
    monkeypatch.setattr(run_report, "PICTURES", ())
    result = sample()
    result.scene_toml = to_toml(masonry.load("wall-tied", {"bar.0.pretension": "1 kN"}))
    result.summary |= {"collapse_load": {"pattern": "weight", "borne": 0.2, "falls": 0.21, "accuracy": 0.005}}
    page = report_page(result)
    lines = dict(page.results)["load factor"]
    assert lines[0] == "of the weight along -y" and lines[1].startswith("0.2 is borne, 0.21 is not")
    assert dict(page.put_in)["bar tie"] == [
        "2 of them, length 2 m, area 113 mm^2, strength 13.3 MPa, young modulus 210 GPa, pretension 1 kN, slack 0 m, "
        "compression no"
    ]


def test_the_words_of_a_vehicle_are_those_of_its_table():
    table = {"limit": {"pattern": "vehicle"}, "vehicle": {"on": "deck", "level": "1 m", "axles": ["100 kN"]}}
    assert run_report.load_words(table) == "the axle of the vehicle, 100 kN in all"
    assert run_report.load_words({}) == run_report.load_words({"limit": {"pattern": "none"}}) == ""


def test_the_command_and_python_write_it_whole_and_never_over_what_is_not_ours(tmp_path, capsys):
    sample().save(tmp_path / "run")
    folder, page = str(tmp_path / "run"), tmp_path / "run" / "report.html"
    assert main(["report", folder]) == 0 and capsys.readouterr().out.strip() == str(page)
    assert main(["report", folder]) == 0, "ours is replaced"
    page.write_text("mine")
    assert main(["report", folder]) == 2 and page.read_text() == "mine"
    assert "--overwrite replaces it" in capsys.readouterr().err
    assert masonry.report(folder, page, overwrite=True) == page and is_marked(page)
    assert masonry.report(sample(), tmp_path / "a.html").is_file()
    assert main(["report", folder, "--out", str(tmp_path / "a.pdf")]) == 2
    assert "a report is a .html file; nearest: 'a.html'" in capsys.readouterr().err
    with pytest.raises(SceneError, match="not a folder of results"):
        masonry.report(tmp_path / "none", "a.html")


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ("600000.0 Pa", "0.6 MPa"),
        ("150000000000.0 Pa/m", "150 GPa/m"),
        ("58.0 N/m", "58 N/m"),
        ("0.0 Pa", "0 Pa"),
        ("0.0016 m", "1.6 mm"),
        ("0.5585053606381855 rad", "32 deg"),
        ("0.000113 m^2", "113 mm^2"),
        ("0.02 m^2", "0.02 m^2"),
        (False, "no"),
        ("1900.0 kg/m^3", "1900 kg/m^3"),
        (1.01, "1.01"),
        ("secant", "secant"),
        ({"100000.0 Pa": 2.1, "1000000.0 Pa": 2.9}, "2.1 at 0.1 MPa and 2.9 at 1 MPa"),
    ],
)
def test_values_have_a_letter_for_their_power(value, words):
    assert readable(value) == words
