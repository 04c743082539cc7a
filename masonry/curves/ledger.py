"""The energy ledger of a run as stacked areas."""

from typing import Any

import numpy as np

from masonry.rows.columns import INPUT_ENERGY

LEDGER = {
    "elastic_blocks": ("elastic, blocks", "#9ecae1"),
    "elastic_contacts": ("elastic, contacts", "#4a90c2"),
    "elastic_bars": ("elastic, bars", "#08519c"),
    "plastic_bars": ("yielding of bars", "#54278f"),
    "fracture_mode_1": ("fracture, mode I", "#d7301f"),
    "fracture_mode_2": ("fracture, mode II", "#fc8d59"),
    "crushing": ("crushing", "#7f0000"),
    "friction": ("friction", "#fdcc8a"),
    "dashpot": ("dashpots", "#8c6bb1"),
    "damping": ("damping", "#bdbdbd"),
    "kinetic": ("kinetic", "#78c679"),
}
"""The terms that together make up the external work: label and colour."""
ANEW, FOUND_ANEW = ("contacts found anew, turning", "#a6761d"), ("area", "redetection", "rotor")
"""Columns that are drawn as one: what large displacement loses as contacts are looked for anew, and as blocks turn."""
SHOWS = 1e-3
"""Share of the external work from which on they are."""


WORKS: dict[str, dict[str, Any]] = {
    "external_work": {"color": "black", "linewidth": 1.4, "label": "external work"},
    INPUT_ENERGY: {"linestyle": "--", "color": "#b2182b", "linewidth": 1.0, "label": "input of the ground"},
}
"""Lines over the areas."""


def draw_ledger(axes: Any, rows: dict[str, np.ndarray], displacement: np.ndarray) -> None:
    """Stacked areas of the terms that there are; one that is clearly negative somewhere is drawn as a line."""
    terms = {name: rows[name] for name in LEDGER if name in rows and rows[name].any()}
    if all(name in rows for name in FOUND_ANEW):
        lost = np.sum([rows[name] for name in FOUND_ANEW], axis=0)
        if np.abs(lost).max(initial=0.0) >= SHOWS * np.abs(rows["external_work"]).max(initial=0.0) > 0.0:
            terms[ANEW[0]] = lost
    key = {**LEDGER, ANEW[0]: ANEW}
    size = max((float(np.abs(values).max()) for values in terms.values()), default=0.0)
    floor = -1e-3 * size
    stacked = [name for name, values in terms.items() if values.min() >= floor]
    if stacked:
        areas = axes.stackplot(
            displacement,
            [np.maximum(terms[name], 0.0) for name in stacked],
            colors=[key[name][1] for name in stacked],
            labels=[key[name][0] for name in stacked],
        )
        for area in areas:
            area.set_linewidth(0.0)
    for name in terms:
        if name not in stacked:
            label, colour = key[name]
            axes.plot(displacement, terms[name], ":", color=colour, linewidth=2.0, label=f"{label} (not stacked)")
    for name in filter(rows.__contains__, WORKS):
        axes.plot(displacement, rows[name], **WORKS[name])
