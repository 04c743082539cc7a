"""Force of a drive that is borne at rest: its force less what inertia and damping hold up.

A row is out of balance where forces r are left on what is free: what inertia and damping take. Held at that place, the
specimen would come to rest, and the force of the drive would change by that of its small move there: by r along the
displacement that a unit of the drive brings. That is known as it was expected, and as it is now: the larger of the two
counts, so that a force is taken for borne only where both say so. Force times lever and moment times turn add up in it,
block by block.

Where much of the motion was not expected, neither says so: a block that damping holds up as it turns hardly moves,
while the drive goes on. There a force is taken for borne where all that is left could not change it, did it act on the
drive: force for force, and moment over half the least width of its block; of this such a share as of the energy.
"""

import numpy as np

from geometry.polyhedra.measures import widths
from masonry.configuration.parts.parts import parts_of
from masonry.model.model import Model
from masonry.runtime.state_file import Remembering

BALANCED = 0.25
"""Accuracies by which a force may exceed what is borne at rest, over the largest: it counts as it is."""
MORE = 1.25
"""Times as much as either says is taken off: what swings widely is not known better."""
AT_REST = 0.01
"""Of the tolerance: where the drive is held, the specimen is at rest as soon as its force changes by less in a look."""
HALF = 0.5
"""Of the least width of a block: no edge about which it turns is nearer to where a drive pushes it."""
NEAR = 0.9
"""Share of the largest force from which on the next may be larger."""


class BorneForce(Remembering):
    """Follows the force of a drive, of which so much counts for its peak as is borne.

    tolerance  share of the largest force below which nothing is in excess
    towards    sign of the direction in which the drive sets out
    excess     N, signed as the force: what of it is not borne at the end of the last increment
    place      m, of the drive there        borne  N, along the drive: what was borne there
    slope      N/m, by which that rose before, at least 0; 0 where it was not in balance
    balanced   whether nothing was in excess there, or missing; steady  whether so before
    highest    N, the most that was borne        lowest  N, the least, along the drive: where it turns back
    last       N, along the drive, of its force there
    paused     whether it rested there           follows  whether what was not expected is in balance there
    arm        (B,) m, by which moments that are left count as forces
    largest_excess  N, the most at any step by which the force exceeded what counts
    most_off   N, the most that inertia and damping took or gave since `taken` was asked
    """

    REMEMBERED = (
        *("excess", "place", "borne", "slope", "highest", "lowest", "last", "most_off", "largest_excess"),
        *("paused", "follows", "steady", "balanced"),
    )

    def __init__(self, model: Model, accuracy: float, towards: float) -> None:
        self.model, self.tolerance, self.towards = model, BALANCED * accuracy, towards
        self.excess = self.place = self.borne = self.slope = self.highest = self.last = self.most_off = 0.0
        self.lowest = self.largest_excess = 0.0
        self.paused, self.follows, self.steady, self.balanced = False, True, True, True
        self.arm = HALF * widths(model.blocks)

    def begin(self, force: float) -> None:
        """The dead loads have settled, with the drive at such a force (N, signed)."""
        self.borne = self.highest = self.lowest = self.last = self.towards * force

    @property
    def may_be_highest(self) -> bool:
        """Whether the next force may be higher than all before."""
        return self.borne >= NEAR * self.highest

    def taken(self) -> float:
        """N, the most that inertia and damping took or gave in the last increment; the next begins."""
        most, self.most_off = self.most_off, 0.0
        return most

    def feel(self, before: list[np.ndarray], speed: float, force: float, most: float) -> None:
        """See by how much the force (N, signed) of a drive of such a speed (m/s, signed) exceeds what is borne;
        before: velocities a step earlier; most: N, the largest force so far."""
        self.paused = speed == 0.0
        expected = current = foreseen = unforeseen = at_most = 0.0
        for part, old in zip(parts_of(self.model), before, strict=True):
            left, v, guess = part.gained(old) / self.model.dt - part.body.hold, part.body.v, part.body.guess
            left[~part.free] = 0.0
            expected += float(np.sum(left * guess))
            current += float(np.sum(left * v))
            foreseen += float(np.sum(part.masses * (speed * guess) ** 2))
            unforeseen += float(np.sum(part.masses * (v - speed * guess) ** 2))
            at_most += float(np.abs(left[:, :3]).sum())
            if not part.kind.nodal:
                at_most += float((np.abs(left[:, 3:]).sum(axis=1) / self.arm[part.blocks]).sum())
        either = expected, 0.0 if self.paused else current / speed
        off, least = max(abs(one) for one in either), self.tolerance * max(most, abs(force))
        sign = -1.0 if force < 0.0 else 1.0
        excess = min(MORE * max(sign * one for one in either), abs(force))
        self.excess = sign * excess if excess > least else 0.0
        unknown = at_most * unforeseen / max(foreseen + unforeseen, 1e-300)
        self.follows, self.most_off = unknown <= least, max(self.most_off, off)
        self.steady, self.balanced = self.balanced, off <= least

    def count(self, path: np.ndarray, force: np.ndarray) -> np.ndarray:
        """(n,) N of the forces (n,) N, signed, at the steps of an increment at places (n,) m: so much as is borne.

        That is as much as at its end; or, where it falls, as it would be had it risen until then as it did before: so
        does what breaks. What sets out with a jerk does not. While the specimen moves by itself, or the drive is held
        for it and it is not at rest, no force counts that is higher than what was borne before; nor, in a row, lower.
        """
        along, way = self.towards * force, np.abs(path - self.place)
        borne = float(along[-1] - self.towards * self.excess)
        changes = abs(float(along[-1]) - self.last) > AT_REST * self.tolerance * abs(self.last)
        by_itself = changes if self.paused else not self.follows
        if by_itself and not self.lowest <= borne <= self.highest:
            borne = min(max(borne, self.lowest), self.highest)
            self.excess = self.towards * (float(along[-1]) - borne)
        ceiling = np.full(len(along), borne)
        if not self.paused and (self.balanced or borne < self.borne):
            ceiling = np.maximum(ceiling, self.borne + self.slope * way)
        steady = self.steady and self.balanced and not (self.paused or by_itself)
        self.slope = max((borne - self.borne) / float(way[-1]), 0.0) if steady else 0.0
        self.place, self.last, self.highest = float(path[-1]), float(along[-1]), max(self.highest, borne)
        self.lowest = min(self.lowest, borne)
        self.borne = float(along[-1]) if self.paused and not by_itself else borne
        counts = along <= ceiling + (0.0 if by_itself else self.tolerance) * np.maximum(ceiling, 0.0)
        self.largest_excess = max(self.largest_excess, float((along - ceiling)[~counts].max(initial=0.0)))
        return self.towards * np.where(counts, along, ceiling)
