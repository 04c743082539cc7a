"""The energy ledger of a run as stacked areas."""

from typing import Any

import numpy as np

LEDGER = {
    "elastic_blocks": ("elastic, blocks", "#9ecae1"),
    "elastic_contacts": ("elastic, contacts", "#4a90c2"),
    "fracture_mode_1": ("fracture, mode I", "#d7301f"),
    "fracture_mode_2": ("fracture, mode II", "#fc8d59"),
    "friction": ("friction", "#fdcc8a"),
    "dashpot": ("dashpots", "#8c6bb1"),
    "damping": ("damping", "#bdbdbd"),
    "kinetic": ("kinetic", "#78c679"),
}
"""The terms that together make up the external work: label and colour."""


def draw_ledger(axes: Any, rows: dict[str, np.ndarray], displacement: np.ndarray) -> None:
    """Stacked areas of the terms that there are; one that is clearly negative somewhere is drawn as a line."""
    terms = {name: rows[name] for name in LEDGER if name in rows and rows[name].any()}
    size = max((float(np.abs(values).max()) for values in terms.values()), default=0.0)
    floor = -1e-3 * size
    stacked = [name for name, values in terms.items() if values.min() >= floor]
    if stacked:
        areas = axes.stackplot(
            displacement,
            [np.maximum(terms[name], 0.0) for name in stacked],
            colors=[LEDGER[name][1] for name in stacked],
            labels=[LEDGER[name][0] for name in stacked],
        )
        for area in areas:
            area.set_linewidth(0.0)
    for name in terms:
        if name not in stacked:
            label, colour = LEDGER[name]
            axes.plot(displacement, terms[name], ":", color=colour, linewidth=2.0, label=f"{label} (not stacked)")
    if "external_work" in rows:
        axes.plot(displacement, rows["external_work"], color="black", linewidth=1.4, label="external work")
