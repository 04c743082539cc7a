"""How a tornado is made: what is measured, the picture of what is felt, the table of all, and the verdict."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from verification.html import figures, page
from verification.paper.variations import Variation

MATTERS, FELT = 0.10, 0.5
"""A share above which an assumption matters; percent below which nothing is felt of it."""


@dataclass(frozen=True)
class Measure:
    """A panel: its title, keys of a row that it adds up, their unit, whether changes are given of the base's peak."""

    title: str
    keys: tuple[str, ...]
    unit: str
    of_the_peak: bool = False

    def of(self, row: Mapping[str, Any]) -> float:
        """The value in a row of the sweep engine."""
        return float(sum(row[key] for key in self.keys))


PANELS = {
    "peak": Measure("peak stress", ("peak_stress_pa",), "Pa"),
    "final": Measure("final stress, of the peak", ("final_stress_pa",), "Pa", of_the_peak=True),
    "dissipated": Measure(
        "dissipated energy", ("energy_j.fracture_mode_1", "energy_j.fracture_mode_2", "energy_j.friction"), "J"
    ),
}


def pictures(case: str, done: Sequence[tuple[Variation, list[float]]]) -> list[str]:
    """The tornado of the entries that are felt, and the table of them all."""
    entries: dict[str, list[tuple[str, list[float]]]] = {}
    for v, changes in done:
        entries.setdefault(v.entry, []).append((v.label, [100.0 * c for c in changes]))
    size = {e: max(abs(c) for _, changes in entries[e] for c in changes) for e in entries}
    order = sorted(entries, key=lambda e: -size[e])
    felt = [e for e in order if size[e] >= FELT]
    bars = [(e, [[changes[k] for _, changes in entries[e]] for k in range(len(PANELS))]) for e in felt]
    rows = [[f"{e} = {label}", *(f"{c:+.2f}" for c in changes)] for e in order for label, changes in entries[e]]
    titles = [measure.title for measure in PANELS.values()]
    header = ["assumption or option, and what it was set to", *(f"{title} [%]" for title in titles)]
    caption = f"{case}: change of peak, final stress and dissipated energy with each assumption, largest on top."
    quiet = ", ".join(e for e in order if e not in felt) or "none"
    unfelt = page.paragraph(f"Without effect (less than {FELT} % on each of the three): {quiet}.")
    folded = page.folded(f"All {len(rows)} variations as numbers", page.table(header, rows))
    drawn = [page.picture(figures.tornado(bars, titles), caption)] if bars else []
    return [*drawn, unfelt, folded]


def verdict(largest: Sequence[tuple[float, str]]) -> page.Verdict:
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
