"""Observers where blocks may fall and deform as they like: which falls first, overlaps, large strains."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from geometry.polyhedra.measures import bounds, widths
from geometry.specimens.placed import FLOOR
from masonry.configuration.configuration import configuration_of
from masonry.configuration.parts.parts import parts_of
from masonry.errors import MovedTooFar, Stopped
from masonry.model.model import Model
from masonry.monitors.observer import Observer, View
from masonry.monitors.openings import CRUSHED, require_bearing, thinner

DROPPED = 0.5
"""Of its least width: how far a block has gone down, along its weight, when it counts as fallen."""

THROUGH = 0.5
"""Of the least width of the thinner of two blocks: an overlap at which one has as far to go forward as back."""


@dataclass(frozen=True)
class Fallen:
    """The first block that had fallen, at which step, and the terms of the energy ledger (J) then."""

    block: int
    step: int
    energies: dict[str, float]


@dataclass(frozen=True)
class LeftFloor:
    """The first block that left the floor, when (s), and how many blocks did."""

    block: int
    time: float
    blocks: int


class Strains(NamedTuple):
    """The least det F and the longest stretch of any line; and that for which the stable time step is proven."""

    least_volume: float
    longest: float
    proven: float


class Collapse(Observer):
    """Looks for the first block that has fallen, and for those that have left the floor, where there is one: they are
    lower than its underside. Without weight nothing falls.

    weight  (3,) along which blocks fall; None: each along its load, which may turn. Forces of inertia are no weight:
            what slides along them has not fallen
    """

    REMEMBERED = ("block", "step", "energies", "left", "first_left", "time_left")

    def __init__(self, model: Model, weight: Sequence[float] | None = None) -> None:
        self.weight = None if weight is None else np.array(weight)
        self.block, self.step = -1, 0
        self.left, self.first_left, self.time_left = 0, -1, 0.0
        self.energies: dict[str, float] = {}
        low, _ = bounds(model.blocks)
        self.width = widths(model.blocks)
        self.extent = thinner(model) if model.swept else np.zeros(0)
        self.configuration = configuration_of(model)
        floor = np.array([group == FLOOR for group in model.blocks.groups])[model.blocks.group]
        self.underside = low[floor, 2].min(initial=np.inf) if floor.any() else -np.inf
        self.free = np.zeros(model.blocks.count, dtype=bool)
        for part in parts_of(model):
            self.free[part.blocks] = part.sums(part.free[:, :3].any(axis=1).astype(float)) > 0.0

    @property
    def has_fallen(self) -> bool:
        return self.block >= 0

    def look(self, model: Model, view: View, step: int) -> dict[str, float]:
        if not self.has_fallen:
            drop, carried = np.zeros(len(self.width)), 0.0
            for part in parts_of(model):
                if part.body.load is not None:
                    weight = part.sums(part.body.load[:, :3]) if self.weight is None else self.weight[None]
                    moved = part.mean(part.displacements[:, :3])
                    down = weight / np.maximum(np.linalg.norm(weight, axis=1), 1e-300)[:, None]
                    drop[part.blocks] = np.einsum("bi,bi->b", down, moved)
                    if not part.kind.nodal:  # what a drive or a support lets down, and what it bears, has not fallen
                        led = np.where(part.free[:, :3], 0.0, down * moved).sum(axis=1)
                        carried = max(carried, float(led.max(initial=0.0)))
            drop = np.where(self.free, (drop - carried) / self.width, 0.0)
            if drop.max(initial=0.0) > DROPPED:
                self.block, self.step = int(drop.argmax()), step
                self.energies = {key: value for key, value in view.terms.items() if key != "imbalance"}
        if self.underside > -np.inf:
            self._look_below(model, step)
        opening, overlap = view.seen.opening, self._overlap(model, step)
        if model.swept:
            crushing = self.configuration.crushing
            require_bearing(model, crushing, self.extent, step)
            closures = np.where(model.alive, crushing.closed(opening) / self.extent, 0.0)
            overlap = max(overlap, float(closures.max(initial=0.0)))
        return {"widest": float(opening.max(initial=0.0)), "overlap": overlap}

    def _overlap(self, model: Model, step: int) -> float:
        """The deepest overlap of two blocks, over the least width of the thinner one. Raises Stopped above a half, and
        MovedTooFar where they crushed by more than a tenth."""
        share, pair = self.configuration.crushing.in_patches(self.width)
        if share > CRUSHED:
            raise MovedTooFar(
                f"step {step}: {model.two_blocks(*pair)} have crushed where they meet by {share:.3g} of the width of "
                "the thinner one: what is left of the strength does not bear what presses it"
            )
        overlap, pair = self.configuration.patches.deepest(self.width)
        if overlap > THROUGH:
            both = model.two_blocks(*pair)
            raise Stopped(
                f"step {step}: {both} overlap by {overlap:.2g} of the width of the thinner one; beyond "
                "half of it one leaves the other on the far side. The normal stiffness of their contact is too low for "
                "their speed or load"
            )
        return overlap

    def _look_below(self, model: Model, step: int) -> None:
        height = model.layout.centroid[:, 2].copy()
        for part in parts_of(model):
            height[part.blocks] += part.mean(part.displacements)[:, 2]
        below = self.free & (height < self.underside)
        self.left = int(below.sum())
        if self.first_left < 0 and self.left:
            self.first_left, self.time_left = int(below.argmax()), step * model.dt

    def records(self) -> list[Any]:
        fallen = [Fallen(self.block, self.step, self.energies)] if self.has_fallen else []
        return [*fallen, *([LeftFloor(self.first_left, self.time_left, self.left)] if self.first_left >= 0 else [])]


class LargestDeformation(Observer):
    """Keeps the least det F, and the longest stretch of any line, of all rows."""

    REMEMBERED = ("least", "longest")

    def __init__(self, stretch: float) -> None:
        self.stretch, self.least, self.longest = stretch, 1.0, 1.0

    def look(self, model: Model, view: View, step: int) -> dict[str, float]:
        self.least, self.longest = min(self.least, view.least), max(self.longest, view.longest)
        return {}

    def records(self) -> list[Any]:
        return [Strains(self.least, self.longest, self.stretch)]
