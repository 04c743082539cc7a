"""What is looked at where blocks may fall: which is the first, when, and what was dissipated by then; overlaps."""

from typing import Any

import numpy as np

from geometry.polyhedra.measures import bounds
from masonry.kernels.patches import deepest
from masonry.model.model import Model
from masonry.monitors.observer import Observer, View

DROPPED = 0.5
"""Of its least width: how far a block has gone down, along its weight, when it counts as fallen."""


class Collapse(Observer):
    """Looks for the first block that has fallen. Without weight nothing falls."""

    REMEMBERED = ("block", "step", "energies")

    def __init__(self, model: Model) -> None:
        self.block, self.step = -1, 0
        self.energies: dict[str, float] = {}
        low, high = bounds(model.blocks)
        self.width = (high - low).min(axis=1)
        self.free = model.bodies.rigid.dt_over_mass[:, :3].any(axis=1)

    def look(self, model: Model, view: View, step: int) -> dict[str, float]:
        body = model.bodies.rigid
        if self.block < 0 and body.load is not None:
            weight = body.load[:, :3]
            down = weight / np.maximum(np.linalg.norm(weight, axis=1), 1e-300)[:, None]
            drop = np.where(self.free, np.einsum("bi,bi->b", down, body.q[:, :3]) / self.width, 0.0)
            if drop.max(initial=0.0) > DROPPED:
                self.block, self.step = int(drop.argmax()), step
                self.energies = {key: value for key, value in view.terms.items() if key != "imbalance"}
        assert model.large is not None
        overlap = deepest(model.large.near, self.width)
        return {"widest": float(view.seen.opening.max(initial=0.0)), "overlap": float(overlap), "slip": 0.0}

    def found(self) -> dict[str, Any]:
        return {"collapse": None if self.block < 0 else (self.block, self.step, self.energies)}
