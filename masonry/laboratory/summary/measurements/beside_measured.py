"""How the computed curve lies beside the measured one that the scene names."""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.results.records.laboratory_record import CurveReadings, MeasuredBeside
from masonry.rows import measured_curve
from masonry.rows.measured_curve import CurveNumbers, ForcePath
from masonry.timeloop.run_outcome import Outcome


def beside_measured(assembly: Assembly, outcome: Outcome) -> MeasuredBeside | None:
    """Differences of peaks, stiffness and energy; None where nothing was measured, or nothing was driven."""
    curve, section = assembly.scene.curve, assembly.specimen.section
    measured = None if curve is None else curve.measurement(section)
    if curve is None or measured is None or assembly.scene.drive is None:
        return None
    rows = outcome.standing_rows
    begun = _begin(rows["displacement"])
    computed = ForcePath(rows[curve.x][begun:], rows["stress"][begun:] * section)
    if len(computed.place) < 2 or not np.ptp(computed.place) > 0.0:
        return None
    return compared(measured, computed)


def compared(measured: ForcePath, computed: ForcePath) -> MeasuredBeside:
    """Two curves that both turn back by all that they went through; others as far as both go one way."""
    fronts = [measured_curve.envelope(path) for path in (measured, computed)]
    upto = min(float(front.place[-1]) for front in fronts)
    both_turn = measured_curve.cycles(measured) and measured_curve.cycles(computed)
    numbers = [measured_curve.numbers_of(path, None if both_turn else upto) for path in (measured, computed)]
    lab, ours = numbers
    return MeasuredBeside(
        measured=_readings(lab),
        computed=_readings(ours),
        in_cycles=both_turn,
        compared_to_m=upto,
        peak_difference=_differs(ours.peak, lab.peak),
        lowest_difference=_differs(ours.lowest, lab.lowest) if both_turn else None,
        stiffness_difference=_differs(ours.stiffness, lab.stiffness),
        energy_difference=_differs(ours.energy, lab.energy),
        farthest_apart=measured_curve.farthest_apart(*fronts) / abs(lab.peak) if lab.peak else None,
    )


def _readings(numbers: CurveNumbers) -> CurveReadings:
    return CurveReadings(
        peak_n=numbers.peak,
        at_peak_m=numbers.at_peak,
        lowest_n=numbers.lowest,
        at_lowest_m=numbers.at_lowest,
        stiffness_n_per_m=numbers.stiffness,
        energy_j=numbers.energy,
    )


def _differs(ours: float | None, theirs: float | None) -> float | None:
    """By what share ours is above theirs."""
    return None if ours is None or not theirs else ours / theirs - 1.0


def _begin(place: np.ndarray) -> int:
    """The last row before the drive moves."""
    moved = np.flatnonzero(place != 0.0)
    return max(int(moved[0]) - 1, 0) if len(moved) else 0
