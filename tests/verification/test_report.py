"""The report on a small subset: its records are finite and right, and its page stands alone."""

import base64
import io
import json
import math
import re
from inspect import signature

import numpy as np
import pytest
from matplotlib import image
from matplotlib.figure import Figure

from verification.html import page
from verification.html.page import Chapter, Link, Verdict, escape, table, without_dead_links
from verification.report.__main__ import study_chapters, write
from verification.stability.cells import Grid, MapCell
from verification.stability.references import sheared
from verification.studies import couplet, energy_balance, stability
from verification.studies.refinement import problems
from verification.timed_run import THREADS

KNOBS = {"shipped": {}, "far beyond the bound": {"solver.step_fraction": 5.0}, "refused": {"solver.damping": 1.0}}
LIMITS = Grid(
    "Limits",
    "law",
    "knob",
    {
        ("exponential", name): MapCell("couplet", {"drive.steps": 4000, **knobs}, sheared)
        for name, knobs in KNOBS.items()
    },
)


def quiet(_: str) -> None:
    pass


@pytest.fixture(scope="module")
def chapters() -> list[Chapter]:
    return [
        couplet.chapter(quiet, laws=("exponential",), confinements=("0.1 MPa", "1.0 MPa"), kinematics=("rigid",)),
        stability.chapter(quiet, [LIMITS]),
        energy_balance.chapter(quiet),
    ]


@pytest.fixture(scope="module")
def written(chapters: list[Chapter], tmp_path_factory: pytest.TempPathFactory) -> tuple[str, list[dict]]:
    page, records = write(chapters, 1.0, tmp_path_factory.mktemp("report"))
    return page.read_text(encoding="utf-8"), json.loads(records.read_text(encoding="utf-8"))


def test_every_record_says_what_was_run_and_holds_no_number_that_is_not_finite(written):
    _, records = written
    assert len(records) > 10
    for record in records:
        assert {"case", "quantity", "value", "reference", "kind_of_reference", "error", "seconds", "steps", "knobs",
                "source_hash", "version"} <= set(record)  # fmt: skip
        assert all(math.isfinite(v) for v in record.values() if isinstance(v, float))
        assert record["status"] != "OK" or record["error"] is not None


def test_the_couplet_is_within_its_tolerances_of_the_closed_form(chapters):
    assert len(chapters[0].records) == 2 * len(couplet.TOLERANCE)
    for record in chapters[0].records:
        assert abs(record["error"]) <= couplet.TOLERANCE[record["quantity"]], record["quantity"]
    assert chapters[0].verdicts[0].kind == "ok"


def test_the_closed_form_gives_the_published_strengths_of_table_1():
    for confinement, peak, slip, later in (
        ("0.1 MPa", 0.971e6, 0.2e-3, 0.165e6),
        ("1.0 MPa", 1.880e6, 0.2e-3, 1.246e6),
    ):
        knobs = {"confinement": confinement}
        at_peak = peak / 70e9
        assert couplet.exact_stress("couplet", knobs, at_peak)[()] == pytest.approx(peak, rel=1e-3)
        assert couplet.exact_stress("couplet", knobs, slip)[()] == pytest.approx(later, rel=2e-3)


def test_each_limit_ends_in_a_right_answer_or_in_a_reason(chapters):
    found_status = {
        record["rung"].split(", ")[1]: (record["status"], record["reason"]) for record in chapters[1].records
    }
    assert found_status["shipped"] == ("OK", "")
    assert found_status["refused"][0] == "REFUSED" and "damping" in found_status["refused"][1]
    assert found_status["far beyond the bound"][0] == "STOPPED" and "bound" in found_status["far beyond the bound"][1]
    assert chapters[1].verdicts[0].kind == "ok"


def test_the_page_stands_alone(written):
    page, _ = written
    assert not re.search(r"https?://", page)
    images = re.findall(r"<img[^>]*>", page)
    assert images and all(re.search(r'src="data:image/', image) for image in images)
    assert not re.search(r"<(script|link|iframe)", page)
    assert "nan" not in re.sub(r"<[^>]*>", "", page).lower().split()


def test_the_first_page_gives_a_verdict_on_each_area_and_says_where_one_is_missing(written):
    page, _ = written
    cover = page.partition("<nav>")[0]
    for area in ("Closed forms", "Loading rate", "Stability", "Energy balance"):
        assert area in cover
    assert cover.count("not\u00a0looked\u00a0at") == 1
    assert "Not part of this report: Loading rate, Shipped settings, Threads, Leaving out, Assumptions" in cover


def test_a_link_to_a_chapter_that_is_not_there_is_text():
    row = [[Link("here", "a"), [Link("here too", "a"), Link("elsewhere", "b")]]]
    shown = without_dead_links('<h3 id="a">A</h3>' + table([], row))
    assert shown.count('<a href="#a">') == 2 and "#b" not in shown and "elsewhere" in shown


def test_text_in_the_page_is_escaped():
    assert "<b>" not in table(["<b>"], [["<b>"]]) and escape("a < b") == "a &lt; b"
    assert Verdict("x", "ok", "y").kind == "ok"


def test_all_studies_are_found_without_a_list_and_in_their_order():
    names = list(study_chapters())
    assert names[0] == "couplet" and names[-1] == "energy_balance" and len(names) >= 6


def test_a_picture_in_pixels_keeps_its_colours_and_is_lighter_than_lines_where_they_are_thousands():
    figure = Figure(figsize=(4, 3))
    axes = figure.subplots()
    places = np.linspace(0.0, 1.0, 3000)
    for k, colour in enumerate(("#8b0a1a", "#0a3a8b", "#f2e2c9")):
        axes.plot(np.sin(1000.0 * places) + 3 * k, places, color=colour)
    whole, light = page.picture(figure, "many"), page.picture(figure, "many", pixels=True)
    assert "image/png" in light and "image/svg" in whole
    data = base64.b64decode(light.partition("base64,")[2].partition('"')[0])
    drawn = image.imread(io.BytesIO(data))
    for colour in ((0x8B, 0x0A, 0x1A), (0x0A, 0x3A, 0x8B), (0xF2, 0xE2, 0xC9)):
        assert np.abs(255.0 * drawn[..., :3] - colour).max(axis=2).min() < 6.0
    assert len(light) < 0.5 * len(whole)


def test_what_stands_between_backticks_is_code_and_all_else_is_escaped():
    text = "run `masonry verify <x>`, a < b"
    shown = "run <code>masonry verify &lt;x&gt;</code>, a &lt; b"
    assert page.paragraph(text) == f"<p>{shown}</p>" and shown in page.bullets([text])
    assert shown in page.table(("a",), [[text], [page.TableCell("x", "ok", text)]])


def test_every_study_has_a_quick_chapter_and_quick_problems_keep_what_their_reference_needs():
    assert all("quick" in signature(chapter).parameters for chapter in study_chapters().values())
    known = list(problems())
    assert 0 < sum(not problem.dear for problem in known) < len(known)
    for problem in known:
        needed = {problem.converged, problem.shipped[0]} & set(problem.knobs)
        quick = problem.of_the_loading()
        assert set(quick.knobs) == (needed or set(problem.knobs)) and THREADS not in quick.knobs
