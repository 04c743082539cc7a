"""How far blocks moved, and what fell in large displacement, when, and at which drive, tilt and loads."""

from math import degrees

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.laboratory.summary.beginning_of_fall import beginning
from masonry.laboratory.summary.measurements.free_swing import free_swings
from masonry.laboratory.summary.measurements.shaken_specimen import shaking
from masonry.laboratory.summary.moved_drive import moved_drive
from masonry.model.damping import swing_of
from masonry.monitors.collapse import Fallen
from masonry.monitors.collisions.collision import Met
from masonry.monitors.shaking_watch import BY_GROUND
from masonry.results.summary import CollapseLoad, FirstFall, Moment, Movements
from masonry.rows.columns import TILT
from masonry.timeloop.run_outcome import Outcome

LATE = 0.04
"""Share of a place of the drive, a tilt or a load by which that may change while a fall gains speed: with more it is
not known where the fall began."""

STEADILY = "it went down no faster than the drive made it, so it may stand"


def movements(assembly: Assembly, outcome: Outcome) -> Movements:
    """The largest turn and overlap; in large displacement whether it is a motion in time, and what fell."""
    grown = outcome.loading.collapse_load(outcome.history.rows, assembly.specimen.sets)
    observed, large, scene = outcome.observed, assembly.scene.is_large, assembly.scene
    met = outcome.records.get(Met)
    return Movements(
        rotation_max_rad=float(observed["rotation"].max()),
        overlap_max=float(observed["overlap"].max()),
        met="" if met is None else met.words or ("" if outcome.stopped else met.at_end),
        in_real_time=not assembly.model.scaled if scene.moves_in_time else None,
        free_swings=free_swings(assembly, outcome),
        damping_after_settling=swing_of(scene.damping).words if scene.swings else None,
        collapse=_collapse(assembly, outcome) if large else None,
        collapse_load=None if grown is None else CollapseLoad.read(grown),
        shaking=shaking(assembly, outcome),
        drive=moved_drive(assembly),
    )


def _collapse(assembly: Assembly, outcome: Outcome) -> FirstFall | None:
    """The first block to fall: its number, set and place at the start; time, drive and force when it had; energies.

    `began` says the same of when the fall began: the last row before at which nothing moved but as the drive does. None
    without one, and where too much changed while the fall gained speed, which `began_unknown` then says.
    """
    if (fallen := outcome.records.get(Fallen)) is None:
        return None
    rows, specimen, block = outcome.history.rows, assembly.specimen, fallen.block
    row = int(np.searchsorted(rows["step"], fallen.step))
    last, time = (
        (None, 0.0) if assembly.scene.ground else beginning(rows, row)
    )  # what is shaken is never at rest before
    began = None if last is None else _moment(assembly, rows, last)
    first = int(np.searchsorted(rows["time"], time, side="right")) - 1
    setting_out = None if last is None else _moment(assembly, rows, first)
    unknown = STEADILY if last == row else not_known(setting_out, began)
    return FirstFall(
        **_moment(assembly, rows, row),
        block=block,
        sets=sorted(name for name, members in specimen.sets.items() if block in members),
        at_m=assembly.model.layout.centroid[block].tolist(),
        began=None if unknown else began,
        began_unknown=unknown,
        blow_pa=outcome.blow / specimen.section if outcome.blow > outcome.peak_force else None,
        energy_j=fallen.energies,
    )


def not_known(setting_out: Moment | None, began: Moment | None) -> str:
    """Why it is not known where a fall began, in words, from when it set out and when that showed; "" where it is."""
    if setting_out is None or began is None:
        return ""
    before, after = (
        {
            "drive": (1e3 * moment.displacement_m, "mm"),
            "tilt": (degrees(moment.tilt_rad or 0.0), "deg"),
            **{name: (share, "of its value") for name, share in (moment.loads or {}).items()},
        }
        for moment in (setting_out, began)
    )
    changed = [
        f"the {name} went from {before[name][0]:.4g} to {value:.4g} {unit}"
        for name, (value, unit) in after.items()
        if abs(value - before[name][0]) > LATE * abs(value)
    ]
    return f"{' and '.join(changed)} while it gained speed: drive or load more slowly" if changed else ""


def _moment(assembly: Assembly, rows: dict[str, np.ndarray], row: int) -> Moment:
    """When, and at which drive, tilt and shares of loads that have a history."""
    step = int(rows["step"][row])
    return Moment(
        step=step,
        time_s=float(rows["time"][row]),
        displacement_m=float(rows["displacement"][row]),
        force_n=float(rows["force"][row]),
        tilt_rad=float(rows[TILT][row]) if TILT in rows else None,
        loads=_varying(assembly, step) or None,
    )


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
        if load.varies is not None
        and load.varies >= layers
        and not (tilts and load.name.startswith("gravity"))
        and not load.name.startswith(BY_GROUND)
    }
