"""Gauges that swing freely at the end of a run: the damping ratio, by the logarithmic decrement, and the frequency."""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.timeloop.run_outcome import Outcome

FEWEST, LEAST = 6, 1e-3
"""Half swings, and the smallest over the first, of which a decrement is told."""
REGULAR = 0.05
"""Share by which the times of half swings, and their decrements over a whole swing's fall, may differ."""
SAMPLES = 6
"""Rows of a half swing, at least: the parabola through a turning point is then within 0.1 %."""


def free_swings(assembly: Assembly, outcome: Outcome) -> dict[str, dict[str, float] | None] | None:
    """By gauge, ratio and frequency_hz of its swing once the ground rests; None where it does not swing freely, and in
    all where a scene neither shakes nor damps."""
    scene, rows = assembly.scene, outcome.history.rows
    if not scene.swings:
        return None
    begins = assembly.plan.settle * assembly.model.dt + max((ground.runs_for for ground in scene.ground), default=0.0)
    free = rows["time"] > begins
    return {gauge.name: swing(rows["time"][free], rows[gauge.name][free]) for gauge in scene.gauge}


def swing(time: np.ndarray, reading: np.ndarray) -> dict[str, float] | None:
    """Ratio and frequency (Hz) of a reading (n,) at some times (n,) s; None where it does not swing regularly.

    From one turning point to the next it moves by less and less: by exp(-d/2) of the way before, whatever it swings
    about, with d the logarithmic decrement.
    """
    turns = np.flatnonzero((reading[1:-1] - reading[:-2]) * (reading[2:] - reading[1:-1]) < 0.0) + 1
    if len(turns) <= FEWEST:
        return None
    before, now, after = reading[turns - 1], reading[turns], reading[turns + 1]
    bent = before - 2.0 * now + after
    top = now - (before - after) ** 2 / (8.0 * bent)
    when = time[turns] + 0.5 * (before - after) / bent * (time[turns + 1] - time[turns])
    way = np.abs(np.diff(top))
    count = int(np.argmax(way < LEAST * way[0])) or len(way)
    half = np.diff(when)[:count]
    if count < FEWEST or np.ptp(half) > REGULAR * half.mean() or np.diff(turns).min() < SAMPLES:
        return None
    fall, start = np.polyfit(np.arange(count), np.log(way[:count]), 1)
    off = np.abs(np.log(way[:count]) - start - fall * np.arange(count)).max()
    if off > REGULAR * max(abs(fall) * count, 2.0 * REGULAR):
        return None
    slope = -fall / np.pi
    return {"ratio": float(slope / np.hypot(1.0, slope)), "frequency_hz": float(0.5 / half.mean())}
