"""The chapter of error against run time: pictures, times to 1 % and 0.1 %, and what to choose."""

from collections.abc import Callable

from verification.report import figures, page
from verification.studies.ladders import (
    ACCURACY,
    ALL,
    FLOOR,
    QUANTITIES,
    TARGET,
    Reference,
    ladders,
    lines_of,
    study_scene,
    time_to,
)

ORDER = 20
CASES = ("couplet", "wallette-mode-1", "wallette-mode-2")
SHIPPED = "1 %"


def chapter(tell: Callable[[str], None], cases: tuple[str, ...] = CASES) -> page.Chapter:
    """Each scene: the ladders of its knobs, drawn and tabled, and a verdict on the loading as shipped."""
    made = page.Chapter("Error against run time")
    made.parts.append(
        page.paragraph(
            "Each point is one run. To the left is quicker, lower is better. One line climbs one knob from coarse to "
            "fine and leaves the others as shipped, but that all knobs other than the loading are climbed at constant "
            "rates: 40,000 steps in the couplet, and in the wallettes four times x1, which is 1 mm/s in mode 1 and "
            "0.5 mm/s in mode 2 (tets at sixteen). It sets a floor under their errors. The dotted "
            "line is 1 %. Full lines are errors in solving the model. Dashed lines change the model itself: they show "
            "how far another model is from the shipped one, and need not go to zero. Seconds are those of stepping on "
            "one thread, the least of two or three runs where a run is short; compiling and writing files are apart."
        )
    )
    worst = 0.0
    for case in cases:
        references, _, records = study_scene(case, ladders(case, ALL), tell)
        made.records += records
        doubts = {q: r.uncertainty / abs(r.value) for q, r in references.items()}
        choice, shipped = choose(case, records, doubts)
        worst = max(worst, shipped)
        panels = {words: lines_of(records, q) for q, words in QUANTITIES.items()}
        made.parts += [
            page.heading(case),
            page.paragraph(choice, "lead"),
            page.picture(
                figures.error_against_time(panels, list(doubts.values()), FLOOR),
                f"{case}: error of the peak (left) and of the dissipated energy (right) against seconds of stepping. "
                f"Labels name the rung; shaded: what the reference may be off by. Errors below {page.percent(FLOOR)} "
                "are drawn there.",
            ),
            reference_line(references),
            times(records, doubts),
        ]
    kind = "ok" if worst <= TARGET else "warn" if worst <= 3 * TARGET else "bad"
    sentence = f"At the shipped loading, peak and dissipated energy are within {page.percent(worst)} of the reference"
    made.verdicts.append(page.Verdict("Loading rate", kind, sentence + " in every scene (reference's doubt included)."))
    return made


def reference_line(references: dict[str, Reference]) -> str:
    """What the errors are measured against."""
    said = [
        f"{QUANTITIES[q]} {r.value:.6g} {'Pa' if q == 'peak' else 'J'} ({r.kind}, "
        + (f"± {page.percent(r.uncertainty / abs(r.value))})" if r.uncertainty else "exact)")
        for q, r in references.items()
    ]
    return page.paragraph("Reference: " + "; ".join(said) + ".", "note")


def times(records: list[dict], doubts: dict[str, float]) -> str:
    """The table of times to 1 % and to 0.1 %, by knob and quantity."""
    by_quantity = {q: lines_of(records, q) for q in QUANTITIES}
    rows = []
    for knob in by_quantity["peak"]:
        cells: list[str | page.Cell] = [knob]
        for q in QUANTITIES:
            for target in (0.01, 0.001):
                found = time_to(by_quantity[q].get(knob, []), target)
                cells.append(
                    page.Cell("-", "none", f"reference only to {page.percent(doubts[q])}")
                    if doubts[q] > target
                    else page.Cell(f"{found[0]:.2g} s", "ok", f"at {found[1]}")
                    if found
                    else "not reached"
                )
        rows.append(cells)
    header = ["knob", *(f"{words} to {target}" for words in QUANTITIES.values() for target in ("1 %", "0.1 %"))]
    return page.table(header, rows, "Least time to come, and on all finer rungs to stay, this near to the reference")


def choose(case: str, records: list[dict], doubts: dict[str, float]) -> tuple[str, float]:
    """(what to choose in a sentence, the shipped loading's largest error with the reference's doubt added)."""
    within: dict[str, float] = {}
    seconds: dict[str, float] = {}
    shipped_with_doubt = 0.0
    for q in QUANTITIES:
        for time, error, label in lines_of(records, q)[ACCURACY]:
            within[label] = max(within.get(label, 0.0), abs(error))
            seconds[label] = time
            if label == SHIPPED:
                shipped_with_doubt = max(shipped_with_doubt, abs(error) + doubts[q])
    shipped = f"as shipped it takes {seconds[SHIPPED]:.2g} s and is within {page.percent(within[SHIPPED])}"
    doubt = (
        f" The reference itself is known only to within {page.percent(max(doubts.values()))}."
        if any(doubts.values())
        else ""
    )
    good = [label for label in within if within[label] <= TARGET]
    if not good:
        return f"{case}: ask for more than shipped to come within 1 %; {shipped}.{doubt}", shipped_with_doubt
    best = min(good, key=lambda label: seconds[label])
    if best == SHIPPED:
        return f"{case}: to come within 1 % keep the accuracy as shipped; {shipped}.{doubt}", shipped_with_doubt
    sentence = f"{case}: to come within 1 % an accuracy of {best} does: {seconds[best]:.2g} s, within "
    return f"{sentence}{page.percent(within[best])}; {shipped}.{doubt}", shipped_with_doubt
