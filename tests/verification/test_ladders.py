"""Error against run time: the references, the front, and what is said about the shipped setting."""

import pytest

from verification.ladder import Point, Reference, front, richardson, time_to
from verification.precision import oscillator
from verification.studies import error_against_run_time as chapter
from verification.studies import left_out
from verification.studies.ladders import Study, problems
from verification.studies.parts import PARTS

SHIPPED = Point("accuracy", "1 %", 2.0, 900, 0.004)


def quiet(_: str) -> None:
    pass


def test_richardson_covers_the_limit_of_a_series_of_first_order():
    reference = richardson([1.0 + 0.08 / 2**k for k in range(5)])
    assert abs(reference.value - 1.0) <= reference.uncertainty <= 2 * abs(reference.value - 1.0)
    assert reference.doubted(0.0) == reference and reference.doubted(0.5).uncertainty == 0.5


def test_a_lucky_crossing_is_no_time_to_one_percent():
    rungs = [(1.0, 0.002, "lucky"), (2.0, 0.03, "worse"), (4.0, 0.005, "good"), (8.0, 0.001, "best")]
    assert time_to(rungs, 0.01) == (4.0, "good")
    assert time_to(rungs, 1e-4) is None


def test_the_front_keeps_what_no_other_setting_beats():
    points = [Point("k", label, t, 1, e) for label, t, e in (("a", 1, 0.1), ("b", 2, 0.2), ("c", 3, 0.01))]
    assert [p.label for p in front(points)] == ["a", "c"]


def test_a_shipped_setting_that_is_beaten_by_more_than_half_is_told():
    quicker = Point("constant rate", "x8", 1.0, 400, 0.003)
    assert chapter.near(SHIPPED, [SHIPPED], 0.0)
    assert not chapter.near(SHIPPED, [SHIPPED, quicker], 0.0)
    assert chapter.near(SHIPPED, [SHIPPED, quicker._replace(error=0.01)], 0.0)
    assert not chapter.near(SHIPPED, [SHIPPED, quicker._replace(error=0.01)], 0.02), "within the doubt both are as good"
    assert "choose constant rate x8" in chapter.choice([SHIPPED, quicker], SHIPPED, 0.0)
    assert "keep the accuracy as shipped" in chapter.choice([SHIPPED], SHIPPED, 0.0)


def test_there_are_ladders_for_a_dozen_problems_and_the_shipped_setting_is_a_rung_of_each():
    found = list(problems())
    assert len({p.name for p in found}) == len(found) >= 12
    assert found[0].name == "couplet"
    for problem in found:
        knob, label = problem.shipped
        assert not knob or label in problem.knobs[knob], problem.name


def test_the_oscillator_is_of_second_order_and_its_chapter_can_be_drawn():
    (problem,) = oscillator.PROBLEMS
    study = Study(problem, quiet)
    errors = [error for _, error, _ in study.lines(oscillator.SPRING)["time step"]]
    assert errors[-2] / errors[-1] == pytest.approx(4.0, rel=0.03)
    assert all(isinstance(r, Reference) for r in study.references.values())
    made = chapter.chapter(quiet, [problem])
    assert oscillator.SPRING in "".join(made.parts) and "None of these" not in "".join(made.parts)
    assert {r["case"] for r in made.records} == {"oscillator"}


@pytest.mark.parametrize("name", ["damping", "turned principal axes"])
def test_a_part_that_does_nothing_changes_no_bit(name):
    part = next(p for p in PARTS if p.name == name)
    assert left_out.compare(part, rounds=0)[0] == 0.0
