"""How fast a drive moves in real time, and how hard it accelerates."""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.results.summary import MovedDrive


def moved_drive(assembly: Assembly) -> MovedDrive | None:
    """The largest velocity and acceleration of a drive in real time, from step to step; None without one."""
    plan, model = assembly.plan, assembly.model
    speed = getattr(plan, "speed", None)
    if assembly.scene.drive is None or model.scaled or speed is None:
        return None
    fastest = float(np.abs(speed).max(initial=0.0))
    return MovedDrive(fastest, float(np.abs(np.diff(speed)).max(initial=0.0)) / model.dt)
