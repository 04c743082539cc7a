"""Error against run time: the references, the front, and what is said about the shipped setting."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest

from verification import timed_run
from verification.case import Case, Findings
from verification.cases.fracture import eccentric_tension
from verification.catalogue import catalogue
from verification.convergence import oscillator
from verification.problem import Point, Reference, front, richardson, time_to
from verification.studies import ablation, threads
from verification.studies import error_against_run_time as chapter
from verification.studies.parts import PARTS
from verification.studies.problems_of_cases import table
from verification.studies.refinement import Study, problems

SHIPPED = Point("accuracy", "1 %", 2.0, 900, 0.004)


def gaps(cases: Mapping[str, Case]) -> list[str]:
    """What is wrong with the cases, in sentences: neither problem nor reason, or both; a wrong name."""
    known = {problem.name for problem in problems()}
    gaps_of = []
    for name, case in cases.items():
        if bool(case.problems) == bool(case.no_problems):
            gaps_of.append(
                f"{name}: " + ("problems, and a reason for none" if case.problems else "neither problems nor a reason")
            )
        gaps_of += [f"{name}: no problem '{problem}'" for problem in case.problems if problem not in known]
    return gaps_of


def quiet(_: str) -> None:
    pass


def test_richardson_covers_the_limit_of_a_series_of_first_order():
    reference = richardson([1.0 + 0.08 / 2**k for k in range(5)])
    assert abs(reference.value - 1.0) <= reference.uncertainty <= 2 * abs(reference.value - 1.0)
    assert reference.doubted(0.0) == reference and reference.doubted(0.5).uncertainty == 0.5


def test_a_refinement_of_which_too_few_runs_came_to_their_end_vouches_for_nothing():
    assert richardson([2.0, -1.5]) == Reference(-1.5, "converged run", 1.5)
    assert np.isnan(richardson([]).value)


def test_a_lucky_crossing_is_no_time_to_one_percent():
    settings = [(1.0, 0.002, "lucky"), (2.0, 0.03, "worse"), (4.0, 0.005, "good"), (8.0, 0.001, "best")]
    assert time_to(settings, 0.01) == (4.0, "good")
    assert time_to(settings, 1e-4) is None


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


def test_there_are_a_dozen_problems_and_the_shipped_setting_is_one_of_each():
    known = list(problems())
    assert len({p.name for p in known}) == len(known) >= 12
    assert known[0].name == "couplet"
    for problem in known:
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


def test_a_quantity_without_a_closed_form_is_left_out_of_the_pictures():
    problem = oscillator.PROBLEMS[0]
    energy = next(iter(problem.units))
    least = replace(
        problem,
        knobs={name: dict(list(settings.items())[:2]) for name, settings in problem.knobs.items()},
        exact=lambda one: {energy: problem.exact(one)[energy]},
    )
    page = chapter.chapter(quiet, [least])
    assert list(page.records) and {record["quantity"] for record in page.records} == {energy}


def test_each_case_names_problems_that_exist_or_says_why_there_is_nothing_to_choose():
    assert gaps(catalogue()) == []
    shown = table()
    assert all(f"#case-{name}" in shown for name in catalogue())
    assert "#problem-wallette-mode-1" in shown and "exact at any setting" in shown


def test_a_case_without_problem_and_reason_or_with_a_wrong_name_is_told():
    def case(problems: tuple[str, ...] = (), no_problems: str = "") -> Case:
        return Case("one", "1", "One", "Dynamics", Findings, problems=problems, no_problems=no_problems)

    wrong = {"bare": case(), "torn": case(("couplet",), "exact"), "lost": case(("cuplet",))}
    fine = {"own": case(("couplet",)), "exact": case(no_problems="exact")}
    assert gaps(wrong | fine) == [
        "bare: neither problems nor a reason",
        "torn: problems, and a reason for none",
        "lost: no problem 'cuplet'",
    ]


def test_another_model_is_held_against_theory_and_the_loading_against_the_converged_run():
    (problem,) = oscillator.PROBLEMS
    settings = dict(list(oscillator.time_steps().items())[:4])
    knobs = {"time step": settings, "model: time step": settings, "threads": dict(list(settings.items())[:1])}
    study = Study(replace(problem, knobs=knobs, exact=None, theory=oscillator.exact, converged="time step"), quiet)
    errors = {knob: [e for _, e, _ in lines] for knob, lines in study.lines(oscillator.SPRING).items()}
    finest = study.references[oscillator.SPRING].value
    exact = problem.exact(next(iter(study.runs["time step"].values())))[oscillator.SPRING]
    assert len(errors["time step"]) == 3 and len(errors["model: time step"]) == 4
    assert errors["model: time step"][-1] == pytest.approx(finest / exact - 1.0) != 0.0
    assert {p.knob for p in study.points()} == {"time step"}
    kinds = {(r["knob"], r["kind_of_reference"]) for r in study.records}
    assert kinds == {(knob, "converged run") for knob in ("time step", "threads")} | {
        ("model: time step", "closed form")
    }


@pytest.mark.slow
def test_two_threads_give_the_bits_of_one():
    few = {"drive.steps": 400, "solver.rows": 20}
    one, two = (timed_run.run(eccentric_tension.SCENE, few | {"threads": n}) for n in (1, 2))
    assert two.ok and (one.threads, two.threads) == (1, 2) and one.knobs == two.knobs
    assert threads.apart({"1 thread": one, "2 threads": two}) == {"2 threads": 0.0}
    other = timed_run.run(eccentric_tension.SCENE, few | {"solver.damping": 0.7})
    assert threads.apart({"1 thread": one, "other": other})["other"] > 0.0


@pytest.mark.parametrize("name", ["damping", "turned principal axes"])
def test_a_part_that_does_nothing_changes_no_bit(name):
    part = next(p for p in PARTS if p.name == name)
    assert ablation.difference(part) == 0.0
