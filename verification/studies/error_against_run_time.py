"""The chapter of error against run time: pictures, times to 1 % and 0.1 %, and what to choose."""

from collections.abc import Callable, Sequence

from masonry.runtime.progress import duration
from verification.html import figures, page
from verification.problem import Point, Problem, Reference, front, is_setting, time_to
from verification.studies import problems_of_cases, threads
from verification.studies.refinement import Study, anchor, problems

ORDER = 20
TARGETS = (0.01, 0.001)
FLOOR = 1e-8
NEAR, FELT = 1.5, 0.1
"""The shipped setting is near the front if it takes at most NEAR times the quickest of its error, or FELT s more."""


def chapter(tell: Callable[[str], None], chosen: Sequence[Problem] | None = None, quick: bool = False) -> page.Chapter:
    """Each problem: the refinements of its knobs, drawn and tabled; verdicts on the shipped setting.

    A quick one leaves dear problems out, refines the loading alone, and makes each run once.
    """
    made = page.Chapter("Error against run time")
    selected = list(problems() if chosen is None else chosen)
    if quick:
        selected = [problem.of_the_loading() for problem in selected if not problem.dear]
    studies = [Study(problem, tell, timed=not quick) for problem in selected]
    made.records += [record for study in studies for record in (*study.records, *threads.records(study))]
    shipped = [(study, point) for study in studies if (point := study.shipped)]
    header = ["problem", "as shipped", "quickest of that error", "time to 1 %", "time to 0.1 %", "settings"]
    caption = "The largest error over all quantities of a problem, and seconds of stepping on one thread"
    made.add(*INTRODUCTION, page.table(header, map(row, studies), caption), problems_of_cases.table())
    for study in studies:
        made.add(*section(study))
    worst = max((point.error + study.doubt for study, point in shipped), default=0.0)
    made.judge(
        "Loading rate",
        "ok" if worst <= 0.01 else "warn" if worst <= 0.03 else "bad",
        f"At the shipped loading all quantities of {len(studies)} problems are within {page.percent(worst)} of their "
        f"references (the references' doubt included).",
    )
    slow = [study.problem.title for study, point in shipped if not near(point, study.points(), study.doubt)]
    words = (
        f"It takes more than {NEAR:g} times as long as the quickest setting of the same error in: {', '.join(slow)}."
    )
    fine = f"In all problems it takes at most {NEAR:g} times as long as the quickest setting of the same error."
    made.judge("Shipped settings", "warn" if slow else "ok", words if slow else fine)
    made.verdicts += threads.verdict(studies)
    return made


def equals(shipped: Point, points: list[Point], doubt: float) -> list[Point]:
    """The settings that are as good as the shipped one; differences within the reference's doubt count for nothing."""
    return [p for p in points if p.error <= max(shipped.error, doubt)]


def near(shipped: Point, points: list[Point], doubt: float) -> bool:
    """Whether the shipped setting is about as quick as the quickest of its error."""
    quickest = min(p.seconds for p in equals(shipped, points, doubt))
    return shipped.seconds <= NEAR * quickest or shipped.seconds - quickest <= FELT


def row(study: Study) -> list[str | page.TableCell | page.Link]:
    """A problem in the table of them all."""
    problem, points, shipped, doubt = study.problem, study.points(), study.shipped, study.doubt
    cells: list[str | page.TableCell | page.Link] = [page.Link(problem.title, anchor(problem)), "-", "-"]
    if shipped is not None:
        best = min(equals(shipped, points, doubt), key=lambda p: p.seconds)
        ratio = f"{shipped.seconds / best.seconds:.2g} times quicker, {best.knob} {best.label}"
        said = "the shipped one" if best == shipped else ratio
        cells[1:] = [
            page.judged(_seconds(shipped), _care(shipped.error <= 0.01), f"error {page.percent(shipped.error)}"),
            page.judged(_seconds(best), _care(near(shipped, points, doubt)), said),
        ]
    for target in TARGETS:
        good = [p for p in points if p.error <= target] if doubt <= target else []
        quickest = min(good, key=lambda p: p.seconds, default=None)
        why = "not reached" if doubt <= target else f"reference to {page.percent(doubt)}"
        cells.append(
            page.TableCell(_seconds(quickest), "", f"{quickest.knob} {quickest.label}")
            if quickest
            else page.TableCell("-", "none", why)
        )
    return [*cells, str(len(points))]


def _seconds(point: Point) -> str:
    return f"{point.seconds:.2g} s"


def _care(good: bool) -> str:
    return "ok" if good else "warn"


def section(study: Study) -> list[str]:
    """Recommended choice, the pictures, the reference, the table of times."""
    problem = study.problem
    panels = {q: study.lines(q) for q in study.references}
    fronts = {q: front([Point(k, t, s, 0, abs(e)) for k, points in lines.items() if is_setting(k)
                        for s, e, t in points]) for q, lines in panels.items()}  # fmt: skip
    caption = (
        f"{problem.title}: error against seconds of stepping. Labels name the setting; the grey line joins the ones "
        "that no other one beats; shaded: what the reference may be off by. Errors below "
        f"{page.percent(FLOOR)} are drawn there."
    )
    drawn = figures.error_against_time(panels, [study.doubts[q] for q in panels], FLOOR, fronts)
    return [
        page.heading(problem.title, anchor(problem)),
        page.paragraph(choice(study.points(), study.shipped, study.doubt), "lead"),
        page.picture(drawn, caption),
        reference_line(problem, study.references),
        times(study),
    ]


def reference_line(problem: Problem, references: dict[str, Reference]) -> str:
    """Reference values against which the errors are measured."""
    said = [
        f"{q} {r.value:.6g} {problem.units[q]} ({r.kind}"
        + (f" ± {page.percent(r.uncertainty / abs(r.value))})" if r.uncertainty else ")")
        for q, r in references.items()
    ]
    return page.paragraph("Reference: " + "; ".join(said) + ".", "note")


def times(study: Study) -> str:
    """The table of times to 1 % and to 0.1 %, by knob and quantity."""
    by_quantity = {q: study.lines(q) for q in study.references}
    rows = []
    for knob in study.problem.knobs:
        cells: list[str | page.TableCell] = [knob]
        for q, lines in by_quantity.items():
            for target in TARGETS:
                seconds = time_to(lines.get(knob, []), target)
                cells.append(
                    page.TableCell("-", "none", f"reference only to {page.percent(study.doubts[q])}")
                    if study.doubts[q] > target
                    else page.TableCell(f"{seconds[0]:.2g} s", "ok", f"at {seconds[1]}")
                    if seconds
                    else "not reached"
                )
        rows.append(cells)
    header = ["knob", *(f"{words} to {page.percent(t)}" for words in by_quantity for t in TARGETS)]
    return page.table(header, rows, "Least time to come, and at all finer settings to stay, this near to the reference")


def choice(points: list[Point], shipped: Point | None, doubt: float) -> str:
    """Recommended choice, in a sentence or two."""
    good = [p for p in points if p.error <= TARGETS[0]]
    best = min(good, key=lambda p: p.seconds, default=None)
    said = [f"None of these settings comes within {page.percent(TARGETS[0])}."]
    if best is not None:
        same = shipped is not None and near(shipped, points, doubt) and shipped.error <= TARGETS[0]
        what = "keep the accuracy as shipped" if same else f"choose {best.knob} {best.label}: {in_words(best)}"
        said = [f"To come within {page.percent(TARGETS[0])}, {what}."]
    if shipped is not None:
        said.append(f"As shipped: {in_words(shipped)}.")
    if doubt:
        said.append(f"The reference itself is known to within {page.percent(doubt)}.")
    return " ".join(said)


def in_words(point: Point) -> str:
    """Time, steps and error of a setting."""
    return f"{duration(point.seconds)}, {point.steps:,} steps, error {page.percent(point.error)}"


INTRODUCTION = (
    "Each point is one run. To the left is quicker, lower is better. One line refines one knob and "
    "leaves the others as they are; knobs other than the loading are refined at a constant rate, which sets a floor "
    "under their errors. The dotted line is 1 %. Full lines are errors in solving the model. Dashed lines change the "
    "model itself: they show how far another model is from the shipped one, and need not go to zero. Seconds are those "
    "of stepping, on one thread but where threads are the knob, the least of three runs where a run takes less than "
    "two seconds; compiling and writing files are apart.",
    "Where there is no closed form the reference is the same scene at its slowest loading, a constant rate or an "
    "accuracy, and what it may still be off by is estimated from three settings, each twice as fine as the one before, "
    "and from how far the finest drive to an accuracy is from it.",
)
