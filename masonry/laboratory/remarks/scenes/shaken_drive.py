"""Does a drive along a table shake more than its record? In real time its interpolant stands still at each row where it
turns, and accelerates harder than the second differences of the rows.

Told from 20 % more on, and from 0.1 m/s2 on, a hundredth of gravity, below which no block feels it.
"""

from itertools import pairwise

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.judgement.doubt import Doubt

MORE, FELT = 1.2, 0.1
"""Accelerations of the drive over those of its record; m/s2."""


def doubts(assembly: Assembly) -> list[Doubt]:
    """One at most."""
    drive, model = assembly.scene.drive, assembly.model
    if drive is None or model.scaled or drive.accuracy is not None or drive.path is None:
        return []
    if isinstance(drive.history, str):
        return []
    made, meant = accelerations(np.array(drive.history))
    stretch = drive.path.duration / (drive.steps * model.dt) if drive.steps else 1.0
    made, meant = made * stretch**2, meant * stretch**2
    if made < FELT or made < MORE * meant:
        return []
    sentence = (
        f"drive.history: in real time the drive stands still at each row where it turns, and accelerates by up to "
        f"{made:.3g} m/s2, where the second differences of its rows reach {meant:.3g} m/s2: what it shakes is shaken "
        f"{times(made, meant)} too hard"
    )
    advice = "give more rows between turns, or an expression of t"
    return [Doubt("shaken_drive", made, max(MORE * meant, FELT), sentence, advice)]


def times(made: float, meant: float) -> str:
    """By how many times a drive accelerates harder than it should (m/s2)."""
    return f"{made / meant:.2g} times" if meant > 0.0 else "far"


def accelerations(table: np.ndarray) -> tuple[float, float]:
    """m/s2: the largest acceleration of the cubics (PCHIP) through rows (n, 2) of times (s) and places (m), and the
    largest second difference of the rows."""
    from scipy.interpolate import PchipInterpolator

    time, place = table[:, 0], table[:, 1]
    curve = PchipInterpolator(time, place)
    a, b = curve.c[:2]
    step = np.diff(time)
    made = max(float(np.abs(2.0 * b).max()), float(np.abs(6.0 * a * step + 2.0 * b).max()))
    speed = np.diff(place) / step
    second = [
        2.0 * (after - before) / (h + g)
        for (before, after), (h, g) in zip(pairwise(speed), pairwise(step), strict=True)
    ]
    return made, float(np.abs(second).max(initial=0.0)) if second else 0.0
