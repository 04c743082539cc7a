"""Whether each block is at rest, on its own scales: a sum over all blocks does not see a small one beside a large one.

A block of stiffness K (N/m, of all its contacts) that bears F (N) stores F^2 / 2K. It is at rest where the force that
accelerates it is small beside F, and its kinetic energy small beside F^2 / 2K: a swing whose force is a share s of F
has s^2 of that.
"""

from typing import NamedTuple

import numpy as np

from masonry.configuration.configuration import configuration_of
from masonry.configuration.parts.parts import parts_of
from masonry.model.model import Model
from masonry.rows.rest_criterion import RestCriterion

MOST = 1e12
"""What shares of nothing are taken for."""
LIGHT = 1e-6
"""Of the loads on all blocks, in proportion to its volume: what a block bears at least, that nothing loads."""


class Unrest(NamedTuple):
    """By block, (B,): the force that accelerates over what it bears, and the kinetic energy over what it stores."""

    force: np.ndarray
    energy: np.ndarray

    def alone(self, rest: RestCriterion) -> np.ndarray:
        """(B,) which blocks are not at rest, where all together may be."""
        return (self.force > rest.of_block.force) | (self.energy > rest.of_block.energy)

    def worst(self, rest: RestCriterion) -> int:
        """The block that is farthest from rest: its energy counts as that of a swing of so much force."""
        return int(np.maximum(self.force / rest.of_block.force, self.energy / rest.of_block.force**2).argmax())


class EachBlock:
    """Looks at each block of a model.

    size  (B,) m, edges of cubes of their volumes
    most  (B,) N, the most that each was seen to bear: what came loose and has no weight is measured by that
    loads (B,) N, the dead loads; None where they vary
    """

    def __init__(self, model: Model) -> None:
        self.model, self.size = model, np.cbrt(model.layout.volume)
        self.most, self.configuration = np.zeros(model.blocks.count), configuration_of(model)
        varies = any(part.body.change is not None for part in parts_of(model))
        self.loads = None if varies else dead_loads(model)

    def look(self, before: list[np.ndarray]) -> Unrest:
        """How far each is from rest; `before`: velocities a step earlier (energy.velocities)."""
        model, bears = self.model, self.bears()
        force = np.zeros(model.blocks.count)
        for part, old in zip(parts_of(model), before, strict=True):
            gained = np.abs(part.gained(old))
            about = part.sums(gained[:, 3:].sum(axis=1)) / self.size[part.blocks]
            force[part.blocks] = np.maximum(part.sums(gained[:, :3].sum(axis=1)), about) / model.dt
        stiffness = 2.0 * self.configuration.stiffness()
        stores = np.divide(bears**2, stiffness, out=np.zeros(len(bears)), where=stiffness > 0.0)
        return Unrest(_over(force, bears), _over(kinetic(model), stores))

    def bears(self) -> np.ndarray:
        """(B,) N, the larger of the dead load of each block and half of the forces at its contacts; sums of components.
        Blocks without a dead load bear the most that they ever did, and a little of what all do."""
        model = self.model
        load, pressed = dead_loads(model) if self.loads is None else self.loads, self.configuration.pressed()
        volume = model.layout.volume
        bears = np.maximum(load, 0.5 * pressed)
        self.most = np.maximum(self.most, bears)
        bears = np.where(load > 0.0, bears, self.most)
        return np.asarray(np.maximum(bears, LIGHT * bears.sum() * volume / volume.sum()))


def left_of_motion(model: Model, most: float) -> np.ndarray:
    """(B,) kinetic energy over the part of each block, by its mass, of the most that all had at once (J); or over its
    weight times its size, where that is less."""
    mass, size = np.zeros(model.blocks.count), np.cbrt(model.layout.volume)
    for part in parts_of(model):
        mass[part.blocks] = part.sums(part.masses[:, :3].max(axis=1))
    most_of_each, weight = most * mass / max(float(mass.sum()), 1e-300), dead_loads(model)
    return _over(kinetic(model), np.where(weight > 0.0, np.minimum(most_of_each, weight * size), most_of_each))


def kinetic(model: Model) -> np.ndarray:
    """(B,) J, of each block."""
    energy = np.zeros(model.blocks.count)
    for part in parts_of(model):
        energy[part.blocks] = part.kinetic_of_blocks()
    return energy


def dead_loads(model: Model) -> np.ndarray:
    """(B,) N, sums of the components along free movements."""
    total = np.zeros(model.blocks.count)
    for part in parts_of(model):
        if part.body.load is not None:
            loads = np.where(part.free[:, :3], np.abs(part.body.load[:, :3]), 0.0)
            total[part.blocks] = part.sums(loads.sum(axis=1))
    return total


def _over(part: np.ndarray, whole: np.ndarray) -> np.ndarray:
    """Shares, `MOST` at most; 0 of nothing."""
    shares = np.where(part > 0.0, MOST, 0.0)
    return np.divide(part, whole, out=shares, where=part < MOST * whole)
