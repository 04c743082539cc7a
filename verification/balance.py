"""The energy balance of a run, added up here from the terms of its ledger: the program's own sum is only compared.

external work = damping + kinetic + elastic energy of the blocks + work taken by the contacts        (an identity)
work taken by the contacts = stored + fracture I + fracture II + friction + crushing                 (O(dt))

In large displacement the first has the drift of the rotors as well, and the second what dashpots dissipate, what is
lost as contacts are found anew, and what areas that change under pressure take.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from masonry.laboratory.result import Result

TAKEN = ("damping", "kinetic", "elastic_blocks", "contact_work", "rotor")
DISSIPATED = ("fracture_mode_1", "fracture_mode_2", "friction", "crushing", "plastic_bars")
"""The last two where crushing is modelled, and where there are bars, which yield."""
IN_LARGE = ("dashpot", "redetection", "area")
"""What contacts take besides in large displacement."""
SAME = 1e-13
"""Of the largest term: how far two sums of the same terms may differ, in whatever order they are added up."""
Terms = Mapping[str, np.ndarray | float]


def dissipated(summary: Mapping[str, Any]) -> float:
    """J that fracture, friction and crushing have taken by the end of a run."""
    return float(sum(summary["energy_j"].get(key, 0.0) for key in DISSIPATED))


def residual(terms: Terms) -> np.ndarray:
    """J, external work less all that took it; numbers or rows."""
    return np.asarray(terms["external_work"]) - sum(np.asarray(terms[name]) for name in TAKEN if name in terms)


def largest(terms: Terms) -> float:
    """J, the largest of the terms at any row: what rounding is relative to."""
    return max(float(np.abs(terms[name]).max()) for name in ("external_work", *TAKEN) if name in terms)


def honest(terms: Terms) -> bool:
    """Whether the program's own `imbalance` is the sum of its terms, at every row."""
    apart = np.abs(np.asarray(terms["imbalance"]) - residual(terms)).max()
    return bool(apart <= SAME * largest(terms))


def open_by(result: Result) -> float:
    """Largest residual of all rows over the largest external work; infinite where the run tells another one.

    A load that is lifted takes all work of the drive, so the work of each load counts as well. Where nothing does work
    from outside, over the largest of the terms.
    """
    rows = result.history.rows
    loads = [abs(work) for work in result.summary["work_of_loads_j"].values()]
    work, size = max(float(np.abs(rows["external_work"]).max()), *loads, 0.0), largest(rows)
    gap = float(np.abs(residual(rows)).max())
    imbalance = gap / (work or size) if gap else 0.0
    reported = float(result.summary["energy_imbalance"])
    agrees = honest(rows) and (work == 0.0 or abs(reported - imbalance) <= SAME * size / work)
    return imbalance if agrees else np.inf


def mismatch(result: Result) -> float:
    """Mismatch between the dissipation that the laws book and the work that contacts took less what they store, over
    the first; at the end of a run."""
    rows = result.history.rows
    booked_energy = sum(float(rows[name][-1]) for name in (*DISSIPATED, *IN_LARGE) if name in rows)
    stored = sum(float(rows[name][-1]) for name in ("elastic_contacts", "elastic_bars") if name in rows)
    taken = float(rows["contact_work"][-1]) - stored
    return abs(taken - booked_energy) / abs(booked_energy) if booked_energy else 0.0
