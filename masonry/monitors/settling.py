"""How far dead loads have settled: what is unbalanced, and what still moves."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from masonry.configuration.parts.parts import parts_of
from masonry.model.model import Model
from masonry.monitors.observer import Observer, View
from masonry.monitors.unrest import EachBlock
from masonry.rows.rest_criterion import DOUBTED, still_moving
from masonry.runtime.state_file import State, attributes

UNASKED = -1.0
"""What is noted of single blocks where the sums are farther from rest."""


class Settling(Observer):
    """Unbalanced force over the dead loads, and kinetic over stored energy: those of the last row of the settling. The
    same of the block for which it is most, on its own scales; and which block is farthest from rest."""

    REMEMBERED = ("unbalanced", "still_moving", "of_a_block", "energy_of_a_block", "block")

    def __init__(self, model: Model) -> None:
        self.each = EachBlock(model)
        self.unbalanced = self.still_moving = self.of_a_block = self.energy_of_a_block = self.block = 0.0

    def look(self, model: Model, view: View, step: int) -> dict[str, float]:
        if view.settling:
            self.unbalanced, self.still_moving = unbalanced(model, view.before), still_moving(view.terms)
            self.of_a_block = self.energy_of_a_block = self.block = UNASKED
            if DOUBTED.holds(self.unbalanced, self.still_moving):
                self.look_at_each(view.before)
        return attributes(self, self.REMEMBERED)

    def look_at_each(self, before: list[np.ndarray]) -> None:
        """Where the sums are near to rest."""
        unrest = self.each.look(before)
        self.of_a_block, self.energy_of_a_block = float(unrest.force.max()), float(unrest.energy.max())
        self.block = float(unrest.worst(DOUBTED))

    def state(self) -> State:
        return {**super().state(), "most": self.each.most}

    def restore(self, state: State) -> None:
        super().restore(state)
        self.each.most = state["most"]


@dataclass(frozen=True)
class MovingAtEnd:
    """The block that moves most, and its kinetic energy over what it stores."""

    block: int
    energy: float


class Moving(Observer):
    """Kinetic energy of the block that moves most, over what it stores, at the last row; and which it is. Of what
    nothing drives, and what is no motion in time: elsewhere nobody asks whether it rests at the end."""

    REMEMBERED = ("block", "energy")

    def __init__(self, model: Model) -> None:
        self.each, self.block, self.energy = EachBlock(model), 0, 0.0

    def look(self, model: Model, view: View, step: int) -> dict[str, float]:
        unrest = self.each.look(view.before)
        self.block, self.energy = int(unrest.energy.argmax()), float(unrest.energy.max())
        return {}

    def state(self) -> State:
        return {**super().state(), "most": self.each.most}

    def restore(self, state: State) -> None:
        super().restore(state)
        self.each.most = state["most"]

    def records(self) -> list[Any]:
        return [MovingAtEnd(self.block, self.energy)]


def unbalanced(model: Model, before: list[np.ndarray]) -> float:
    """Sum of |force that accelerates| over the sum of |dead load| on the free movements; 0 without dead loads."""
    force = load = 0.0
    for part, old in zip(parts_of(model), before, strict=True):
        body = part.body
        if body.load is not None:
            load += float(np.abs(body.load[:, :3])[part.free[:, :3]].sum())
        force += float(np.abs(part.masses * (body.v - old))[:, :3].sum()) / model.dt
    return force / load if load > 0.0 else 0.0
