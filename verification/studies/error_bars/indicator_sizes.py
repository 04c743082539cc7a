"""Sizes of errors of resolution by the estimates of doubts, beyond their limits or not, and of which numbers."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from masonry.estimates.closed_joints import corner_friction, may_turn_otherwise, movement_error, strength_decides
from masonry.estimates.crushed_edges import crushing_error
from masonry.estimates.hinged_joints import hinges_of, lacking_moments
from masonry.estimates.inspection import Inspection
from masonry.estimates.meshes.tet_energy import excess_energies, friction_decides
from masonry.estimates.strength.strength_error import strength_error
from masonry.judgement.doubt import Criterion
from masonry.judgement.evidence import Evidence
from masonry.rows.columns import CRUSHING, FACTOR

POINTS, TETS, PACE, TIME_STEP = "points", "size of tets", "pace", "time step"
STRENGTH = ("peak_stress_pa", "collapse_load.borne")
ENDS = ("peak_stress_pa", "final_stress_pa", "dissipated_j")
MOVEMENTS = ("initial_stiffness_pa_per_m",)


class ErrorOf(NamedTuple):
    """Of which numbers a doubt tells the error, by which part; the worst of them counts."""

    part: str
    numbers: tuple[str, ...]


CLAIMS = {
    "few_points": ErrorOf(POINTS, STRENGTH),
    "hinges": ErrorOf(POINTS, STRENGTH),
    "closed_joints": ErrorOf(POINTS, MOVEMENTS),
    "corner_friction": ErrorOf(POINTS, STRENGTH),
    "crushing_energy": ErrorOf(POINTS, ("energy_j.crushing",)),
    "coarse_mesh": ErrorOf(TETS, MOVEMENTS),
    "peak_between_steps": ErrorOf(PACE, ("peak_stress_pa",)),
    "not_quasi_static": ErrorOf(PACE, ENDS),
    "dissipation": ErrorOf(PACE, ("dissipated_j",)),
    "mode_2_energy": ErrorOf(PACE, ("dissipated_j",)),
    "coarse_swings": ErrorOf(TIME_STEP, ("shaking.gauges.sway.peak",)),
    "coarse_shaking": ErrorOf(TIME_STEP, ("shaking.gauges.sway.peak",)),
}


def sizes_of(
    inspection: Inspection, evidence: Evidence, questions: Sequence[Criterion]
) -> dict[str, tuple[float, float]]:
    """By name of a doubt, the size that it tells or would tell, and its limit."""
    sizes = {}
    for criterion in questions:
        limit = criterion.limit(evidence) if callable(criterion.limit) else criterion.limit
        if criterion.name in CLAIMS and limit and criterion.asked_of(evidence):
            value = criterion.measure(evidence)
            if value is not None and not isinstance(value, bool):
                sizes[criterion.name] = float(value), float(limit)
    return sizes | _of_joints(inspection) | _of_tets(inspection)


def _of_joints(inspection: Inspection) -> dict[str, tuple[float, float]]:
    sizes, limit = {}, inspection.accuracy
    error = strength_error(inspection)
    sizes["few_points"] = (0.0 if error is None else error.ratio - 1.0), limit
    hinges = hinges_of(inspection.assembly, inspection.faces)
    if len(hinges.face):
        sizes["hinges"] = lacking_moments(inspection, hinges), limit
    if may_turn_otherwise(inspection):
        if not strength_decides(inspection):
            sizes["closed_joints"] = movement_error(inspection), limit
        elif not inspection.assembly.scene.is_large:
            rubs, twists = corner_friction(inspection)
            sizes["corner_friction"] = 0.02 * (rubs >= 0.1 and twists >= 1e-3), limit
    rows, last = inspection.outcome.history.rows, inspection.frames[-1]
    if CRUSHING in rows and FACTOR not in rows and last.crushing is not None:
        energy, work = float(rows[CRUSHING][-1]), float(np.abs(rows["external_work"]).max())
        if energy > 0.0:
            sizes["crushing_energy"] = energy / work * crushing_error(inspection, last.crushing), 0.03
    return sizes


def _of_tets(inspection: Inspection) -> dict[str, tuple[float, float]]:
    mesh = inspection.assembly.mesh
    if mesh is None or friction_decides(inspection):
        return {}
    worst = max(excess.of_all for excess in excess_energies(inspection, mesh))
    return {"coarse_mesh": (worst, max(inspection.accuracy, 0.05))}


def error_of(claim: ErrorOf, runs: Mapping[str, Mapping[str, float]]) -> float | None:
    """The error of a part: of the worst of its numbers, the value of the scene over the refined one, less one; of
    movements, by how much they are too small. A stress at the end is set beside the peak, what crushing took beside the
    work. None where no such number is there."""
    base, finer = runs.get("", {}), runs.get(claim.part)
    errors = []
    for key in claim.numbers:
        if finer is None or key not in base or not finer.get(key):
            continue
        scale = base[key] if key in MOVEMENTS else finer[key]
        if key == "final_stress_pa":
            scale = finer.get("peak_stress_pa", scale)
        elif key == "energy_j.crushing":
            scale = finer.get("energy_j.external_work", scale)
        errors.append((base[key] - finer[key]) / abs(scale))
    return max(errors, key=abs, default=None)
