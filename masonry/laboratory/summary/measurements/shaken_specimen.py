"""Motion of the ground, and its effect on the specimen: gauges, uplift, the largest force, the energy that came in."""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.model.gauges import Gauge
from masonry.results.summary import GaugeSwing, GroundComponent, LargestForce, Shaking, Uplift
from masonry.rows.columns import INPUT_ENERGY
from masonry.timeloop.run_outcome import Outcome


def shaking(assembly: Assembly, outcome: Outcome) -> Shaking | None:
    """Of the rows since the settling; None where no ground moves. Times are those since the settling."""
    recording, rows = assembly.recording, outcome.history.rows
    if not assembly.scene.ground:
        return None
    settled = assembly.plan.settle * assembly.model.dt
    first = int(np.searchsorted(rows["step"], assembly.plan.settle))
    since = rows["time"][first:] - settled
    standing = slice(first, max(len(outcome.standing_rows["step"]), first + 1))
    grounds = {} if recording.ground is None else recording.ground.motions
    return Shaking(
        settled_s=settled,
        ground={
            axis: GroundComponent(
                peak_acceleration_m_s2=motion.peak_acceleration,
                peak_velocity_m_s=motion.peak_velocity,
                peak_displacement_m=motion.peak_displacement,
                residual_velocity_m_s=motion.residual_velocity,
                residual_displacement_m=motion.residual_displacement,
                duration_s=motion.duration,
            )
            for axis, motion in grounds.items()
        },
        gauges={
            gauge.name: _swing(gauge, since, rows[gauge.name], standing) for gauge in recording.gauges if len(since)
        },
        uplift=_uplift(assembly, outcome, standing, settled),
        largest_force=_largest_force(assembly, outcome, standing, settled),
        input_energy_j=float(rows[INPUT_ENERGY][-1]) if INPUT_ENERGY in rows else None,
        kinetic_at_end=_kinetic_at_end(rows["kinetic"][first:]),
        moves_supports=bool(assembly.scene.moved_grounds),
        rows_a_second=float(1.0 / np.median(np.diff(since))) if len(since) > 1 else None,
    )


def _swing(gauge: Gauge, since: np.ndarray, reading: np.ndarray, standing: slice) -> GaugeSwing:
    """Of a gauge, from the end of the settling until a block had fallen; and what is left at the end."""
    change, left = reading[standing] - reading[standing.start], float(reading[-1] - reading[standing.start])
    k, height = int(np.argmax(np.abs(change))), gauge.height
    drifts = gauge.quantity == "displacement" and height > 0.0
    return GaugeSwing(
        quantity=gauge.quantity,
        peak=float(change[k]),
        time_s=float(since[k]),
        least=float(change.min()),
        most=float(change.max()),
        residual=left,
        height_m=height if drifts else None,
        peak_drift=float(abs(change[k]) / height) if drifts else None,
        residual_drift=abs(left) / height if drifts else None,
    )


def _kinetic_at_end(kinetic: np.ndarray) -> float | None:
    """The largest of the last twentieth of the rows, as what swings stands still twice a period, over the largest."""
    most = float(kinetic.max(initial=0.0))
    last = max(1, len(kinetic) // 20)
    return float(kinetic[-last:].max()) / most if most > 0.0 else None


def _uplift(assembly: Assembly, outcome: Outcome, standing: slice, settled: float) -> Uplift | None:
    """The widest that a joint opened until a block had fallen: what falls opens without end."""
    widest, rows = outcome.observed["widest"], outcome.history.rows
    if "widest_at" not in outcome.observed or not len(widest[standing]):
        return None
    row = standing.start + int(np.argmax(widest[standing]))
    contact, joints = int(outcome.observed["widest_at"][row]), assembly.joints
    if contact < 0:
        return None
    return Uplift(
        opening_m=float(widest[row]),
        time_s=float(rows["time"][row] - settled),
        between=assembly.model.two_blocks(int(joints.block_a[contact]), int(joints.block_b[contact])),
        at_m=joints.point[contact].tolist(),
    )


def _largest_force(assembly: Assembly, outcome: Outcome, standing: slice, settled: float) -> LargestForce | None:
    """Until a block had fallen: the blows of what falls are others."""
    observed, rows = outcome.observed, outcome.history.rows
    if "pair_force" not in observed or not len(observed["pair_force"][standing]):
        return None
    row = standing.start + int(np.argmax(observed["pair_force"][standing]))
    one, other = int(observed["pair_one"][row]), int(observed["pair_other"][row])
    if one < 0:
        return None
    return LargestForce(
        force_n=float(observed["pair_force"][row]),
        time_s=float(rows["time"][row] - settled),
        between=assembly.model.two_blocks(one, other),
    )
