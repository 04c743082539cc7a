"""Does a drive along a table shake more than its rows say? In real time it follows a spline through them, with
continuous acceleration and at rest at both ends: rows that are too far apart for what they show, or that begin or end
at once, make it accelerate harder than their second differences.

Told from 20 % more on, and from 0.1 m/s2 on, a hundredth of gravity, below which no block feels it.
"""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.ground.ground_motion import from_displacement
from masonry.judgement.doubt import Doubt

MORE, FELT = 1.2, 0.1
"""Accelerations of the drive over those of its rows; m/s2."""


def doubts(assembly: Assembly) -> list[Doubt]:
    """One at most."""
    drive, model = assembly.scene.drive, assembly.model
    if drive is None or model.scaled or drive.accuracy is not None or drive.path is None:
        return []
    if isinstance(drive.history, str) or drive.history is None or len(drive.history) <= 2:
        return []
    made, meant = accelerations(np.array(drive.history))
    stretch = drive.path.duration / (drive.steps * model.dt) if drive.steps else 1.0
    made, meant = made * stretch**2, meant * stretch**2
    if made < FELT or made < MORE * meant:
        return []
    sentence = (
        f"drive.history: in real time the drive is at rest before and after its rows, and accelerates by up to "
        f"{made:.3g} m/s2 between them, where their second differences reach {meant:.3g} m/s2: what it shakes is "
        f"shaken {times(made, meant)} too hard"
    )
    advice = "give more rows where it turns, and let it begin and end slowly; or shake supports by [ground]"
    return [Doubt("shaken_drive", made, max(MORE * meant, FELT), sentence, advice)]


def times(made: float, meant: float) -> str:
    """By how many times a drive accelerates harder than it should (m/s2)."""
    return f"{made / meant:.2g} times" if meant > 0.0 else "far"


def accelerations(table: np.ndarray) -> tuple[float, float]:
    """m/s2: the largest acceleration of the spline through rows (n, 2) of times (s) and places (m), and the largest
    second difference of the rows."""
    time, place = table[:, 0], table[:, 1]
    step = np.diff(time)
    speed = np.diff(place) / step
    second = 2.0 * np.diff(speed) / (step[1:] + step[:-1])
    return from_displacement(time, place, slowly=True).peak_acceleration, float(np.abs(second).max(initial=0.0))
