"""Rigid blocks: in small displacement, and turning as far as they like."""

import numpy as np

from geometry.jit_cache import compiled
from masonry.configuration.parts.part import MovingPart, Rows
from masonry.kinematics import turning
from masonry.kinematics.matrices import rotation_angles


@compiled
def move_corners(q, rotation, row, arm, moved):
    """Write the displacements (p, 3) m of points of rows (p,) with arms (p, 3) m; rotation (b, 3) about x, y, z."""
    for p in range(len(row)):
        b = row[p]
        x, y, z = rotation[b]
        moved[p, 0] = q[b, 0] + (y * arm[p, 2] - z * arm[p, 1])
        moved[p, 1] = q[b, 1] + (z * arm[p, 0] - x * arm[p, 2])
        moved[p, 2] = q[b, 2] + (x * arm[p, 1] - y * arm[p, 0])


class RigidPart(MovingPart):
    """Rigid blocks of small rotations about their principal axes."""

    deforms = False

    def moved_corners(self, row: np.ndarray, arm: np.ndarray) -> np.ndarray:
        rotation = np.einsum("bij,bj->bi", self.axes, self.body.q[:, 3:])
        moved = np.empty(arm.shape)
        move_corners(self.body.q, rotation, row, arm, moved)
        return moved

    def rotations(self) -> np.ndarray:
        return np.abs(self.body.q[:, 3:])

    def turns_about(self) -> np.ndarray:
        return self._about(getattr(self.body, "axes", None))

    def _about(self, axes: np.ndarray | None) -> np.ndarray:
        return np.asarray(self.free[:, 3:, None] * (np.eye(3) if axes is None else np.swapaxes(axes, 1, 2)))


class TurningPart(RigidPart):
    """Rigid blocks whose angular momenta are kept, and that turn as far as they like; moments are about x, y, z."""

    def remembered(self) -> np.ndarray:
        return turning.momenta(self.body)

    def velocities(self, remembered: np.ndarray) -> np.ndarray:
        """The second three are angular momenta."""
        q = self.principal
        spin = np.einsum("bij,bj->bi", q, np.einsum("bji,bj->bi", q, remembered[:, 3:]) / self.body.inertia)
        return np.concatenate([remembered[:, :3], spin], axis=1)

    @property
    def principal(self) -> np.ndarray:
        """(b, 3, 3) principal axes as the blocks stand now, in columns."""
        body = self.body
        return np.asarray(body.frame if body.axes is None else body.frame @ body.axes)

    def momenta(self, v: np.ndarray) -> np.ndarray:
        """Without turns of blocks that are held about some axes."""
        momenta = super().momenta(v)
        q = self.principal
        own = np.einsum("bij,bj->bi", q, self.body.inertia * np.einsum("bji,bj->bi", q, v[:, 3:]))
        momenta[:, 3:] = np.where(np.all(self.free[:, 3:], axis=1, keepdims=True), own, 0.0)
        return momenta

    def gained(self, before: np.ndarray) -> np.ndarray:
        gained = super().gained(before)
        gained[:, 3:] = self.body.momentum - before[:, 3:]
        return gained

    def kinetic(self, before: np.ndarray) -> float:
        return turning.kinetic(self.body, self.masses, before)

    def kinetic_of_blocks(self) -> np.ndarray:
        body = self.body
        moving = self.masses * body.v**2
        return np.asarray(0.5 * np.column_stack([moving[:, :3], body.momentum * body.v[:, 3:]]).sum(axis=1))

    def strike(self, change: np.ndarray, earlier: np.ndarray) -> None:
        self.body.momentum[...] += self.momenta(change)[:, 3:]
        super().strike(change, earlier)

    def brake(self, left: float, before: np.ndarray) -> None:
        self.strike((left - 1.0) * self.body.v, self.velocities(before))

    def blow(self, change: np.ndarray, before: np.ndarray) -> None:
        """Blocks that turned before start from their momentum, which has no masses. The change is about the principal
        axes."""
        body = self.body
        change = change.copy()
        change[:, 3:] = np.einsum("bij,bj->bi", self.axes, change[:, 3:])
        energy = self.masses * change * (body.v + 0.5 * change - 0.5 * (body.v - before))
        body.v[...] += change
        turned_before = 0.5 * np.einsum("bi,bi->b", body.momentum, body.v[:, 3:] - change[:, 3:])
        turning.spin(body)
        energy[:, 3:] = 0.0
        energy[:, 3] = 0.5 * np.einsum("bi,bi->b", body.momentum, body.v[:, 3:]) - turned_before
        self.book(2, energy.sum(axis=1))

    @property
    def place(self) -> np.ndarray:
        return np.asarray(self.layout.place[self.name] + self.body.q[:, :3])

    def moved_corners(self, row: np.ndarray, arm: np.ndarray) -> np.ndarray:
        body = self.body
        return np.asarray(body.q[:, :3][row] + np.einsum("cij,cj->ci", body.frame[row] - np.eye(3), arm))

    def rotations(self) -> np.ndarray:
        return rotation_angles(self.body.frame)[:, None]

    def turns_about(self) -> np.ndarray:
        return self._about(None)

    def load(self, rows: np.ndarray, load: np.ndarray) -> np.ndarray:
        """Moments about x, y, z, from those about the principal axes at the start."""
        return np.column_stack([load[:, :3], np.einsum("bij,bj->bi", self.axes[rows], load[:, 3:])])

    def moments(self, rows: Rows, forces: np.ndarray) -> np.ndarray:
        return forces
