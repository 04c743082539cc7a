"""Data and results of limit analysis, as plain arrays: bodies, contact points, solutions."""

from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from masonry.statics.crushing import Crushing

STEEP = 1e3
"""The greatest tangent of friction that is reckoned with. A normal force may be off by the tolerance of a solver: so
much, times the tangent, is what shear may come to from nothing."""


@dataclass(frozen=True)
class RigidBodies:
    """Rigid blocks with loads. Forces in N along x, y, z, then moments in N m about axes through the centre.

    centre    (B, 3) m, the centre of mass
    free      (B, 6) whether a block may move along, and turn about, x, y and z
    dead      (B, 6) loads that stay as they are
    live      (B, 6) loads that are multiplied by the factor
    together  (B, 6) dofs that move as one, by the same amount; None without any
    """

    centre: np.ndarray
    free: np.ndarray
    dead: np.ndarray
    live: np.ndarray
    together: np.ndarray | None = None


@dataclass(frozen=True)
class RigidContacts:
    """Points at which two blocks touch, and what each can bear. A normal force above 0 presses.

    block_a, block_b  (C,)
    point             (C, 3) m
    normal            (C, 3) unit vector from a to b
    patch             (C,) the plane polygon that the point is a corner of
    area              (C,) m2 that the point stands for
    friction          (C,) tangent of the friction angle
    cohesion          (C,) N, the shear force borne without pressure
    tension           (C,) N, the greatest pull
    solid             (C,) whether the point bears any force
    crush             what compression the polygons bear; None without a limit
    link, limit       (C,) whether it is no point but a link, such as a bar, whose normal force above 0 pulls its ends
                      together, along a normal from b to a; and N, the greatest normal force; None without any
    pretension        (C,) N, the normal force before anything loads or moves; None where there are no links
    """

    block_a: np.ndarray
    block_b: np.ndarray
    point: np.ndarray
    normal: np.ndarray
    patch: np.ndarray
    area: np.ndarray
    friction: np.ndarray
    cohesion: np.ndarray
    tension: np.ndarray
    solid: np.ndarray
    crush: Crushing | None = None
    link: np.ndarray | None = None
    limit: np.ndarray | None = None
    pretension: np.ndarray | None = None

    @property
    def count(self) -> int:
        return len(self.block_a)

    def weakened(self, by: float) -> "RigidContacts":
        """The same with friction, cohesion and tension divided by a number; an endless tension and links stay so."""
        tension = np.where(np.isinf(self.tension) | self.is_link, self.tension, self.tension / by)
        return replace(self, friction=self.friction / by, cohesion=self.cohesion / by, tension=tension)

    def with_strength(self, times: float) -> "RigidContacts":
        """The same with cohesion, tension, compressive strength, and what links bear and are tightened to, times a
        number."""
        crush = None if self.crush is None else self.crush.times(times)
        limit, tightened = (None if force is None else force * times for force in (self.limit, self.pretension))
        grown = {"cohesion": self.cohesion * times, "tension": self.tension * times}
        return replace(self, **grown, crush=crush, limit=limit, pretension=tightened)

    @property
    def is_link(self) -> np.ndarray:
        """(C,) which of them are links, such as bars."""
        return np.zeros(self.count, dtype=bool) if self.link is None else self.link

    @property
    def cone_friction(self) -> np.ndarray:
        """(C,) the tangent of friction that is reckoned with, STEEP at most: a cone within the true one."""
        return np.minimum(self.friction, STEEP)

    @property
    def has_strength(self) -> bool:
        """Whether anything but friction limits what a point bears."""
        return self.crush is not None or bool(self.cohesion.any() or self.tension.any() or self.is_link.any())

    def select(self, which: np.ndarray) -> "RigidContacts":
        """Some of them; compression is without a limit."""
        arrays = [(entry.name, getattr(self, entry.name)) for entry in fields(self) if entry.name != "crush"]
        chosen: dict[str, Any] = {name: array[which] for name, array in arrays if array is not None}
        return RigidContacts(**chosen)


@dataclass(frozen=True)
class Sizes:
    """In what units a problem is written: force (B,) N and length (B,) m of each block, and the factor that counts
    as 1."""

    force: np.ndarray
    length: np.ndarray
    factor: float


@dataclass(frozen=True)
class Solution:
    """Solution of an optimisation.

    status    "solved", "infeasible" (no factor is balanced), "unbounded" (every factor is)
    factor    the largest factor
    normal    (C,) N at each contact point
    shear     (C, 3) N at each contact point, in its plane, from a on b
    velocity  (B, 6) of the mechanism, m/s and rad/s at the centres; the live load does 1 W on it
    gap       difference between the factor and that of the dual problem, over the factor
    unbalance what is left on the block that is balanced worst, over its own loads, or the forces at its contacts
              where these are more
    worst     the block
    sizes     the units in which it was solved; None without an answer
    """

    status: str
    factor: float
    normal: np.ndarray
    shear: np.ndarray
    velocity: np.ndarray
    gap: float = 0.0
    unbalance: float = 0.0
    worst: int = 0
    sizes: Sizes | None = None
