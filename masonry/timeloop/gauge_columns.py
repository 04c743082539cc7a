"""Columns of a run in time that follow from all its rows: accelerations, and the ground as a gauge sees it."""

from dataclasses import dataclass

import numpy as np

from masonry.ground.ground_motion import Motion
from masonry.model.gauges import Gauge
from masonry.model.model import Model
from masonry.rows.accelerations import accelerations
from masonry.rows.columns import GROUND, RATES


@dataclass(frozen=True)
class UniformGround:
    """The motion that all supports share; times (n,) s are those since the settling.

    motions   by axis, "x", "y", "z"
    begin     s, from the end of the settling to when it begins
    is_moved  whether supports are moved; else the run sees it from the ground
    """

    motions: dict[str, Motion]
    begin: float
    is_moved: bool

    def displacement(self, axis: int, time: np.ndarray) -> np.ndarray:
        """(n,) m along an axis (0, 1, 2)."""
        motion = self.motions.get("xyz"[axis])
        return np.zeros(len(time)) if motion is None else motion.displacement_at(time - self.begin)

    def velocity(self, axis: int, time: np.ndarray) -> np.ndarray:
        """(n,) m/s."""
        motion = self.motions.get("xyz"[axis])
        return np.zeros(len(time)) if motion is None else motion.velocity_at(time - self.begin)

    def accelerations(self, time: np.ndarray) -> dict[str, np.ndarray]:
        """By column, (n,) m/s2 along each axis on which it moves."""
        return {GROUND[axis]: motion.acceleration_at(time - self.begin) for axis, motion in self.motions.items()}


def forces_of_bars(model: Model) -> dict[str, float]:
    """By column, N of the bars that have a name."""
    if model.bars is None or model.bar_places is None:
        return {}
    return {name: float(model.bars.tension[bar]) for name, bar in model.bar_places.columns.items()}


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
