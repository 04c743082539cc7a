"""What holds a specimen and what loads it: force and moment of supports, drive and dead loads; work of the loads."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from masonry.model.layout import FREEDOMS, KINDS, Layout
from masonry.model.loads import Conditions
from masonry.model.model import Model
from masonry.monitors.energy import present

Parts = dict[str, tuple[np.ndarray, np.ndarray]]
"""Per kind: rows of its freedoms (n,), and for each the shares or loads of its freedoms (n, freedoms)."""


@dataclass(frozen=True)
class Outer:
    """What acts on a specimen from outside: a support, the drive, or a dead load.

    parts   of a support or drive: 1 at the freedoms that it holds; of a load: its generalised forces at a share of 1
    varies  number of a load's history, None where its share is that of the dead loads
    """

    name: str
    parts: Parts
    varies: int | None = None


@dataclass(frozen=True)
class Standing:
    """Forces (N) and moments (N m, about the origin of the scene) at one moment: of supports and drive (H, 6), of dead
    loads (L, 6); force (C, 3) N of the contacts on their side a."""

    step: int
    displacement: float
    reactions: np.ndarray
    loads: np.ndarray
    force: np.ndarray


class Surroundings:
    """All that acts on a model from outside. A freedom that several supports hold counts with the first of them."""

    def __init__(self, conditions: Conditions | None = None) -> None:
        self.holds: list[Outer] = []
        self.loads: list[Outer] = []
        if conditions is None:
            return
        taken = {kind: np.zeros_like(mask) for kind, mask in conditions.prescribed.items()}
        for name, masks in conditions.held_by.items():
            own = {kind: masks[kind] & ~taken[kind] for kind in KINDS}
            taken = {kind: taken[kind] | own[kind] for kind in KINDS}
            self.holds.append(Outer(name, _parts({kind: own[kind].astype(float) for kind in KINDS})))
        for name, load in conditions.each_load.items():
            varies = [k for k, varying in enumerate(conditions.varying) if varying is load]
            self.loads.append(Outer(name, _parts(load), *varies))

    def standing(self, model: Model, step: int, displacement: float, shares: list[float]) -> Standing:
        """The forces now; `shares` of the loads that act."""
        layout = model.layout
        bodies = dict(present(model))
        held = np.zeros((len(self.holds), 6))
        for k, one in enumerate(self.holds):
            for kind, (rows, mask) in one.parts.items():
                held[k] += resultant(layout, kind, rows, mask * bodies[kind].hold[rows])
        return Standing(step, displacement, held, self.resultants(layout, shares), model.contacts[4].copy())

    def resultants(self, layout: Layout, shares: list[float]) -> np.ndarray:
        """(L, 6) of the loads at their shares."""
        found = np.zeros((len(self.loads), 6))
        for k, (one, share) in enumerate(zip(self.loads, shares, strict=True)):
            for kind, (rows, load) in one.parts.items():
                found[k] += share * resultant(layout, kind, rows, load)
        return found

    def moved(self, model: Model) -> np.ndarray:
        """(L,) J: what each load at a share of 1 would have done on the way to where the specimen stands."""
        bodies = dict(present(model))
        found = np.zeros(len(self.loads))
        for k, one in enumerate(self.loads):
            for kind, (rows, load) in one.parts.items():
                way = model.contacts[3][: len(bodies[kind].v)] if kind == "tets" else bodies[kind].q
                found[k] += float(np.sum(load * way[rows]))
        return found


def _parts(values: dict[str, np.ndarray] | dict[str, np.ndarray | None]) -> Parts:
    """The rows that are not zero."""
    found = {}
    for kind, array in values.items():
        if array is not None and len(rows := np.flatnonzero(np.any(array != 0.0, axis=1))):
            found[kind] = rows, np.ascontiguousarray(array[rows])
    return found


def resultant(layout: Layout, kind: str, rows: np.ndarray, forces: np.ndarray) -> np.ndarray:
    """(6,) force (N) and moment (N m) about the origin of generalised forces (n, freedoms) on rows of a kind.

    The arms are those before loading, as everywhere in a model of small rotations.
    """
    assert forces.shape[1] == FREEDOMS[kind]
    force = forces[:, :3]
    if kind == "tets":
        assert layout.mesh is not None
        return np.concatenate([force.sum(axis=0), np.cross(layout.mesh.nodes[rows], force).sum(axis=0)])
    block = layout.members[kind][rows]
    axes = layout.axes[block]
    if kind == "rigid":
        own = np.einsum("bij,bj->bi", axes, forces[:, 3:])
    else:  # first moments, force times arm along the axes of the block
        t = np.einsum("bik,bjk->bij", forces[:, 3:].reshape(-1, 3, 3), axes)
        own = np.column_stack([t[:, 2, 1] - t[:, 1, 2], t[:, 0, 2] - t[:, 2, 0], t[:, 1, 0] - t[:, 0, 1]])
    moment = own + np.cross(layout.centroid[block], force)
    return np.concatenate([force.sum(axis=0), moment.sum(axis=0)])


class WorkOfLoads:
    """Work (J) of each load so far, by the trapezoid from row to row: exact while its share stays as it is."""

    def __init__(self, surroundings: Surroundings) -> None:
        self.surroundings = surroundings
        count = len(surroundings.loads)
        self.done, self.settled = np.zeros(count), np.zeros(count)
        self.moved, self.shares = np.zeros(count), np.zeros(count)

    def look(self, model: Model, shares: list[float], settling: bool) -> None:
        """A row: where the specimen stands now, and the share of each load."""
        moved, now = self.surroundings.moved(model), np.array(shares)
        self.done = self.done + 0.5 * (now + self.shares) * (moved - self.moved)
        self.moved, self.shares = moved, now
        if settling:
            self.settled = self.done


def balance(holds: tuple[tuple[str, str], ...], loads: tuple[str, ...], standing: Standing) -> dict[str, Any]:
    """Force (N) and moment (N m, about the origin of the scene) of every support, the drive and every load, and what is
    left of their sum; holds: name, and what it takes hold of. At rest nothing is left; else it moves the specimen."""
    found: dict[str, Any] = {"step": standing.step, "displacement_m": standing.displacement}
    for (name, on), acts in zip(holds, standing.reactions, strict=True):
        found[name] = {"on": on, **_words(acts)}
    for name, acts in zip(loads, standing.loads, strict=True):
        found[name] = _words(acts)
    found["sum"] = _words(standing.reactions.sum(axis=0) + standing.loads.sum(axis=0))
    return found


def _words(acts: np.ndarray) -> dict[str, list[float]]:
    return {"force_n": acts[:3].tolist(), "moment_nm": acts[3:].tolist()}
