"""Energies and works, and how far they balance."""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.configuration.energy import open_in_contacts
from masonry.laboratory.summary.scales import Scales
from masonry.monitors.reactions import WorkDone
from masonry.results.summary import Energies
from masonry.rows.columns import CRUSHING, ELEMENT_UNITS, LARGE_UNITS, UNITS, dissipated_in
from masonry.rows.peak import before_a_fall
from masonry.timeloop.run_outcome import Outcome

LITTLE = 1e-2
"""Share of the external work against which the bookings of the laws are held where they dissipated less: friction that
dilates by its own angle dissipates nothing, however much slides."""
TERMS = [column for column, unit in UNITS.items() if unit == "J"]


def energies(assembly: Assembly, outcome: Outcome, scales: Scales, released: float) -> Energies:
    """The ledger at the end, the works of drive and loads, and shares of them; released: J, by sudden cracks."""
    rows, of_loads = outcome.history.rows, outcome.records[WorkDone]
    driven = assembly.scene.drive is not None
    return Energies(
        work_of_drive_j=_work_of_drive(rows, scales.settled, of_loads.after_settling) if driven else None,
        work_of_force_j=float(scales.pushed[-1]) if driven and assembly.scene.is_large else None,
        work_of_loads_j=_by_load(assembly, of_loads.by_load),
        work_of_loads_after_settling_j=_by_load(assembly, of_loads.after_settling),
        energy_j={key: float(rows[key][-1]) for key in (*TERMS, *LARGE_UNITS, CRUSHING, *ELEMENT_UNITS) if key in rows},
        energy_imbalance=float(np.abs(rows["imbalance"]).max() / scales.moved) if scales.moved > 0 else 0.0,
        dissipation_mismatch=_mismatch(assembly, outcome, scales),
        kinetic_over_internal_max=_kinetic(rows, scales),
        damping_over_external=(scales.taken - released) / scales.driven if scales.driven > 0.0 else None,
    )


def _work_of_drive(rows: dict[str, np.ndarray], settled: int, of_loads: np.ndarray) -> float:
    """J since the settling: that of all, less that of the loads."""
    return float(rows["external_work"][-1] - rows["external_work"][settled] - of_loads.sum())


def _by_load(assembly: Assembly, work: np.ndarray) -> dict[str, float]:
    """By load: J."""
    return {load.name: float(done) for load, done in zip(assembly.recording.surroundings.loads, work, strict=True)}


def _mismatch(assembly: Assembly, outcome: Outcome, scales: Scales) -> float:
    """Mismatch between what the laws booked and what the contacts took up and did not store; of a load that grows
    before it falls: the steps of a fall are coarse, and how far it is followed is chance."""
    rows = before_a_fall(outcome.history.rows, outcome.loading.falls)
    torn = abs(open_in_contacts({key: float(values[-1]) for key, values in rows.items()}))
    dissipated = sum(float(rows[key][-1]) for key in dissipated_in(rows))
    work = float(np.abs(rows["external_work"]).max())
    booked = scales.moved if assembly.scene.is_large else max(abs(dissipated), LITTLE * work)
    measured = dissipated or assembly.scene.is_large
    return torn / booked if measured and booked > 0.0 else 0.0


def _kinetic(rows: dict[str, np.ndarray], scales: Scales) -> float | None:
    """The largest kinetic energy over what blocks and contacts have taken up; None where no row counts."""
    counting = scales.counting
    ratio = rows["kinetic"][counting] / np.maximum(scales.internal[counting], max(1e-6 * scales.work, 1e-300))
    return float(ratio.max()) if counting.any() else None
