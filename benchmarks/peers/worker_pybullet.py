"""A dry wall of boxes that PyBullet tilts until it falls: `python worker_pybullet.py WALL.json`.

WALL.json holds `centres` and `sizes` (N, 3) m, `fixed` (N,), `friction`, `density` kg/m3, `gravity` m/s2, `rate`, the
tangent of the tilt by a second, `rest` s before it, `most`, the tangent at which it gives up, `moved` m, by how much a
box must have moved for the wall to fall, `steps_per_second` and `iterations` of the solver in a step. What comes of it
is a line that begins with PEER: the tangent, and the seconds of processor that stepping took.
"""

import json
import math
import sys
import time
from pathlib import Path

import numpy as np
import pybullet as bullet

LOOKS = 100
"""A second of the wall, at which gravity turns on and boxes are looked at."""


def build(wall: dict) -> list[int]:
    """The boxes, in the world of PyBullet."""
    bullet.connect(bullet.DIRECT)
    bullet.setPhysicsEngineParameter(
        fixedTimeStep=1.0 / wall["steps_per_second"], numSolverIterations=wall["iterations"], numSubSteps=0
    )
    bodies = []
    for centre, size, fixed in zip(wall["centres"], wall["sizes"], wall["fixed"], strict=True):
        shape = bullet.createCollisionShape(bullet.GEOM_BOX, halfExtents=[0.5 * side for side in size])
        mass = 0.0 if fixed else wall["density"] * math.prod(size)
        body = bullet.createMultiBody(mass, shape, basePosition=centre)
        # of two bodies Bullet takes the product of the coefficients; nothing is to damp the fall
        bullet.changeDynamics(
            body,
            -1,
            lateralFriction=math.sqrt(wall["friction"]),
            restitution=0.0,
            linearDamping=0.0,
            angularDamping=0.0,
        )
        bodies.append(body)
    return bodies


def places(bodies: list[int]) -> np.ndarray:
    """(N, 3) m of the centres."""
    return np.array([bullet.getBasePositionAndOrientation(body)[0] for body in bodies])


def tangent_at_fall(wall: dict, bodies: list[int]) -> float:
    """The tangent of the tilt at which the wall falls, nan where it does not."""
    steps = max(1, wall["steps_per_second"] // LOOKS)
    seconds, begun = steps / wall["steps_per_second"], None
    for look in range(int((wall["rest"] + wall["most"] / wall["rate"]) / seconds) + 1):
        tangent = max(0.0, look * seconds - wall["rest"]) * wall["rate"]
        angle = math.atan(tangent)
        bullet.setGravity(-wall["gravity"] * math.sin(angle), 0.0, -wall["gravity"] * math.cos(angle))
        for _ in range(steps):
            bullet.stepSimulation()
        if tangent == 0.0:
            begun = places(bodies)
        elif np.abs(places(bodies) - begun).max() > wall["moved"]:
            return tangent
    return math.nan


def main() -> None:
    wall = json.loads(Path(sys.argv[1]).read_text())
    bodies = build(wall)
    begun = time.process_time()
    tangent = tangent_at_fall(wall, bodies)
    says = {"version": str(bullet.getAPIVersion()), "tangent": tangent, "seconds": time.process_time() - begun}
    print("PEER", json.dumps(says), flush=True)


main()
