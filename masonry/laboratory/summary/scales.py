"""The scales of a run: what a share of it is a share of, and the rows that count; made once."""

from dataclasses import dataclass

import numpy as np

from masonry.loading.plan import Plan
from masonry.model.model import Model
from masonry.monitors.reactions import WorkDone
from masonry.rows.columns import CRUSHING, dissipated_in
from masonry.rows.peak import before_a_fall, only_rises
from masonry.scene import Scene
from masonry.timeloop.run_outcome import Outcome

Rows = dict[str, np.ndarray]


@dataclass(frozen=True)
class Scales:
    """Scales against which quantities are measured, in SI, of n rows.

    in_real_time    whether the run is a motion in time: what moves will not be damped
    settled         number of the last row of the settling
    counting        (n,) bool, the rows at which a slow test is held against rest
    before_fall     the rows before the fall of a load that goes to and fro; all rows of any other run
    stress          the peak; the larger one of both directions where the drive turns back
    internal        (n,) J, what blocks and contacts have taken up; of joints without strength the work of the drive
    pushed          (n,) J, what the force of the drive has done, and taken back
    work            J, the most of the external work
    moved           J, the same, or the work of one load where that is more: a load that is lifted takes all work
    driven          J, the most of the work since the settling
    taken           J, what damping took since then
    dissipated      J, by cracks and friction
    lost            J, by cracks, friction and damping
    """

    in_real_time: bool
    settled: int
    counting: np.ndarray
    before_fall: Rows
    stress: float
    internal: np.ndarray
    pushed: np.ndarray
    work: float
    moved: float
    driven: float
    taken: float
    dissipated: float
    lost: float


def scales_of(scene: Scene, model: Model, plan: Plan, section: float, outcome: Outcome) -> Scales:
    """Of the outcome of a run; section: m2."""
    rows = outcome.history.rows
    settled = int(np.searchsorted(rows["step"], plan.settle, side="right")) - 1
    before_fall = before_a_fall(rows, outcome.loading.falls) if scene.loops_over else rows
    pushed, in_real_time = work_of_force(rows), scene.moves_in_time and not model.scaled
    work = float(np.abs(rows["external_work"]).max())
    moved = max(work, float(np.abs(outcome.records[WorkDone].by_load).max(initial=0.0)))
    dissipated = sum(float(rows[key][-1]) for key in dissipated_in(rows))
    taken = _taken(before_fall, settled, in_real_time)
    return Scales(
        in_real_time=in_real_time,
        settled=settled,
        counting=_counting(plan, outcome),
        before_fall=before_fall,
        stress=_stress(rows, outcome.peak_force / section, outcome.lowest_force / section),
        internal=_internal(rows, pushed if model.dry else None),
        pushed=pushed,
        work=work,
        moved=moved,
        driven=_driven(before_fall, settled, pushed if model.dry else None),
        taken=taken,
        dissipated=dissipated,
        lost=dissipated + max(taken, 0.0),
    )


def work_of_force(rows: Rows) -> np.ndarray:
    """(n,) J that the force of the drive has done so far; what it takes back counts as well."""
    force, path = np.abs(rows["force"]), np.abs(np.diff(rows["displacement"]))
    return np.concatenate([[0.0], np.cumsum(0.5 * (force[1:] + force[:-1]) * path)])


def first_damage(rows: Rows) -> float:
    """The step of the first row with damage; infinite without any."""
    damaged = rows["fracture_mode_1"] + rows["fracture_mode_2"] + rows.get(CRUSHING, 0.0) > 0.0
    return float(rows["step"][damaged][0]) if damaged.any() else np.inf


def _counting(plan: Plan, outcome: Outcome) -> np.ndarray:
    """Rows from the end of the drive's ramp on, or from the peak where it comes first; none within sudden cracks.

    A drive to an accuracy is fast while all is elastic, which harms nothing: it counts from the first damage on. Where
    all stays elastic its end counts, at which it has come to rest.
    """
    rows, stood = outcome.history.rows, outcome.standing_rows
    loaded = stood["step"] > plan.settle
    at_peak = stood["step"][loaded][int(np.argmax(stood["stress"][loaded]))] if loaded.any() else 0
    counting = (rows["step"] > plan.settle) & (rows["step"] >= min(plan.settle + plan.ramp, at_peak))
    if plan.hurries_while_elastic:
        counting &= rows["step"] >= min(first_damage(rows), at_peak)
    for event in outcome.events:
        counting &= (rows["step"] <= event.first) | (rows["step"] > event.last)
    if plan.hurries_while_elastic and not counting.any():
        counting[-1] = rows["step"][-1] > plan.settle
    return np.asarray(counting)


def _stress(rows: Rows, peak: float, lowest: float) -> float:
    """Pa, the larger of both directions where the drive turns back."""
    if not only_rises(rows["displacement"]):
        return max(peak, -lowest)
    return peak if peak > 0.0 else -lowest


def _internal(rows: Rows, pushed: np.ndarray | None) -> np.ndarray:
    """(n,) J: on the way back work comes back; and what rocks stores next to nothing, and gives its weight the work of
    the drive."""
    internal = rows["elastic_blocks"] + rows["contact_work"]
    if not only_rises(rows["displacement"]):
        internal = np.maximum.accumulate(internal)
    return np.asarray(internal if pushed is None else np.maximum(internal, pushed))


def _driven(rows: Rows, settled: int, pushed: np.ndarray | None) -> float:
    """J, the most of the external work since the settling, or of the drive's."""
    driven = float(np.abs(rows["external_work"][settled:] - rows["external_work"][settled]).max(initial=0.0))
    return driven if pushed is None else max(driven, float(pushed[len(rows["step"]) - 1]))


def _taken(rows: Rows, settled: int, in_real_time: bool) -> float:
    """J that damping took since the settling, and will take from what still moves."""
    braked = rows["damping"] if in_real_time else rows["damping"] + rows["kinetic"]
    return float(braked[-1] - braked[settled])
