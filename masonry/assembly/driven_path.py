"""Path of a drive along a history in real time, with a continuous acceleration where a table gives it."""

import numpy as np

from masonry.ground.ground_motion import from_displacement
from masonry.scene import Scene
from masonry.scene.tables.load_history import Timed


def path_in_time(scene: Scene) -> Timed | None:
    """The displacement of the drive over time, None where it has no times.

    With real masses a table is a spline with continuous acceleration, at rest at both ends: what is moved is shaken by
    nothing that its rows do not say. Scaled masses do not feel an acceleration, and turn exactly at the rows.
    """
    drive = scene.drive
    if drive is None or (path := drive.path) is None:
        return None
    table = np.array([] if isinstance(drive.history, str) else drive.history)
    if scene.solver.masses != "real" or len(table) <= 2:  # two rows: a passage at one speed
        return path
    return Timed(path.duration, from_displacement(table[:, 0], table[:, 1], slowly=True).displacement_at)
