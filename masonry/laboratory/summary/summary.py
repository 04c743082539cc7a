"""The numbers of summary.json, from an assembly and the outcome of its run."""

from dataclasses import asdict
from itertools import pairwise
from typing import Any

import numpy as np

from geometry.blocks import CellReport
from geometry.specimens.placed import FLOOR
from masonry import __version__
from masonry.assembly.assemble import Assembly
from masonry.assembly.schedule import tilt_at
from masonry.configuration.energy import open_in_contacts
from masonry.jit.sources import source_hash
from masonry.laboratory.summary.collapse import of_large, standing_rows
from masonry.laboratory.summary.rest import farthest_from_rest
from masonry.laboratory.summary.symmetry import is_loaded_alike, symmetry_lost
from masonry.monitors import events
from masonry.monitors.reactions import balance, moved_by, open_by, rounded
from masonry.results.joint_resultants import unit_joints
from masonry.results.provenance import own_sources
from masonry.rows.columns import DISSIPATED, LARGE_UNITS, TILT, UNITS
from masonry.rows.cycles import table
from masonry.rows.peak import at_peak, before_a_fall, only_rises
from masonry.scene import Scene
from masonry.timeloop.recording import Outcome

ENERGY_TERMS = [column for column, unit in UNITS.items() if unit == "J"]
BROKEN, DAMAGED = 0.95, 0.05
SUDDEN = 1e-3
"""Share of all energy lost, by cracks, friction and damping, from which on what a sudden crack released is told."""

MOVED = 1e-12
"""Openings and slips (m) up to this one, far less than an atom, are but rounding."""
ROUNDING = 1e-9
"""Share of the external work below which what sudden cracks released is but rounding."""
LITTLE = 1e-2
"""Share of the external work against which the bookings of the laws are held where they dissipated less: friction that
dilates by its own angle dissipates nothing, however much slides."""


def summarise(assembly: Assembly, outcome: Outcome) -> dict[str, Any]:
    """Keys in SI. Maxima are taken from the end of the drive's ramp, or from the peak where it comes first.

    A drive to an accuracy is fast while all is elastic, which harms nothing: it counts from the first damage on. Rows
    within sudden cracks do not count; what these released is told apart.
    """
    scene, model, rows = assembly.scene, assembly.model, outcome.history.rows
    plan = assembly.plan
    settled = rows["step"] > plan.settle
    stood = standing_rows(outcome)
    loaded = stood["step"] > plan.settle
    at_peak = stood["step"][loaded][int(np.argmax(stood["stress"][loaded]))] if loaded.any() else 0
    after = settled & (rows["step"] >= min(plan.settle + plan.ramp, at_peak))
    peak = outcome.peak_force / assembly.specimen.section
    lowest = outcome.lowest_force / assembly.specimen.section
    internal, highest = rows["elastic_blocks"] + rows["contact_work"], peak if peak > 0.0 else -lowest
    if not only_rises(rows["displacement"]):  # on the way back work comes back, and the force may be negative
        internal, highest = np.maximum.accumulate(internal), max(peak, -lowest)
    pushed = _work_of_force(rows)
    if model.dry:  # what rocks stores next to nothing, and gives its weight the work of the drive
        internal = np.maximum(internal, pushed)
    work = float(np.abs(rows["external_work"]).max())
    work_of_loads, observed = outcome.found["work_of_loads"], outcome.observed
    moved = max(work, float(np.abs(work_of_loads).max(initial=0.0)))  # a load that is lifted takes all work
    dynamic = after & (rows["step"] >= min(first_damage(rows), at_peak)) if plan.hurries_while_elastic else after
    after_settling = work_of_loads - outcome.found["work_of_loads_settling"]
    begun = int(np.searchsorted(rows["step"], plan.settle, side="right")) - 1  # the last row of the settling
    dissipated = sum(float(rows[key][-1]) for key in DISSIPATED)
    rest = before_a_fall(rows, outcome.loading.falls) if scene.loops_over else rows
    driven = float(np.abs(rest["external_work"][begun:] - rest["external_work"][begun]).max(initial=0.0))
    if model.dry:
        driven = max(driven, float(pushed[len(rest["step"]) - 1]))
    in_real_time = model.large is not None and not model.scaled
    braked = rest["damping"] if in_real_time else rest["damping"] + rest["kinetic"]  # what moves will not be damped
    taken = float(braked[-1] - braked[begun])
    settles = model.large is None or plan.settle > 0
    lost = dissipated + max(taken, 0.0)
    sudden = events.table(model, outcome.events, rows, max(SUDDEN * lost, ROUNDING * work))
    released = sum(event["released_j"] for event in sudden)
    for event in outcome.events:
        follows = (rows["step"] <= event.first) | (rows["step"] > event.last)
        dynamic = dynamic & follows
    mismatch = np.abs(rows["stress"] - rows["support_stress"])[dynamic]
    ratio = rows["kinetic"][dynamic] / np.maximum(internal[dynamic], max(1e-6 * work, 1e-300))
    standings, size = outcome.standing.values(), float(np.ptp(assembly.specimen.blocks.points, axis=0).max())
    last = {key: float(values[-1]) for key, values in rows.items()}
    torn = abs(open_in_contacts(last))
    scale = max(abs(dissipated), LITTLE * work) if model.large is None else moved  # what falls dissipates little
    laws = {name: scene.contact_of(name).law for name in model.group_names}
    kinematics = {g: scene.kinematics_of(g) for g in assembly.specimen.blocks.groups}
    return {
        "scene": scene.name,
        "law": _joined(laws),
        "kinematics": _joined(kinematics),
        "law_by_group": laws,
        "kinematics_by_group": kinematics,
        "blocks": assembly.specimen.blocks.count,
        "cells": [asdict(report) for report in assembly.specimen.cells],
        "scatter": {drawn.group: drawn.summary() for drawn in assembly.drawn},
        "contacts": len(model.group),
        "tets": 0 if assembly.mesh is None else len(assembly.mesh.tets),
        "freedoms": model.dofs,
        "steps": outcome.steps,
        "control": outcome.loading.control(),
        "seconds_run": outcome.seconds_run,
        "seconds_compile": outcome.seconds_compile,
        "time_step_s": model.dt,
        "step_fraction": scene.solver.step_fraction,
        "peak_stress_pa": peak,
        "displacement_at_peak_m": outcome.displacement_at_peak,
        "final_stress_pa": float(rows["stress"][-1]),
        "peak_force_n": outcome.peak_force,
        "lowest_stress_pa": lowest,
        "displacement_at_lowest_m": outcome.displacement_at_lowest,
        "cycles": table(rest, observed["widest"], scene.loops_over),
        **({"tilt_rad": float(rows[TILT][-1])} if TILT in rows else {}),
        "gauges": _readings(assembly, outcome),
        "reactions": _reactions(assembly, outcome),
        "force_balance": open_by(standings, size, rounded(model, float(rows["kinetic"].max()))),
        "motion_at_end": moved_by(outcome.standing["end"], standings, size) if "end" in outcome.standing else 0.0,
        "work_of_drive_j": 0.0
        if scene.drive is None
        else float(rows["external_work"][-1] - rows["external_work"][begun] - after_settling.sum()),
        **({} if model.large is None else {"work_of_force_j": float(pushed[-1])}),
        "work_of_loads_j": _work_of_loads(assembly, work_of_loads),
        "work_of_loads_after_settling_j": _work_of_loads(assembly, after_settling),
        "reaction_mismatch_max": float(mismatch.max() / highest) if highest > 0 and dynamic.any() else 0.0,
        "kinetic_over_internal_max": float(ratio.max()) if dynamic.any() else 0.0,
        "energy_j": {key: float(rows[key][-1]) for key in (*ENERGY_TERMS, *LARGE_UNITS) if key in rows},
        "energy_imbalance": float(np.abs(rows["imbalance"]).max() / moved) if moved > 0 else 0.0,
        "dissipation_mismatch": torn / scale if (dissipated or model.large is not None) and scale > 0.0 else 0.0,
        "unbalanced_after_settling": float(observed["unbalanced"][-1]) if settles else None,
        "kinetic_after_settling": float(observed["still_moving"][-1]) if settles else None,
        **farthest_from_rest(assembly, outcome, settles),
        "damping_over_external": (taken - released) / driven if driven > 0.0 else 0.0,
        "sudden_cracks": sudden,
        "released_over_dissipated": released / lost if sudden and lost > 0.0 else 0.0,
        "joints_opened_or_slid": _opened_or_slid(assembly),
        "broken_area_m2": areas_beyond(assembly, outcome, BROKEN),
        "damaged_area_m2": areas_beyond(assembly, outcome, DAMAGED),
        "symmetry_lost": symmetry_lost(
            model.joints, outcome.history.frames, lambda axis: is_loaded_alike(assembly, axis)
        ),
        "rotation_max_rad": float(observed["rotation"].max()),
        "overlap_max": float(observed["overlap"].max()),
        "mode_2_over_law": outcome.found["mode_2_over_law"],
        "slip_max": float(observed["slip"].max()) if "slip" in observed else 0.0,
        "met": outcome.found.get("met", ""),
        **({} if model.large is None else of_large(assembly, outcome)),
        **outcome.loading.summary(rows, assembly.specimen.sets),
        "slip_limit": scene.solver.slip_limit,
        "section_m2": assembly.specimen.section,
        "interrupted": outcome.interrupted,
        "stopped": outcome.stopped,
        "version": __version__,
        "source_hash": _sources(scene),
    }


def add_tilt(assembly: Assembly, outcome: Outcome) -> None:
    """The column of how far gravity is turned (rad), where it is."""
    rows = outcome.history.rows
    tilt = tilt_at(assembly.scene, assembly.plan, rows["step"])
    if tilt is not None:
        rows[TILT] = tilt


def _sources(scene: Scene) -> str:
    """Hash of our sources; behind a plus that of other packages, where the scene has a law or a specimen of them."""
    own = own_sources(contact.law for contact in scene.contact.values())
    return f"{source_hash()}+{own}" if own else source_hash()


def _readings(assembly: Assembly, outcome: Outcome) -> dict[str, dict[str, float]]:
    """By gauge: m at the peak (between the rows before and after it) and at the end."""
    stood, peak = standing_rows(outcome), outcome.displacement_at_peak
    return {
        gauge.name: {
            "at_peak_m": at_peak(stood, stood[gauge.name], peak),
            "final_m": float(outcome.history.rows[gauge.name][-1]),
        }
        for gauge in assembly.recording.gauges
    }


def _reactions(assembly: Assembly, outcome: Outcome) -> dict[str, Any]:
    """At the peak and at the end: what supports, drive and dead loads exert."""
    scene, outer = assembly.scene, assembly.recording.surroundings
    on = {f"support.{k}": support.on for k, support in enumerate(scene.support)} | {FLOOR: FLOOR}
    if scene.drive is not None:
        on["drive"] = scene.drive.on
    holds, loads = tuple((one.name, on[one.name]) for one in outer.holds), tuple(one.name for one in outer.loads)
    return {when: balance(holds, loads, standing) for when, standing in outcome.standing.items()}


def _work_of_loads(assembly: Assembly, work: np.ndarray) -> dict[str, float]:
    """By load: J."""
    return {load.name: float(done) for load, done in zip(assembly.recording.surroundings.loads, work, strict=True)}


def first_damage(rows: dict[str, np.ndarray]) -> float:
    """The step of the first row with damage; infinite without any."""
    damaged = rows["fracture_mode_1"] + rows["fracture_mode_2"] > 0.0
    return float(rows["step"][damaged][0]) if damaged.any() else np.inf


def cells_text(report: CellReport) -> str:
    """What a division into cells came to, in one line; h is the mean size of a cell."""
    joint = "" if report.shortest_joint is None else f", shortest joint piece {report.shortest_joint:.2g} h"
    return (
        f"{report.count} of h = {report.h * 1e3:.3g} mm: shortest edge {report.shortest_over_mean:.2g} of the mean, "
        f"{report.small_edges:.1%} small, sizes within {report.size_error:.1%}{joint}"
    )


def _joined(words: dict[str, str]) -> str:
    """One word where all agree, else all that occur: "elastic + exponential"."""
    return " + ".join(sorted(set(words.values())))


def _work_of_force(rows: dict[str, np.ndarray]) -> np.ndarray:
    """(n,) J that the force of the drive has done so far; what it takes back counts as well."""
    force, way = np.abs(rows["force"]), np.abs(np.diff(rows["displacement"]))
    return np.concatenate([[0.0], np.cumsum(0.5 * (force[1:] + force[:-1]) * way)])


def _opened_or_slid(assembly: Assembly) -> int | None:
    """Joints between units of which a contact has opened beyond its elastic limit, or slid, at any time; None where
    some are patches from the start, which do not remember it."""
    state, large = assembly.model.state, assembly.model.large
    if large is not None and len(large.bonded) < len(assembly.model.group_names):
        return None
    if state.opening_max is None:
        return 0
    opened = (state.intact_n < 1.0) & (state.opening_max > MOVED)
    moved = opened | (np.linalg.norm(state.slip, axis=1) > MOVED)
    found = unit_joints(assembly.specimen.blocks, assembly.joints)
    return sum(bool(moved[found.contact[a:b]].any()) for a, b in pairwise(found.start))


def areas_beyond(assembly: Assembly, outcome: Outcome, threshold: float) -> dict[str, float]:
    """Area (m2) by contact group whose combined damage is at least the threshold at the end."""
    damage = outcome.history.frames[-1].damage
    model = assembly.model
    return {
        name: float(model.joints.area[(model.group == g) & (damage >= threshold)].sum())
        for g, name in enumerate(model.group_names)
    }
