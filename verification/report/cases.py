"""The cases in the report: a verdict per area, a table of all of them, and a page for each."""

from collections.abc import Sequence

from masonry.runtime.progress import duration
from verification import text
from verification.case import LOOSE, UNEXPECTED, Check
from verification.catalogue import formula
from verification.html import figures, page
from verification.outcome import IMBALANCE, CaseOutcome
from verification.records import records_of
from verification.scene_runs import text_of

KINDS = {"PASS": "ok", "FAIL": "bad", "ERROR": "bad", "NOT BUILT": "stop"}
AREAS = (
    *("Contact laws", "Elastic assemblies", "Fracture", "Friction and stability"),
    *("Dynamics", "Invariance", "Quasi-static loading"),
)


def chapters(outcomes: Sequence[CaseOutcome], seconds: float) -> list[page.Chapter]:
    """An overview of all cases, then a chapter for each; none without outcomes."""
    if not outcomes:
        return []
    outcomes = sorted(outcomes, key=lambda o: _areas(outcomes).index(o.case.area))
    made = page.Chapter("All cases at a glance", group="Cases with known answers")
    rows = [[page.Link(o.case.title, anchor(o)), *_row(o)] for o in outcomes]
    made.add(
        INTRODUCTION,
        page.paragraph(text.verdict(outcomes, seconds), "lead"),
        page.table(["case", *text.HEADER[1:]], rows),
    )
    for heading, sentences in text.notes(outcomes).items():
        made.add(page.heading(heading), page.bullets(sentences))
    judge(made, outcomes)
    return [made, *map(chapter, outcomes)]


def _row(outcome: CaseOutcome) -> list[str | page.TableCell]:
    """The cells of a case after its name, the status in its colour."""
    _, row, status, *numbers = text.row(outcome)
    return [row, page.TableCell(status, KINDS[status]), *(page.TableCell(number, "number") for number in numbers)]


def anchor(outcome: CaseOutcome) -> str:
    """Where the chapter of a case begins on the page."""
    return f"case-{outcome.case.name}"


def judge(made: page.Chapter, outcomes: Sequence[CaseOutcome]) -> None:
    """A verdict on each area that has cases, and one on the energy ledgers of them all."""
    for area in _areas(outcomes):
        here = [o for o in outcomes if o.case.area == area]
        if here:
            made.judge(area, _kind(here), _sentence(here))
    ledgers = [imbalance for o in outcomes for imbalance in o.findings.imbalance.values()]
    if ledgers:
        fine = all(imbalance <= IMBALANCE for imbalance in ledgers)
        words = "closes within" if fine else "does not close: it is off by up to"
        sentence = (
            f"The energy balance of {len(ledgers)} runs {words} {max(ledgers):.0e} of the external work at every row "
            f"(limit {IMBALANCE:.0e})."
        )
        made.judge("Energy of the cases", fine, sentence)


def _areas(outcomes: Sequence[CaseOutcome]) -> list[str]:
    """The areas in their order, those of the cases last that have one of their own."""
    return list(dict.fromkeys([*AREAS, *(o.case.area for o in outcomes)]))


def _kind(here: Sequence[CaseOutcome]) -> str:
    if any(o.status in ("FAIL", "ERROR") for o in here):
        return "bad"
    return "none" if all(o.status == "NOT BUILT" for o in here) else "ok"


def _sentence(here: Sequence[CaseOutcome]) -> str:
    """How many hold, which is the nearest to its tolerance, and what does not hold."""
    built = [o for o in here if o.status != "NOT BUILT"]
    holds, checks = sum(o.status == "PASS" for o in built), [c for o in built for c in o.findings.checks]
    said = [f"{holds} of {len(built)} cases hold, {len(checks)} numbers"] if built else []
    if holds == len(built) and checks:
        used, name = max((c.used, o.case.title) for o in built for c in o.findings.checks)
        said.append(f"the tightest takes up {100 * used:.0f} % of its tolerance ({name})")
    wrong = [o.case.title for o in built if not o.holds]
    said += [f"does not hold: {', '.join(wrong)}"] if wrong else []
    lacking = [o.case.title for o in here if o.status == "NOT BUILT"]
    said += [f"not built: {', '.join(lacking)}"] if lacking else []
    return "; ".join(said) + "."


def chapter(outcome: CaseOutcome) -> page.Chapter:
    """The page of a case: what it is, formula, pictures, numbers, ledgers, scene."""
    case, findings = outcome.case, outcome.findings
    made = page.Chapter(case.title, group=case.area, anchor=anchor(outcome), records=records_of(outcome))
    line = f"Row {case.row} of the catalogue, area “{case.area}”, `masonry verify {case.name}`"
    status = page.TableCell(outcome.status, KINDS[outcome.status])
    lacking, wrong = outcome.status == "NOT BUILT", text.failures(outcome)
    made.add(
        page.table([], [[status, line, duration(outcome.seconds)]]),
        page.paragraph(f"Not run: {outcome.reason}.", "lead") if lacking else "",
        *(("What does not hold:", page.bullets(wrong)) if wrong else ()),
        page.preformatted(formula(case)),
    )
    for k in range(0, len(findings.plots), 2):
        pair = findings.plots[k : k + 2]
        caption = "; ".join(p.title for p in pair) + "."
        made.add(page.picture(figures.plots(pair), caption, "half" if len(pair) == 1 else ""))
    checks, runs = map(_check, findings.checks), "The runs of this case and their energy ledgers."
    made.add(
        page.table(CHECKS, checks, "What was measured and what it should be.") if findings.checks else "",
        page.table(RUNS, _runs(outcome), runs) if findings.imbalance else "",
        page.bullets(findings.remarks) if findings.remarks else "",
        page.folded("The scene", page.preformatted(text_of(case.scene).strip())) if case.scene else "",
    )
    return made


CHECKS = ("quantity", "value", "reference", "error", "tolerance", "why this tolerance")
RUNS = ("run", "steps", "seconds of stepping", "energy residual / external work", "kinetic / internal energy")


def _check(check: Check) -> list[str | page.TableCell]:
    tolerance = check.tolerance
    unit = f" {check.unit}" if check.unit not in ("", "1") else ""
    notes = {
        f"too loose: passes by more than {LOOSE:.0f} times": check.too_loose,
        f"worse than expected: more than {UNEXPECTED:.0f} times that error": check.worse,
        "the tolerance does not follow from the expected error": check.ill_set,
    }
    note = "; ".join(words for words, so in notes.items() if so)
    kind = "bad" if not check.holds else "warn" if note else "ok"
    most = "at most " if check.is_bound else ""
    return [
        check.quantity,
        page.TableCell(f"{check.value:.7g}{unit}", "number"),
        page.TableCell(f"{most}{check.reference:.7g}{unit}", "number", tolerance.kind),
        page.judged("holds" if check.holds else "fails", kind)
        if check.is_bound
        else page.TableCell(f"{check.error:+.1e}", f"{kind} number", note),
        "-"
        if check.is_bound
        else page.TableCell(f"{tolerance.limit:.0e}", "number", f"expected {tolerance.expected:.0e}"),
        page.TableCell(tolerance.reason, "text"),
    ]


def _runs(outcome: CaseOutcome) -> list[list[str | page.TableCell]]:
    rows: list[list[str | page.TableCell]] = []
    for name, imbalance in outcome.findings.imbalance.items():
        measures, seconds = outcome.findings.measures.get(name, {}), outcome.findings.seconds.get(name, 0.0)
        steps, kinetic = measures.get("steps"), measures.get("kinetic_over_internal")
        closes = page.judged(f"{imbalance:.0e}", imbalance <= IMBALANCE)
        said = "-" if steps is None else f"{steps:.0f}", "-" if kinetic is None else f"{kinetic:.1e}"
        rows.append([name, said[0], f"{seconds:.2g}", closes, said[1]])
    return rows


INTRODUCTION = (
    "Each case is a small problem whose answer is known without this program: from a closed form, from limit analysis, "
    "from an independent finite element model, or because turning, mirroring or renumbering a problem must not change "
    "its answer. The error of each number is signed and relative. Its tolerance follows from the error that the method "
    "should have (“expected”), and is a few times as large; a case that passes by more than a hundred times is marked "
    "as too loose, since it would let a mistake through, and an error of more than three times the expected one as "
    "well. A bound, such as what a scene must have cracked to be worth anything, holds or does not. “Worst error” is "
    "the one that comes nearest to its tolerance."
)
