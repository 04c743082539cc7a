"""What is looked at while the ground shakes: the widest opening, the largest force between two blocks, input energy."""

from typing import Any, NamedTuple

import numpy as np

from masonry.configuration.configuration import configuration_of
from masonry.model.model import Model
from masonry.monitors.observer import Observer, View
from masonry.monitors.reactions import Surroundings

BY_GROUND = "ground "
"""How the names of its forces of inertia begin."""


class PairForce(NamedTuple):
    """The largest force (N) between two blocks at any row, and the step of that."""

    force: float
    pair: tuple[int, int]
    step: int


class ShakingWatch(Observer):
    """From the end of the settling on, at each row."""

    REMEMBERED = ("force", "pair", "step", "external", "by_loads")

    def __init__(self, surroundings: Surroundings) -> None:
        self.surroundings = surroundings
        self.others = np.array([not load.name.startswith(BY_GROUND) for load in surroundings.loads], dtype=bool)
        self.force, self.pair, self.step = 0.0, [-1, -1], 0
        self.external, self.by_loads = 0.0, 0.0

    def look(self, model: Model, view: View, step: int) -> dict[str, float]:
        widest = int(np.argmax(view.seen.opening)) if len(view.seen.opening) else -1
        factors = np.where(self.others, np.array(view.load_factors), 0.0)
        external, by_loads = view.terms["external_work"], float(factors @ self.surroundings.moved(model))
        if view.settling:
            self.external, self.by_loads = external, by_loads
        else:
            self._look_at_forces(model, step)
        return {"widest_at": widest, "input_energy": external - self.external - (by_loads - self.by_loads)}

    def _look_at_forces(self, model: Model, step: int) -> None:
        pair, force = configuration_of(model).forces_of_pairs()
        if not len(pair):
            return
        size = np.einsum("ki,ki->k", force, force)
        k = int(np.argmax(size))
        if size[k] > self.force**2:
            self.force, self.pair, self.step = float(np.sqrt(size[k])), pair[k].tolist(), step

    def found(self) -> dict[str, Any]:
        a, b = self.pair
        return {"pair_force": None if a < 0 else PairForce(self.force, (a, b), self.step)}
