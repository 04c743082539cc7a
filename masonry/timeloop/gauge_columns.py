"""Columns of a run in time that follow from all its rows: accelerations, and the ground as a gauge sees it."""

import numpy as np

from masonry.ground.uniform_ground import UniformGround
from masonry.model.gauges import Gauge
from masonry.rows.accelerations import accelerations
from masonry.rows.columns import RATES


def finish_columns(
    rows: dict[str, np.ndarray], gauges: tuple[Gauge, ...], ground: UniformGround | None, settled: float
) -> dict[str, str]:
    """Turn the columns of gauges from what rows have read into what they tell, and add the ground's. Displacements and
    velocities are those relative to the ground, accelerations those of the whole motion.

    settled  s, when the dead loads have settled
    Returns the units of columns that have another one than their name says.
    """
    time = rows["time"]
    since = time - settled
    for gauge in gauges:
        reading = rows[gauge.name]
        if ground is not None and not gauge.is_relative:
            if gauge.quantity == "acceleration" and not ground.is_moved:
                reading = reading + gauge.sign * ground.displacement(gauge.axis, since)
            elif gauge.quantity != "acceleration" and ground.is_moved:
                of_ground = ground.velocity if gauge.quantity == "velocity" else ground.displacement
                reading = reading - gauge.sign * of_ground(gauge.axis, since)
        rows[gauge.name] = accelerations(time, reading, settled) if gauge.quantity == "acceleration" else reading
    if ground is not None:
        rows |= ground.accelerations(since)
    return {gauge.name: RATES[gauge.quantity] for gauge in gauges if gauge.quantity in RATES}
