"""Observations while the ground shakes: the widest opening, the largest force between two blocks, input energy."""

import numpy as np

from masonry.configuration.configuration import configuration_of
from masonry.model.model import Model
from masonry.monitors.observer import Observer, View
from masonry.monitors.reactions import Surroundings

BY_GROUND = "ground "
"""How the names of its forces of inertia begin."""


class ShakingWatch(Observer):
    """From the end of the settling on, at each row."""

    REMEMBERED = ("external", "by_loads")

    def __init__(self, surroundings: Surroundings) -> None:
        self.surroundings = surroundings
        self.others = np.array([not load.name.startswith(BY_GROUND) for load in surroundings.loads], dtype=bool)
        self.external, self.by_loads = 0.0, 0.0

    def look(self, model: Model, view: View, step: int) -> dict[str, float]:
        widest = int(np.argmax(view.seen.opening)) if len(view.seen.opening) else -1
        factors = np.where(self.others, np.array(view.load_factors), 0.0)
        external, by_loads = view.terms["external_work"], float(factors @ self.surroundings.moved(model))
        if view.settling:
            self.external, self.by_loads = external, by_loads
        force, one, other = largest_force(model)
        return {
            "widest_at": widest,
            "input_energy": external - self.external - (by_loads - self.by_loads),
            "pair_force": force,
            "pair_one": one,
            "pair_other": other,
        }


def largest_force(model: Model) -> tuple[float, int, int]:
    """N between two blocks, and their numbers; -1 where nothing touches."""
    pair, force = configuration_of(model).forces_of_pairs()
    if not len(pair):
        return 0.0, -1, -1
    size = np.einsum("ki,ki->k", force, force)
    k = int(np.argmax(size))
    return float(np.sqrt(size[k])), int(pair[k, 0]), int(pair[k, 1])
