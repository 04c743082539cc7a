"""The bodies of one kind in small displacement: their motion is linear in their dofs, and arms stay as they were."""

from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from geometry.jit_cache import compiled
from masonry.model.kinds import KindOfMotion
from masonry.model.model import Model

Rows = np.ndarray | slice


class Strain(NamedTuple):
    """Elastic energy (J) of the bodies of a kind, the least det F, and a bound on the longest stretch of any line."""

    energy: float = 0.0
    least: float = 1.0
    longest: float = 1.0


class MovingPart:
    """The bodies of one kind of a model; values come in rows of dofs, one a block, or a node of tets.

    kind, name  the kind of motion     body  its arrays     blocks (b,), owner (rows,)  as in Layout
    masses   (rows, dofs) kg, kg m2 of motion, 0 where held
    deforms  whether the blocks hold elastic energy
    """

    deforms = True

    def __init__(self, model: Model, kind: KindOfMotion, body: Any) -> None:
        self.model, self.layout, self.kind, self.name, self.body = model, model.layout, kind, kind.name, body
        self.blocks, self.owner = model.layout.members[kind.name], model.layout.owner[kind.name]
        self.masses = model.masses[kind.name]

    @property
    def displacements(self) -> np.ndarray:
        """(rows, dofs) m, and turns or strains."""
        return self.kind.displacements(self.body, self.model.u)

    def saved_displacements(self, saved: dict[str, np.ndarray]) -> np.ndarray:
        """The same in a state that was kept (configuration/written.py)."""
        return saved[f"{self.name}.q"]

    @property
    def free(self) -> np.ndarray:
        """(rows, dofs) which dofs nothing holds."""
        return np.asarray(self.body.dt_over_mass > 0.0)

    def sums(self, values: np.ndarray) -> np.ndarray:
        """(b, ...) of each block, from values (rows, ...)."""
        return self.kind.sums(self.layout, values)

    def mean(self, values: np.ndarray) -> np.ndarray:
        """(b, n) of each block, from values (rows, n)."""
        return self.kind.mean(self.layout, values)

    def largest(self, values: np.ndarray) -> np.ndarray:
        """(b, n) the largest of each block, from values (rows, n)."""
        return self.kind.largest(self.layout, values)

    def spread(self, values: np.ndarray) -> np.ndarray:
        """(rows,) what blocks (B,) have."""
        return self.kind.spread(self.layout, values)

    # motion and energy

    def remembered(self) -> np.ndarray:
        """(rows, dofs) what `kinetic` needs to know of the velocities a step later: a copy."""
        return np.array(self.body.v)

    def velocities(self, remembered: np.ndarray) -> np.ndarray:
        """(rows, dofs) velocities, from what was remembered of them."""
        return remembered

    def momenta(self, v: np.ndarray) -> np.ndarray:
        """(rows, dofs) mass times velocity (rows, dofs) of all that is free."""
        return np.asarray(self.masses * v)

    def gained(self, before: np.ndarray) -> np.ndarray:
        """(rows, dofs) by how much momenta have grown since velocities were remembered."""
        return np.asarray(self.masses * (self.body.v - before))

    def kinetic(self, before: np.ndarray) -> float:
        """v(n-1/2) M v(n+1/2) / 2 (J), with which the balance closes to round-off; before: `remembered` a step ago."""
        return 0.5 * float(np.sum(self.masses * before * self.body.v))

    def kinetic_of_blocks(self) -> np.ndarray:
        """(b,) J of each block, now."""
        return 0.5 * self.sums((self.masses * self.body.v**2).sum(axis=1))

    def strain(self, stress: np.ndarray) -> Strain:
        """Strain of blocks that deform; stress (b, 6) Pa m3 out, over the volume at the start."""
        raise NotImplementedError

    # impulses

    def strike(self, change: np.ndarray, earlier: np.ndarray) -> None:
        """Change the velocities (rows, dofs) of all that is free, and book the impulse that this takes: as a force of
        the damping in this step, which it does work by at the velocities `earlier` (a step before), so that the energy
        balance stays closed."""
        impulse = self.momenta(change)
        self.body.hold[...] += impulse / self.model.dt
        self.book(1, 0.5 * impulse * earlier)
        self.body.v[...] += np.where(impulse != 0.0, change, 0.0)

    def brake(self, left: float, before: np.ndarray) -> None:
        """Leave a share of each free velocity, by an impulse booked in the same way."""
        body, impulse = self.body, (left - 1.0) * self.masses * self.body.v / self.model.dt
        body.hold[...] += impulse
        self.book(1, impulse * before, 0.5 * self.model.dt)
        body.v[...] = np.where(self.masses > 0.0, left * body.v, body.v)

    def blow(self, change: np.ndarray, before: np.ndarray) -> None:
        """Add to the velocities (rows, dofs), and book the work as external: before, `remembered` a step ago.

        The kinetic energy of a row is v(n-1/2) M v(n+1/2) / 2, and the forces of this step do half of their work with
        the velocity after it: a blow dv between them adds v' M v' / 2 - v M v / 2 - (v - v(n-1/2)) M dv / 2, with
        v' = v + dv.
        """
        body = self.body
        energy = self.masses * change * (body.v + 0.5 * change - 0.5 * (body.v - before))
        body.v[...] += change
        self.book(2, energy.sum(axis=1))

    def book(self, account: int, energy: np.ndarray, times: float = 1.0) -> None:
        """Work (rows, dofs) or (rows,) J of the damping (1) or external (2), so many times; that of nodes, which are
        not told apart by block, in the first account."""
        work = self.body.work
        if len(energy) == len(work):
            work[:, account] += times * energy.reshape(len(energy), -1).sum(axis=1)
        else:
            work[0, account] += times * energy.sum()

    # places and forces

    @property
    def place(self) -> np.ndarray:
        """(rows, 3) m, of centroids or nodes, to which arms are measured: before loading."""
        return self.layout.place[self.name]

    @property
    def axes(self) -> np.ndarray:
        """(rows, 3, 3) along which dofs beyond the first three are, in columns."""
        return self._axes

    @cached_property
    def _axes(self) -> np.ndarray:
        return self.layout.axes[self.owner]

    def moved_corners(self, row: np.ndarray, arm: np.ndarray) -> np.ndarray:
        """(p, 3) m, displacements of points of rows (p,) with arms (p, 3) m from the centroid."""
        raise NotImplementedError

    def rotations(self) -> np.ndarray:
        """(b, n) rad, by which each block has rotated, n components."""
        raise NotImplementedError

    def turns_about(self) -> np.ndarray:
        """(b, 3, 3): the rows are axes about which each block is free to rotate; 0 where it is not."""
        raise NotImplementedError

    def load(self, rows: np.ndarray, load: np.ndarray) -> np.ndarray:
        """A dead load on rows (n, dofs) as it acts now: as it was given."""
        return load

    def resultant(self, rows: Rows, forces: np.ndarray) -> np.ndarray:
        """(6,) force (N) and moment (N m) about the origin of generalised forces (n, dofs) on some rows (n,)."""
        sums = np.zeros(6)
        add_up(self.place[rows], forces, self.moments(rows, forces[:, 3:]), sums)
        return sums

    def moments(self, rows: Rows, forces: np.ndarray) -> np.ndarray:
        """(n, 3) N m of forces (n, dofs - 3) on rows (n,), about the centroid and about x, y, z."""
        return self.kind.moments(self.axes[rows], forces)


@compiled
def add_up(place, forces, moment, sums):
    """Add to the sums (6,) of force and moment about the origin: forces (n, >= 3) N at places (n, 3) m, and moments
    (n, 3) N m about these."""
    for n in range(len(forces)):
        x, y, z = place[n, 0], place[n, 1], place[n, 2]
        along_x, along_y, along_z = forces[n, 0], forces[n, 1], forces[n, 2]
        sums[0] += along_x
        sums[1] += along_y
        sums[2] += along_z
        sums[3] += moment[n, 0] + (y * along_z - z * along_y)
        sums[4] += moment[n, 1] + (z * along_x - x * along_z)
        sums[5] += moment[n, 2] + (x * along_y - y * along_x)
