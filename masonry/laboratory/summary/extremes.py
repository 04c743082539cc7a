"""Extremes met by the drive: the peak, the lowest stress, its cycles; and the readings of the gauges."""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.laboratory.summary.measurements.beside_measured import beside_measured
from masonry.laboratory.summary.measurements.standard_results import standard_results
from masonry.laboratory.summary.scales import Scales
from masonry.results.summary import Extremes, Readings
from masonry.rows.columns import RATES, TILT
from masonry.rows.cycles import table
from masonry.rows.peak import at_peak, only_rises, reached
from masonry.timeloop.run_outcome import Outcome

LAST = 0.1
"""Of the way of the drive: whether the force still rises is seen there."""


def extremes(assembly: Assembly, outcome: Outcome, scales: Scales) -> Extremes:
    """Stresses and places of the drive, and readings of the gauges."""
    rows, section = outcome.history.rows, assembly.specimen.section
    driven = assembly.scene.drive is not None
    return Extremes(
        peak_stress_pa=outcome.peak_force / section if driven else None,
        displacement_at_peak_m=outcome.displacement_at_peak if driven else None,
        final_stress_pa=float(rows["stress"][-1]) if driven else None,
        peak_force_n=outcome.peak_force if driven else None,
        lowest_stress_pa=outcome.lowest_force / section if driven else None,
        displacement_at_lowest_m=outcome.displacement_at_lowest if driven else None,
        rise_at_end=rise_at_end(rows, outcome.peak_force / section) if driven else None,
        missed_between_steps=outcome.missed_between_steps if driven else None,
        cycles=table(scales.before_fall, outcome.observed["widest"], assembly.scene.loops_over),
        tilt_rad=float(rows[TILT][-1]) if TILT in rows else None,
        gauges=_readings(assembly, outcome, driven),
        beside_measured=beside_measured(assembly, outcome),
        standard=standard_results(assembly, outcome),
    )


def rise_at_end(rows: dict[str, np.ndarray], peak: float) -> float | None:
    """By how much the stress rose over the last tenth of the way of the drive, over the peak (Pa); 0 where it has come
    down from there, None where the drive turns back or never moved."""
    stress, way = rows["stress"], np.abs(rows["displacement"] - rows["displacement"][0])
    if not only_rises(way) or way[-1] == 0.0:
        return None
    if peak <= 0.0 or stress[-1] < reached(peak):
        return 0.0
    return float((stress[-1] - np.interp((1.0 - LAST) * way[-1], way, stress)) / peak)


def _readings(assembly: Assembly, outcome: Outcome, driven: bool) -> dict[str, Readings]:
    """By gauge, at the peak of the drive (between the rows before and after it) and at the end."""
    standing, peak = outcome.standing_rows, outcome.displacement_at_peak
    final = {gauge.name: float(outcome.history.rows[gauge.name][-1]) for gauge in assembly.recording.gauges}
    return {
        gauge.name: Readings(
            at_peak_m=at_peak(standing, standing[gauge.name], peak) if driven else None, final_m=final[gauge.name]
        )
        if gauge.quantity == "displacement"
        else Readings(final=final[gauge.name], unit=RATES[gauge.quantity])
        for gauge in assembly.recording.gauges
    }
