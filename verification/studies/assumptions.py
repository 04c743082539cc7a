"""How much the answer moves with each assumption and option: a tornado for each shipped scene."""

import math
from collections.abc import Callable
from typing import Any

from verification.report import figures, page
from verification.studies import trial
from verification.studies.variations import Variation, assumed, options

ORDER = 50
PANELS = {"peak": "peak stress", "final": "final stress, of the peak", "dissipated": "dissipated energy"}
MATTERS, FELT = 0.10, 0.05
QUICK: dict[str, dict[str, Any]] = {
    "couplet": {"drive.steps": 5000, "solver.rows": 200},
    "wallette-mode-1": {"drive.rate": "8 mm/s", "solver.rows": 200},
    "wallette-mode-2": {"drive.rate": "4 mm/s", "solver.rows": 200},
}
"""The pace of the base runs: constant and fast, so that the error of the loading nearly cancels in a change."""
SHIPPED = {"drive.accuracy": "1 %"}
"""The shipped pace, in the words of the ladders, so that these runs are not made twice."""


def chapter(
    tell: Callable[[str], None], cases: tuple[str, ...] = tuple(QUICK), only: tuple[str, ...] = ()
) -> page.Chapter:
    """All numeric assumptions and the open options of each scene (`only`: entries that end so), varied one by one."""
    made = page.Chapter("Assumptions varied")
    made.parts.append(
        page.paragraph(
            "What the paper does not give is assumed, and each assumption is varied by itself here, both ways where "
            "that makes sense. A bar spans all the variations of one entry: orange up, blue down. The final stress is "
            "given in percent of the base's peak, as it is close to nothing where a crack opens in full. Base and "
            "varied run are both loaded at the same constant and fast rate; the accuracy of the drive is varied from "
            "the shipped one."
        )
    )
    largest: list[tuple[float, str]] = []
    for case in cases:
        given, without = assumed(case)
        wanted = [v for v in [*given, *options(case)] if not only or v.entry.endswith(only)]
        tell(f"assumptions: {case}, {len(wanted)} variations")
        made.parts.append(page.heading(case))
        pairs = [(v, *change(case, v)) for v in wanted]
        made.records += [entry for _, _, records in pairs for entry in records]
        done = [(v, changes) for v, changes, _ in pairs if changes]
        largest += [
            (max(map(abs, changes[::2])), f"{v.entry} in {case}")
            for v, changes in done
            if not v.entry.startswith("drive")
        ]
        made.parts += pictures(case, done)
        refused = [f"{v.entry} = {v.label}: {records[0]['status']}" for v, changes, records in pairs if not changes]
        aside = [*refused, *(f"{key}: {why}" for key, why in without.items())]
        if aside:
            made.parts += [page.paragraph("Not varied:"), page.bullets(aside)]
    made.verdicts.append(verdict(largest))
    return made


def change(case: str, v: Variation) -> tuple[list[float], list[dict]]:
    """(changes of PANELS as shares, records); no changes where one of the two runs did not come through."""
    base = trial.run(case, {**QUICK[case], **v.base})
    knobs = {**QUICK[case], **v.base, **v.knobs}
    if "drive.accuracy" in v.knobs:
        base, knobs = trial.run(case, SHIPPED), v.knobs
    one = trial.run(case, knobs)
    fine = one.ok and base.ok
    records = []
    for quantity in PANELS:
        value, reference = (t.value(quantity) if fine else math.nan for t in (one, base))
        scale = base.value("peak") if quantity == "final" and fine else 0.0
        entry = trial.record(one, quantity, value, reference, "same scene, assumption as shipped", scale)
        records.append(entry | {"knob": v.entry, "rung": v.label})
    return [r["error"] for r in records if r["error"] is not None], records


def pictures(case: str, done: list[tuple[Variation, list[float]]]) -> list[str]:
    """The tornado of the entries that are felt, and the table of them all."""
    entries: dict[str, list[tuple[str, list[float]]]] = {}
    for v, changes in done:
        entries.setdefault(v.entry, []).append((v.label, [100.0 * c for c in changes]))
    size = {e: max(abs(c) for _, changes in entries[e] for c in changes) for e in entries}
    order = sorted(entries, key=lambda e: -size[e])
    felt = [e for e in order if size[e] >= FELT]
    bars = [(e, [[changes[k] for _, changes in entries[e]] for k in range(len(PANELS))]) for e in felt]
    rows = [[f"{e} = {label}", *(f"{c:+.2f}" for c in changes)] for e in order for label, changes in entries[e]]
    header = ["assumption or option, and what it was set to", *(f"{t} [%]" for t in PANELS.values())]
    caption = f"{case}: change of peak, final stress and dissipated energy with each assumption, largest on top."
    quiet = ", ".join(e for e in order if e not in felt) or "none"
    unfelt = page.paragraph(f"Without effect (less than {FELT} % on each of the three): {quiet}.")
    folded = page.folded(f"All {len(rows)} variations as numbers", page.table(header, rows))
    drawn = [page.picture(figures.tornado(bars, list(PANELS.values())), caption)] if bars else []
    return [*drawn, unfelt, folded]


def verdict(largest: list[tuple[float, str]]) -> page.Verdict:
    """How many assumptions move peak or energy by more than 10 %, and which most."""
    matter = {what for size, what in largest if size > MATTERS}
    names = {what for _, what in largest}
    top: list[str] = []
    for size, what in sorted(largest, reverse=True):
        if len(top) < 3 and not any(said.startswith(what) for said in top):
            top.append(f"{what} ({page.percent(size)})")
    sentence = (
        f"{len(matter)} of {len(names)} assumptions and options move peak or dissipated energy by more than "
        f"{page.percent(MATTERS)}; most of all {', '.join(top)}. These are doubts about the model, not errors in "
        "solving it."
    )
    return page.Verdict("Assumptions", "warn" if matter else "ok", sentence)
