"""What is looked at between chunks: is the motion still to be trusted."""

import numpy as np

from masonry.configuration.energy import open_in_contacts
from masonry.errors import Stopped, TurnedTooFar
from masonry.kinematics.matrices import rotation_angles, rotations
from masonry.kinematics.tets import mean_rotation
from masonry.model.layout import KINDS
from masonry.model.model import Model
from masonry.monitors.observer import Observer, View
from masonry.monitors.snap_back import SnapBack
from masonry.runtime.state import State

LEAP, LARGE_LEAP = 1e-2, 1e-1
"""A dof that moves by more than this share of the smallest block in one step is not a motion but an instability; in
large displacement it may be one, but what it meets is not told well."""
RINGING = 100.0
"""Kinetic energy above this multiple of the external work is an instability: a stable step at 0.99 keeps below 50."""
TORN_LEDGER = 0.2
"""Share of the external work by which the two sums of the dissipation may differ before a run is stopped."""


class Watch(Observer):
    """Stops a run whose numbers can no longer be trusted, and names the block to blame."""

    REMEMBERED = ("rotation", "work")

    def __init__(self, model: Model, rotation_limit: float) -> None:
        self.model = model
        self.rotation_limit = rotation_limit
        self.rotation = 0.0
        self.work = 0.0
        self.size = smallest_block(model)
        self.leap = (LEAP if model.large is None else LARGE_LEAP) * self.size
        self.arm = np.array([1.0] * 3 + [self.size] * 9)
        self.affine = model.layout.members["affine"]
        self.tet_rotation = np.zeros((len(model.layout.members["tets"]), 3))
        self.snap_back = SnapBack(model)

    def check(self, step: int) -> None:
        """Raise Stopped if a velocity is not finite or leaps, a block has turned too far, or a law snaps back."""
        for body in self.model.bodies:
            if body is not None:
                speed = float((np.abs(body.v) * self.arm[: body.v.shape[1]]).max())
                if not speed * self.model.dt <= self.leap:  # nor is it where a velocity is not a number
                    self._stop_unstable(step)
        self._check_rotation(step)
        self.snap_back.check(step)

    def state(self) -> State:
        """The largest rotation and work so far, and what contacts were like at the last look."""
        return {**super().state(), "snap_back": self.snap_back.state()}

    def restore(self, state: State) -> None:
        super().restore(state)
        self.snap_back.restore(state["snap_back"])

    def _fastest(self) -> tuple[str, int, int]:
        """Kind, row and dof of what moves fastest, turns and strains times the block size."""
        best = (-1.0, "", 0, 0)
        for kind, body in zip(KINDS, self.model.bodies, strict=True):
            if body is None:
                continue
            speed = np.abs(body.v) * self.arm[: body.v.shape[1]]
            speed = np.where(np.isfinite(speed), speed, np.inf)
            row, i = np.unravel_index(int(np.argmax(speed)), speed.shape)
            best = max(best, (float(speed[row, i]), kind, int(row), int(i)))
        return best[1:]

    def look(self, model: Model, view: View, step: int) -> dict[str, float]:
        """Raise Stopped if the energies of a row (J) can no longer be those of the specimen.

        An instability that the softening feeds on may stay small; the ledger shows it. Of a dry block that is pushed
        over the works of drive and weight cancel, and damping lends what it moves with.
        """
        terms = view.terms
        self.work = max(self.work, abs(terms["external_work"]))
        work = self.work + (abs(terms["damping"]) if model.dry else 0.0)
        torn = abs(open_in_contacts(terms))
        if self.work > 0.0 and (abs(terms["kinetic"]) > RINGING * work or torn > TORN_LEDGER * work):
            self._stop_unstable(step)
        return {"rotation": self.rotation}

    def _stop_unstable(self, step: int) -> None:
        model = self.model
        why = (
            f"The time step is {model.dt:.4g} s; the proven bound is {model.bound:.4g} s (limited by "
            f'{model.limited_by}). Use time_step = "gershgorin" with step_fraction <= 1'
        )
        if model.dt <= model.bound and model.large is not None:
            why = (
                f"In large displacement nothing may move by more than {LARGE_LEAP:g} of the smallest block "
                f"({self.size:.3g} m) in one step ({model.dt:.3g} s), that is {self.leap / model.dt:.4g} m/s. Where it "
                "is to be as fast, take a smaller solver.time_step; where not, a velocity or a load is too large"
            )
        elif model.dt <= model.bound:
            why = (
                "The time step is within its proven bound, so the drive is too fast (take more steps or a lower rate), "
                "a load too large, or a contact too soft for this specimen"
            )
        raise Stopped(f"unstable at step {step}: {model.layout.dof(*self._fastest())}, runs away. {why}")

    def _check_rotation(self, step: int) -> None:
        rigid, affine, tets = self.model.bodies
        largest_rotations = []
        if self.model.large is not None:
            frames = [] if rigid is None else [rigid.frame]
            frames += [rotations(body.frame) for body in (affine, tets) if body is not None]
            self.rotation = max(self.rotation, *(float(rotation_angles(frame).max()) for frame in frames))
            return
        if rigid is not None:
            largest_rotations.append((np.abs(rigid.q[:, 3:]), "rigid"))
        if affine is not None:
            h = np.einsum("bij,bkj->bik", affine.q[:, 3:].reshape(-1, 3, 3), self.model.layout.axes[self.affine])
            largest_rotations.append((0.5 * np.abs(h - h.transpose(0, 2, 1)).reshape(-1, 9), "affine"))
        if tets is not None:
            mean_rotation(tets, self.model.contacts.u, self.tet_rotation)
            largest_rotations.append((np.abs(self.tet_rotation), "tets"))
        for rotation, kind in largest_rotations:
            most = float(rotation.max())
            if most > self.rotation_limit:
                more = min(2.0 * self.rotation_limit, 1.5)
                block = int(self.model.layout.members[kind][int(np.argmax(rotation.max(axis=1)))])
                where = ", ".join(f"{x:.4g}" for x in self.model.layout.centroid[block])
                raise TurnedTooFar(
                    f"step {step}: {kind} block {block} at ({where}) m has rotated by {most:.3g} rad, more than "
                    f"solver.rotation_limit = {self.rotation_limit:g}. Displacements are linear in rotations here: a "
                    f"turn of {more:g} rad leaves an error of {50.0 * more**2:.2g} %. To accept that: --set "
                    f"solver.rotation_limit={more:g}"
                )
            self.rotation = max(self.rotation, most)


def smallest_block(model: Model) -> float:
    """Edge (m) of a cube of the volume of the smallest block."""
    return float(np.cbrt(model.layout.volume.min()))
