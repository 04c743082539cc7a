"""What fell in large displacement, when, and at which drive, tilt and loads."""

from math import degrees
from typing import Any

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.laboratory.summary.beginning_of_fall import beginning
from masonry.rows.columns import TILT
from masonry.rows.peak import before_a_collapse
from masonry.timeloop.recording import Outcome

LATE = 0.04
"""Share of a place of the drive, a tilt or a load by which that may change while a fall gathers way: with more it is
not known where the fall began."""

STEADILY = "it went down no faster than the drive made it, so it may stand"


def of_large(assembly: Assembly, outcome: Outcome) -> dict[str, Any]:
    """Whether the run is one in real time, with the masses as they are; and what fell."""
    return {"in_real_time": not assembly.model.scaled, "collapse": _collapse(assembly, outcome)}


def _collapse(assembly: Assembly, outcome: Outcome) -> dict[str, Any] | None:
    """The first block to fall: its number, set and place at the start; time, drive and force when it had; energies.

    `began` says the same of when the fall began: the last row before at which nothing moved but as the drive does. None
    without one, and where too much changed while the fall gathered way, which `began_unknown` then says.
    """
    if outcome.found["collapse"] is None:
        return None
    block, step, energies = outcome.found["collapse"]
    rows, specimen = outcome.history.rows, assembly.specimen
    row = int(np.searchsorted(rows["step"], step))
    last, time = beginning(rows, row)
    began = None if last is None else _moment(assembly, rows, last)
    set_out = (
        None if last is None else _moment(assembly, rows, int(np.searchsorted(rows["time"], time, side="right")) - 1)
    )
    unknown = STEADILY if last == row else not_known(set_out, began)
    return {
        "block": block,
        "sets": sorted(name for name, members in specimen.sets.items() if block in members),
        "at_m": assembly.model.layout.centroid[block].tolist(),
        **_moment(assembly, rows, row),
        "began": None if unknown else began,
        "began_unknown": unknown,
        "blow_pa": outcome.blow / specimen.section if outcome.blow > outcome.peak_force else None,
        "energy_j": energies,
    }


def not_known(set_out: dict[str, Any] | None, began: dict[str, Any] | None) -> str:
    """Why it is not known where a fall began, in words, from when it set out and when that showed; "" where it is."""
    if set_out is None or began is None:
        return ""
    one, two = (
        {
            "drive": (1e3 * moment.get("displacement_m", 0.0), "mm"),
            "tilt": (degrees(moment.get("tilt_rad", 0.0)), "deg"),
            **{name: (share, "of its value") for name, share in moment.get("loads", {}).items()},
        }
        for moment in (set_out, began)
    )
    changed = [
        f"the {name} went from {one[name][0]:.4g} to {value:.4g} {unit}"
        for name, (value, unit) in two.items()
        if abs(value - one[name][0]) > LATE * abs(value)
    ]
    return f"{' and '.join(changed)} while it gathered way: drive or load more slowly" if changed else ""


def standing_rows(outcome: Outcome) -> dict[str, np.ndarray]:
    """The rows at which no block had fallen, and that at which the first one had."""
    fallen = outcome.found.get("collapse")
    return before_a_collapse(outcome.history.rows, None if fallen is None else fallen[1])


def _moment(assembly: Assembly, rows: dict[str, np.ndarray], row: int) -> dict[str, Any]:
    """When, and at which drive, tilt and shares of loads that have a history."""
    keys = {"time": "time_s", "displacement": "displacement_m", "force": "force_n", TILT: "tilt_rad"}
    numbers = {name: float(rows[key][row]) for key, name in keys.items() if key in rows}
    step = int(rows["step"][row])
    return {"step": step, **numbers, **({"loads": loads} if (loads := _varying(assembly, step)) else {})}


def _varying(assembly: Assembly, step: int) -> dict[str, float]:
    """By load that has a history: its share at a step. A tilt of gravity is told as such."""
    plan = assembly.plan
    if (load_factors := plan.factors_at(np.array([step]))) is None:
        return {}
    tilts = assembly.scene.gravity is not None and assembly.scene.gravity.tilt is not None
    layers = 0 if plan.layers is None else len(plan.layers)
    return {
        load.name: float(load_factors[load.varies, 0])
        for load in assembly.recording.surroundings.loads
        if load.varies is not None and load.varies >= layers and not (tilts and load.name.startswith("gravity"))
    }
