"""How far dead loads have settled: what is unbalanced, and what still moves."""

import numpy as np

from masonry.history import still_moving
from masonry.model.model import Model
from masonry.monitors.energy import present
from masonry.monitors.observer import Observer, View


class Settling(Observer):
    """Unbalanced force over the dead loads, and kinetic over stored energy: those of the last row of the settling."""

    REMEMBERED = ("unbalanced", "still_moving")

    def __init__(self) -> None:
        self.unbalanced = self.still_moving = 0.0

    def look(self, model: Model, view: View, step: int) -> dict[str, float]:
        if view.settling:
            self.unbalanced, self.still_moving = unbalanced(model, view.before), still_moving(view.terms)
        return self.state()


def unbalanced(model: Model, before: list[np.ndarray]) -> float:
    """Sum of |force that accelerates| over the sum of |dead load| on the free movements; 0 without dead loads."""
    force = load = 0.0
    for (kind, body), old in zip(present(model), before, strict=True):
        if body.load is not None:
            load += float(np.abs(body.load[:, :3])[body.dt_over_mass[:, :3] > 0.0].sum())
        force += float(np.abs(model.masses[kind] * (body.v - old))[:, :3].sum()) / model.dt
    return force / load if load > 0.0 else 0.0
