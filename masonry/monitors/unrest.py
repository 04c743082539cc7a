"""Whether each block is at rest, on its own scales: a sum over all blocks does not see a small one beside a large one.

A block of stiffness K (N/m, of all its contacts) that bears F (N) stores F^2 / 2K. It is at rest where the force that
accelerates it is small beside F, and its kinetic energy small beside F^2 / 2K: a swing whose force is a share s of F
has s^2 of that.
"""

from typing import NamedTuple

import numpy as np

from masonry.configuration.energy import present
from masonry.configuration.joint_forces import forces_on_blocks
from masonry.kinematics.turning import Turning
from masonry.model.model import Model
from masonry.patches.arrays import AREA
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
    """

    def __init__(self, model: Model) -> None:
        self.model, self.size = model, np.cbrt(model.layout.volume)
        self.most, joints = np.zeros(model.blocks.count), model.joints
        self.pair = np.column_stack([joints.block_a, joints.block_b]).astype(np.int64)
        stiffness = np.zeros(len(model.group))
        for g, joint in enumerate(model.groups.properties):
            stiffness[model.groups.bounds[g] : model.groups.bounds[g + 1]] = joint.normal_stiffness
        self.stiffness = stiffness * joints.area
        self.of_contacts = self._sum(self.pair, self.stiffness)

    def look(self, before: list[np.ndarray]) -> Unrest:
        """How far each is from rest; `before`: velocities a step earlier (energy.velocities)."""
        model, bears = self.model, self.bears()
        force = np.zeros(model.blocks.count)
        for (kind, body), old in zip(present(model), before, strict=True):
            mass = model.masses[kind]
            moved = np.abs(mass[:, :3] * (body.v - old)[:, :3]).sum(axis=1)
            if isinstance(body, Turning):
                turned = np.abs(body.momentum - old[:, 3:]).sum(axis=1)
            else:
                turned = np.abs(mass[:, 3:] * (body.v - old)[:, 3:]).sum(axis=1)
            about = self._of(kind, turned) / self.size[model.layout.members[kind]]
            force[model.layout.members[kind]] = np.maximum(self._of(kind, moved), about) / model.dt
        stiffness = 2.0 * self._stiffness()
        stores = np.divide(bears**2, stiffness, out=np.zeros(len(bears)), where=stiffness > 0.0)
        return Unrest(_over(force, bears), _over(kinetic(model), stores))

    def bears(self) -> np.ndarray:
        """(B,) N, the larger of the dead load of each block and half of the forces at its contacts; sums of components.
        Blocks without a dead load bear the most that they ever did, and a little of what all do."""
        model = self.model
        load = dead_loads(model)
        if model.large is None:
            pressed = self._sum(self.pair, np.abs(model.contacts.force).sum(axis=1))
        else:
            block, forces, _ = forces_on_blocks(model)
            pressed = np.bincount(block, np.abs(forces).sum(axis=0), len(load))
        volume = model.layout.volume
        bears = np.maximum(load, 0.5 * pressed)
        self.most = np.maximum(self.most, bears)
        bears = np.where(load > 0.0, bears, self.most)
        return np.asarray(np.maximum(bears, LIGHT * bears.sum() * volume / volume.sum()))

    def _stiffness(self) -> np.ndarray:
        """(B,) N/m, of the contacts of each block; those of patches change."""
        if self.model.large is None:
            return self.of_contacts
        near, alive = self.model.large.near, self.model.large.bonds.alive
        pairs, points = near.pairs, near.points
        touching = np.flatnonzero(pairs.slot[: pairs.number[0]] >= 0)
        slot = pairs.slot[touching]
        area = points.quads[slot, :, AREA].reshape(len(slot), points.quads[0, :, AREA].size)
        area = np.where(np.arange(area.shape[1]) < points.number[slot, None], area, 0.0).sum(axis=1)
        pair = np.concatenate([self.pair[alive], near.pieces.block[pairs.body[touching]]])
        patches = near.rules.normal_stiffness[pairs.law[touching]] * area
        return self._sum(pair, np.append(self.stiffness[alive], patches))

    def _sum(self, pair: np.ndarray, values: np.ndarray) -> np.ndarray:
        """(B,) sums of values (C,) over both blocks (C, 2) of each contact."""
        count = self.model.blocks.count
        return np.bincount(pair[:, 0], values, count) + np.bincount(pair[:, 1], values, count)

    def _of(self, kind: str, values: np.ndarray) -> np.ndarray:
        return of_blocks(self.model, kind, values)


def left_of_motion(model: Model, most: float) -> np.ndarray:
    """(B,) kinetic energy over the part of each block, by its mass, of the most that all had at once (J); or over its
    weight times its size, where that is less."""
    mass, size = np.zeros(model.blocks.count), np.cbrt(model.layout.volume)
    for kind, _ in present(model):
        mass[model.layout.members[kind]] = of_blocks(model, kind, model.masses[kind][:, :3].max(axis=1))
    part, weight = most * mass / max(float(mass.sum()), 1e-300), dead_loads(model)
    return _over(kinetic(model), np.where(weight > 0.0, np.minimum(part, weight * size), part))


def kinetic(model: Model) -> np.ndarray:
    """(B,) J, of each block."""
    found = np.zeros(model.blocks.count)
    for kind, body in present(model):
        parts = model.masses[kind] * body.v**2
        if isinstance(body, Turning):
            parts = np.column_stack([parts[:, :3], body.momentum * body.v[:, 3:]])
        found[model.layout.members[kind]] = 0.5 * of_blocks(model, kind, parts.sum(axis=1))
    return found


def dead_loads(model: Model) -> np.ndarray:
    """(B,) N, sums of the components along free movements."""
    found = np.zeros(model.blocks.count)
    for kind, body in present(model):
        if body.load is not None:
            free = np.where(body.dt_over_mass[:, :3] > 0.0, np.abs(body.load[:, :3]), 0.0)
            found[model.layout.members[kind]] = of_blocks(model, kind, free.sum(axis=1))
    return found


def of_blocks(model: Model, kind: str, values: np.ndarray) -> np.ndarray:
    """Values (rows,) of the bodies of a kind, by block: sums over the nodes of tets."""
    if kind != "tets":
        return values
    assert model.layout.mesh is not None
    return np.asarray(np.add.reduceat(values, model.layout.mesh.node_start[model.layout.members[kind]]))


def rows_of(model: Model, kind: str, values: np.ndarray) -> np.ndarray:
    """(rows,) of the bodies of a kind: what blocks (B,) have, for tets at each of their nodes."""
    if kind != "tets":
        return values[model.layout.members[kind]]
    assert model.layout.mesh is not None
    return np.repeat(values, np.diff(model.layout.mesh.node_start))


def _over(part: np.ndarray, whole: np.ndarray) -> np.ndarray:
    """Shares, `MOST` at most; 0 of nothing."""
    shares = np.where(part > 0.0, MOST, 0.0)
    return np.divide(part, whole, out=shares, where=part < MOST * whole)
