"""From a scene's words to the plan of its loading: how many steps, and what happens at each."""

from dataclasses import replace

import numpy as np

from masonry.errors import SceneError
from masonry.loading.schedule import followed, passage, steps_at
from masonry.model.loads import Controlled, Program, controlled, program, require_few
from masonry.scene import Scene
from masonry.scene.tables.history import Timed
from masonry.scene.tables.loading import Drive

FEWEST = 2000
"""Steps in which dead loads settle where the scene does not say, and nobody has looked how many they need: settling.py
tries so many first."""


def plan_of(scene: Scene, dt: float) -> Program | Controlled:
    """The plan for steps of dt (s): a fixed program, or a drive that is paced by its error."""
    settle = scene.settle.steps if scene.settle else FEWEST * scene.has_dead_loads
    drive, loads = scene.drive, [traction.path for traction in scene.traction if traction.path is not None]
    if loads or (drive is not None and drive.history is not None):
        return _along_histories(drive, loads, settle, dt)
    if drive is None:
        return program(dt, settle, 0.0, None, None, 0.0)
    way = drive.sign * drive.farthest
    if drive.accuracy is not None:
        return controlled(settle, way, drive.accuracy)
    return program(dt, settle, way, drive.steps, drive.rate, drive.ramp)


def _along_histories(drive: Drive | None, loads: list[Timed], settle: int, dt: float) -> Program | Controlled:
    """All histories over the same steps: each load's time runs while the drive makes its whole way."""
    if drive is not None and drive.accuracy is not None:
        turns = tuple(drive.sign * place for place in drive.turns)
        return controlled(settle, turns[0], drive.accuracy, turns)
    if drive is not None and drive.history is None:
        plain = program(dt, settle, drive.sign * drive.farthest, drive.steps, drive.rate, drive.ramp)
        require_two(plain.steps - settle)
        return replace(plain, varying=_shares(loads, settle, plain.steps - settle))
    path = None if drive is None else drive.path
    duration = max(found.duration for found in [*loads, *([path] if path else [])]) if loads or path else 0.0
    if drive is not None and drive.steps is not None:
        count = drive.steps
    elif drive is not None and drive.rate is not None:
        count = steps_at(drive.rate, dt, drive.turns)
    else:
        count = 1 + int(np.ceil(min(duration / dt, 1e18)))
    require_two(count)
    require_few(settle + count, dt)
    t = np.linspace(0.0, duration, count)
    if drive is None:
        places = np.zeros(count)
    else:
        places = drive.sign * (passage(drive.turns, count) if path is None else _at(path, t) - _at(path, t[:1]))
    return followed(dt, settle, places, _shares(loads, settle, count, duration) if loads else None)


def _shares(loads: list[Timed], settle: int, count: int, duration: float = 0.0) -> np.ndarray:
    """(H, settle + count + 1) share of each load at each step: all the time of the longest, or `duration` (s) if that
    is longer, passes in the last `count` steps."""
    t = np.linspace(0.0, max(duration, *(load.duration for load in loads)), count)
    return np.array([_at(load, np.concatenate([np.zeros(settle + 1), t])) for load in loads])


def _at(path: Timed, t: np.ndarray) -> np.ndarray:
    """Values (n,) at times, the last one after the end."""
    return np.asarray(path.at(np.minimum(t, path.duration)))


def require_two(count: int) -> None:
    """A history needs a step to start from and one to move in."""
    if count < 2:
        raise SceneError("drive: a history needs two steps at least; give more steps, or a longer duration")
