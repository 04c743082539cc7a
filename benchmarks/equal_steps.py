"""What drives in equal steps gave: the ladder that a drive to an accuracy is held against.

Made by `masonry run <scene> --set drive.steps=<steps> --set solver.damping=<damping>` with the keys of RIG; `pytest -m
slow` makes some of it again. `steps` are those of the drive, after `settle`. The converged values are what the ladders
of all dampings come to: within 0.1 % in the peak and 0.2 % in the dissipated energy. In the couplet all that moves
along the shear is prescribed, so that damping has no effect and the only error is that of the steps themselves.
"""

import csv
from itertools import islice
from pathlib import Path
from typing import Any

CONVERGED = {
    "wallette-mode-1": (0.1631e6, 0.1706),
    "wallette-mode-2": (0.2001e6, 0.04175),
    "couplet": (1.375e6, 5.13032),
}
"""Peak stress (Pa) and energy spent on fracture and friction (J)."""

RIG: dict[str, dict[str, Any]] = {
    "wallette-mode-1": {"support.1.fix": ["y"], "contact.unit_unit.dilation_cutoff": "0.4605170186 mm"}
}
"""Keys with which a scene is otherwise than shipped: the right plate on a hinge, dilation until 1 % of the cohesion is
left."""

LADDER: dict[str, dict[float, list[tuple[float, ...]]]] = {}
"""By scene and damping (eq. 3): steps, peak stress (Pa), dissipated energy (J). From `equal_steps.csv`."""
with open(Path(__file__).with_suffix(".csv"), encoding="utf-8", newline="") as file:
    for scene, damping, *numbers in islice(csv.reader(file), 1, None):
        LADDER.setdefault(scene, {}).setdefault(float(damping), []).append(tuple(map(float, numbers)))
