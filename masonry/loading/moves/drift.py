"""The steady motion of a specimen that is led, and viscous damping of all other motion.

Local damping, eq. (3), takes a share of the force on a dof that swings while it drifts, and the slower swing goes on: a
drag. Here the drift is told from the swing, and the swing alone is braked, orthogonally with regard to the masses, so
that what drifts steadily is not dragged.
"""

import numpy as np

from masonry.configuration.parts.parts import parts_of
from masonry.loading.moves.moved import Arrays, dofs
from masonry.model.model import Model
from masonry.runtime.state_file import State


class Drift:
    """How a specimen has moved of late, by kind of motion; older moves fade."""

    def __init__(self, moved: Arrays, fades: float, places: Arrays | None = None) -> None:
        """moved: the mechanism, which it goes by at first; fades: share of what was that a look leaves; places: dofs at
        the last look, None before the first"""
        self.moved, self.fades, self.places = moved, fades, places

    def look(self, model: Model) -> None:
        """Add the move since the last look."""
        now = {kind: place.copy() for kind, place in dofs(model).items()}
        if self.places is not None:
            self.moved = {
                kind: self.fades * motion + (now[kind] - self.places[kind]) for kind, motion in self.moved.items()
            }
        self.places = now

    def brake(self, model: Model, before: list[np.ndarray], left: float, alone: np.ndarray | None = None) -> float:
        """Leave a share of all velocities but those along the drift: an impulse, booked as a force of the damping in
        this step, so that the energy balance stays closed. Returns how many times `moved` it drifts in a second, a pace
        in which no swing is felt. before: energy.velocities a step earlier; alone: (B,) blocks each of which drifts by
        itself while all others rest: then the most of their paces is returned

        The mean of the velocities before and after the step counts: of the fastest swings, which turn round at each
        step, one of them alone would make the impulse feed them.
        """
        parts = parts_of(model)
        earlier = [part.velocities(old) for part, old in zip(parts, before, strict=True)]
        mean = [0.5 * (part.body.v + old) for part, old in zip(parts, earlier, strict=True)]
        inertia = momentum = 0.0
        for part, v in zip(parts, mean, strict=True):
            moved = self.moved[part.name]
            along = part.momenta(moved)
            inertia, momentum = inertia + float(np.sum(along * moved)), momentum + float(np.sum(along * v))
        drifts = momentum / inertia
        paces = np.full(model.blocks.count, drifts) if alone is None else self.paces(model, mean, alone)
        for part, v, old in zip(parts, mean, earlier, strict=True):
            pace = drifts if alone is None else part.spread(paces)[:, None]
            part.strike((left - 1.0) * (v - pace * self.moved[part.name]), old)
        return drifts if alone is None else float(paces[alone].max())

    def paces(self, model: Model, mean: list[np.ndarray], alone: np.ndarray) -> np.ndarray:
        """(B,) how many times what it moved each block that is alone drifts in a second; 0 for all others. mean:
        velocities by kind"""
        paces = np.zeros(model.blocks.count)
        for part, v in zip(parts_of(model), mean, strict=True):
            moved = self.moved[part.name]
            along = part.momenta(moved)
            inertia, momentum = (part.sums((along * x).sum(axis=1)) for x in (moved, v))
            paces[part.blocks] = momentum / np.maximum(inertia, 1e-300)
        return np.where(alone, paces, 0.0)

    def state(self) -> State:
        """State from which it is made anew."""
        return {"moved": self.moved, "fades": self.fades, "places": self.places}
