"""Quasi-static runs to many digits: the drive moves in smooth increments, and waits after each until all is at rest."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.laboratory import laboratory
from masonry.laboratory.result import Result
from masonry.loading.programs import smooth
from masonry.loading.scheduled import Program
from masonry.timeloop import timeloop


def run(assembly: Assembly, places: Sequence[float], move: int, wait: int, settle: int = 0) -> Result:
    """Drive an assembly through `places` (m along the drive, which may turn back): `move` steps, and `wait` at each.

    settle  waits before the drive starts, each of move + wait steps, in the first half of which dead loads rise
    Rows of the history: one at the start, one after each wait. The scene's own drive gives direction and sign alone.
    """
    plan = program(assembly, places, move, wait, settle)
    recording = replace(assembly.recording, rows=settle + len(places))
    outcome = timeloop.run(assembly.model, plan, recording)
    return laboratory.result_of(replace(assembly, plan=plan, recording=recording), outcome)


def program(assembly: Assembly, places: Sequence[float], move: int, wait: int, settle: int) -> Program:
    """Velocities whose sums are the increments exactly; each rises and falls smoothly (its integral is a quintic)."""
    sign = assembly.scene.drive.sign if assembly.scene.drive else 1.0
    whole, first = move + wait, settle * (move + wait)
    shape = np.diff(smooth(np.arange(move + 1) / move))
    speed = np.zeros(first + whole * len(places) + 1)
    for k, step in enumerate(np.diff(places, prepend=0.0)):
        start = first + k * whole + 1
        speed[start : start + move] = sign * step * shape / assembly.model.dt
    dead = smooth(np.arange(len(speed)) / max(0.5 * first, 1.0)) if settle else np.zeros(len(speed))
    return Program(dead, speed, first, 0)
