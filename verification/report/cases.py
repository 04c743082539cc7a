"""The cases in the report: a verdict per area, a table of all of them, and a page for each."""

from collections.abc import Sequence

from masonry.runtime.progress import duration
from verification import text
from verification.case import LOOSE, UNEXPECTED, Check
from verification.catalogue import formula
from verification.html import figures, page
from verification.outcome import IMBALANCE, Outcome
from verification.records import records_of
from verification.scene_runs import text_of

KINDS = {"PASS": "ok", "FAIL": "bad", "ERROR": "bad", "NOT BUILT": "stop"}
AREAS = (
    *("Contact laws", "Elastic assemblies", "Fracture", "Friction and stability"),
    *("Dynamics", "Invariance", "Quasi-static loading"),
)


def chapters(outcomes: Sequence[Outcome], seconds: float) -> list[page.Chapter]:
    """An overview of all cases, then a chapter for each; none without outcomes."""
    if not outcomes:
        return []
    outcomes = sorted(outcomes, key=lambda o: _areas(outcomes).index(o.case.area))
    made = page.Chapter("All cases at a glance", group="Cases with known answers")
    made.parts.append(page.paragraph(INTRODUCTION))
    made.parts.append(page.paragraph(text.verdict(outcomes, seconds), "lead"))
    rows = [[page.Link(o.case.title, anchor(o)), *_row(o)] for o in outcomes]
    made.parts.append(page.table(["case", *text.HEADER[1:]], rows))
    for heading, sentences in text.notes(outcomes).items():
        made.parts += [page.heading(heading), page.bullets(sentences)]
    made.verdicts += verdicts(outcomes)
    return [made, *map(chapter, outcomes)]


def _row(outcome: Outcome) -> list[str | page.Cell]:
    """The cells of a case after its name, the status in its colour."""
    _, row, status, *numbers = text.row(outcome)
    return [row, page.Cell(status, KINDS[status]), *(page.Cell(number, "number") for number in numbers)]


def anchor(outcome: Outcome) -> str:
    """Where the chapter of a case begins on the page."""
    return f"case-{outcome.case.name}"


def verdicts(outcomes: Sequence[Outcome]) -> list[page.Verdict]:
    """One for each area that has cases, and one on the energy ledgers of them all."""
    made = []
    for area in _areas(outcomes):
        here = [o for o in outcomes if o.case.area == area]
        if here:
            made.append(page.Verdict(area, _kind(here), _sentence(here)))
    ledgers = [share for o in outcomes for share in o.findings.imbalance.values()]
    if ledgers:
        fine = all(share <= IMBALANCE for share in ledgers)
        words = "closes" if fine else "does not close: it is off by up to"
        sentence = (
            f"The energy balance of {len(ledgers)} runs {words} {'within ' if fine else ''}{max(ledgers):.0e} of the "
            f"external work at every row (limit {IMBALANCE:.0e})."
        )
        made.append(page.Verdict("Energy of the cases", "ok" if fine else "bad", sentence))
    return made


def _areas(outcomes: Sequence[Outcome]) -> list[str]:
    """The areas in their order, those of the cases last that have one of their own."""
    return list(dict.fromkeys([*AREAS, *(o.case.area for o in outcomes)]))


def _kind(here: Sequence[Outcome]) -> str:
    if any(o.status in ("FAIL", "ERROR") for o in here):
        return "bad"
    return "none" if all(o.status == "NOT BUILT" for o in here) else "ok"


def _sentence(here: Sequence[Outcome]) -> str:
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


def chapter(outcome: Outcome) -> page.Chapter:
    """The page of a case: what it is, formula, pictures, numbers, ledgers, scene."""
    case, findings = outcome.case, outcome.findings
    made = page.Chapter(case.title, group=case.area, anchor=anchor(outcome), records=records_of(outcome))
    line = f"Row {case.row} of the catalogue, area “{case.area}”, `masonry verify {case.name}`"
    status = page.Cell(outcome.status, KINDS[outcome.status])
    made.parts.append(page.table([], [[status, line, duration(outcome.seconds)]]))
    if outcome.status == "NOT BUILT":
        made.parts.append(page.paragraph(f"Not run: {outcome.reason}.", "lead"))
    wrong = text.failures(outcome)
    made.parts += [page.paragraph("What does not hold:"), page.bullets(wrong)] if wrong else []
    made.parts.append(page.preformatted(formula(case)))
    for k in range(0, len(findings.plots), 2):
        pair = findings.plots[k : k + 2]
        caption = "; ".join(p.title for p in pair) + "."
        made.parts.append(page.picture(figures.plots(pair), caption, "half" if len(pair) == 1 else ""))
    if findings.checks:
        made.parts.append(page.table(CHECKS, map(_check, findings.checks), "What was measured and what it should be."))
    if findings.imbalance:
        made.parts.append(page.table(RUNS, _runs(outcome), "The runs of this case and their energy ledgers."))
    made.parts += [page.bullets(findings.remarks)] if findings.remarks else []
    made.parts += [page.folded("The scene", page.preformatted(text_of(case.scene).strip()))] if case.scene else []
    return made


CHECKS = ("quantity", "value", "reference", "error", "tolerance", "why this tolerance")
RUNS = ("run", "steps", "seconds of stepping", "energy residual / external work", "kinetic / internal energy")


def _check(check: Check) -> list[str | page.Cell]:
    unit = f" {check.unit}" if check.unit not in ("", "1") else ""
    if check.is_bound:
        return [
            check.quantity,
            page.Cell(f"{check.value:.7g}{unit}", "number"),
            page.Cell(f"at most {check.reference:.7g}{unit}", "number", check.kind),
            page.Cell("holds" if check.holds else "fails", "ok" if check.holds else "bad"),
            "-",
            page.Cell(check.reason, "text"),
        ]
    notes = {
        f"too loose: passes by more than {LOOSE:.0f} times": check.too_loose,
        f"worse than expected: more than {UNEXPECTED:.0f} times that error": check.worse,
        "the tolerance does not follow from the expected error": check.ill_set,
    }
    note = "; ".join(words for words, so in notes.items() if so)
    kind = "bad" if not check.holds else "warn" if note else "ok"
    return [
        check.quantity,
        page.Cell(f"{check.value:.7g}{unit}", "number"),
        page.Cell(f"{check.reference:.7g}{unit}", "number", check.kind),
        page.Cell(f"{check.error:+.1e}", f"{kind} number", note),
        page.Cell(f"{check.tolerance:.0e}", "number", f"expected {check.expected:.0e}"),
        page.Cell(check.reason, "text"),
    ]


def _runs(outcome: Outcome) -> list[list[str | page.Cell]]:
    rows: list[list[str | page.Cell]] = []
    for name, share in outcome.findings.imbalance.items():
        measures = outcome.findings.measures.get(name, {})
        steps, kinetic = measures.get("steps"), measures.get("kinetic_over_internal")
        rows.append(
            [
                name,
                "-" if steps is None else f"{steps:.0f}",
                f"{outcome.findings.seconds.get(name, 0.0):.2g}",
                page.Cell(f"{share:.0e}", "ok" if share <= IMBALANCE else "bad"),
                "-" if kinetic is None else f"{kinetic:.1e}",
            ]
        )
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
