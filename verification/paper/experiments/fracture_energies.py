"""Section 6: fracture energies of the joints in failure mode 1, of the units in failure mode 2 (Figs. 17 to 19)."""

from typing import Any

from masonry.laboratory.result import Result
from verification.html import page
from verification.paper import pictures
from verification.paper.experiment import Done, Experiment, Run, Section
from verification.paper.walls.common import CLAMPED, HINGED, MODE_1, MODE_2, quick_enough, table_of_runs
from verification.paper.walls.energy_claims import first_mode_claims, second_mode_claims

KEYS = {"GI": "fracture_energy_mode_1", "GII": "fracture_energy_mode_2"}
JOINTS, UNITS = "contact.unit_unit", "contact.within_units"
IN_JOINTS = {"GI": 5.0, "GII": 15.0}
IN_UNITS = {"GI": 8.0, "GII": 20.0}
"""N/m: Table 3 for the joints in mode 1, section 5.2 for the units in mode 2."""
FIRST_FACTORS: dict[str, tuple[float, ...]] = {"GI": (0.5, 1, 2, 4), "GII": (0.5, 1, 2, 4)}
SECOND_FACTORS: dict[str, tuple[float, ...]] = {"GI": (0.5, 1, 2, 2.5, 4), "GII": (1, 2, 4)}
"""2 times GI is "2 (GI) of the interface" of Fig. 19, 2.5 times its 20 N/m: the paper has both in one caption."""
HINGE, HELD = "hinge", "plates do not turn"
GRID, CELLS, CELLS_HELD = "grid", "218 cells", "218 cells, plates do not turn"
HOLDS: dict[str, dict[str, Any]] = {HELD: {}, HINGE: HINGED}
DIVISIONS: dict[str, tuple[str, dict[str, Any]]] = {
    GRID: (MODE_2, {}),
    CELLS: (f"{MODE_2}-218", {}),
    CELLS_HELD: (f"{MODE_2}-218", CLAMPED),
}


def first(hold: str, kind: str, factor: float) -> str:
    """The label of a run of mode 1."""
    return f"mode 1, {hold}, joints' {kind} x {factor:g}" if factor != 1 else f"mode 1, {hold}"


def second(division: str, kind: str, factor: float) -> str:
    """The label of a run of mode 2."""
    return f"mode 2, {division}, units' {kind} x {factor:g}" if factor != 1 else f"mode 2, {division}"


def runs(quick: bool) -> dict[str, Run]:
    """Each energy by itself; a quick look takes plates that do not turn in mode 1, and cells on a hinge in mode 2."""
    made = {}
    for hold in holds(quick):
        for kind, factors in FIRST_FACTORS.items():
            for f in factors:
                given = {**HOLDS[hold], **_energy(JOINTS, kind, f * IN_JOINTS[kind])}
                made[first(hold, kind, f)] = Run(MODE_1, given, pace_check=True)
    for division in divisions(quick):
        scene, held = DIVISIONS[division]
        for kind, factors in SECOND_FACTORS.items():
            for f in factors:
                given = {**held, **_energy(UNITS, kind, f * IN_UNITS[kind])}
                made[second(division, kind, f)] = Run(scene, given, pace_check=division != CELLS_HELD)
    return quick_enough(made, quick)


def holds(quick: bool) -> tuple[str, ...]:
    """How the plates are held in mode 1."""
    return (HELD,) if quick else tuple(HOLDS)


def divisions(quick: bool) -> tuple[str, ...]:
    """The units' divisions in mode 2."""
    return (CELLS,) if quick else tuple(DIVISIONS)


def _energy(group: str, kind: str, value: float) -> dict[str, Any]:
    return {f"{group}.{KEYS[kind]}": f"{value:g} N/m"}


def series(done: Done, name: str, kind: str) -> dict[float, Result]:
    """Factor of an energy -> result, for a hold of mode 1 or a division of mode 2."""
    label, factors = (first, FIRST_FACTORS) if name in HOLDS else (second, SECOND_FACTORS)
    return {f: done[label(name, kind, f)] for f in factors[kind]}


def show(done: Done) -> Section:
    """Curves and cracks by energy."""
    parts = []
    for hold in holds(done.quick):
        panels = {f"{kind} of the joints, {hold}": _lines(series(done, hold, kind), IN_JOINTS[kind]) for kind in KEYS}
        parts.append(page.picture(pictures.curves(panels), f"Fig. 17, ours: failure mode 1, {hold}."))
    for division in divisions(done.quick):
        panels = {
            f"{kind} of the units, {division}": _lines(series(done, division, kind), IN_UNITS[kind]) for kind in KEYS
        }
        parts.append(page.picture(pictures.curves(panels), f"Fig. 18, ours: failure mode 2, {division}."))
    tension, shear = series(done, CELLS, "GI"), series(done, CELLS, "GII")
    drawn = {f"GI of the units {8 * f:g} N/m": tension[f] for f in (1, 2, 2.5)} | {"GII of the units 80 N/m": shear[4]}
    parts.append(
        page.picture(pictures.cracks(drawn), "Fig. 19, ours: failure mode 2, 218 cells, at the end.", pixels=True)
    )
    labels = [label for label in done.asked if done.has(label)]
    parts.append(page.folded(f"All {len(labels)} runs as numbers", "".join(table_of_runs(done, labels))))
    firsts = {hold: {kind: series(done, hold, kind) for kind in KEYS} for hold in holds(done.quick)}
    seconds = {division: {kind: series(done, division, kind) for kind in KEYS} for division in divisions(done.quick)}
    return Section(parts, [*first_mode_claims(firsts), *second_mode_claims(seconds)])


def _lines(results: dict[float, Result], unit: float) -> list[pictures.Line]:
    return [pictures.stress_line(f"{f * unit:g} N/m", result) for f, result in results.items()]


EXPERIMENT = Experiment("fracture-energies", "Fracture energies (Figs. 17 to 19)", 41, runs, show)
