"""Checks between chunks: whether the motion is still to be trusted."""

from math import inf

import numpy as np

from geometry.jit_cache import compiled
from masonry.configuration.configuration import configuration_of
from masonry.configuration.energy import open_in_contacts
from masonry.configuration.parts.loose_blocks import loose_blocks
from masonry.configuration.parts.parts import parts_of
from masonry.errors import Stopped, TurnedTooFar
from masonry.model.kinds import dof_words
from masonry.model.model import Model
from masonry.monitors.observer import Observer, View
from masonry.monitors.snap_back_watch import SnapBack
from masonry.rows.columns import stored_in
from masonry.runtime.state_file import State

RINGING = 100.0
"""Kinetic energy above this multiple of the external work is an instability: a stable step at 0.99 keeps below 50."""
TORN_LEDGER = 0.2
"""Share of the external work by which the two sums of the dissipation may differ before a run is stopped, beside what
they differ by in rows that set as much of what is stored free: what snaps does so within a few steps."""
STRETCHED = 1e-10
"""Share of the smallest block by which the stiffest bar is stretched at the least work that is looked at, if there are
bars. The force of a bar that is pulled aside from rest grows as the third power of the way: over its first steps the
two sums differ by half, of next to nothing."""

FALLS = 'What falls needs displacements = "large"'
"""What to do about it in small displacement."""

FAST = 0.05
"""Of the fastest: components of motion that are slower on average count as if they were as fast."""


class Watch(Observer):
    """Stops a run whose numbers can no longer be trusted, and names the block to blame."""

    REMEMBERED = ("rotation", "work", "stored", "torn", "snapped")

    def __init__(self, model: Model, rotation_limit: float) -> None:
        self.model = model
        self.configuration = configuration_of(model)
        self.rotation_limit = inf if self.configuration.any_size else rotation_limit
        self.rotation = self.work = self.stored = self.torn = self.snapped = 0.0
        self.size = smallest_block(model)
        self.leap = self.configuration.leap * self.size
        self.arm = np.array([1.0] * 3 + [self.size] * 9)
        self.snap_back = SnapBack(model)
        self.least = stiffest(model) * (STRETCHED * self.size) ** 2

    def check(self, step: int) -> None:
        """Raise Stopped if a velocity is not finite or leaps, a block has turned too far, or a law snaps back."""
        for body in self.model.bodies:
            if body is not None:
                speed = fastest(body.v, self.arm)
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
        for part in parts_of(self.model):
            speed = np.abs(part.body.v) * self.arm[: part.body.v.shape[1]]
            speed = np.where(np.isfinite(speed), speed, np.inf)
            row, i = np.unravel_index(int(np.argmax(speed)), speed.shape)
            best = max(best, (float(speed[row, i]), part.name, int(row), int(i)))
        return best[1:]

    def look(self, model: Model, view: View, step: int) -> dict[str, float]:
        """Raise Stopped if the energies of a row (J) can no longer be those of the specimen.

        An instability that the softening feeds on may stay small; the ledger shows it. Of a dry block that is pushed
        over the works of drive and weight cancel, and damping lends what it moves with.
        """
        terms = view.terms
        self.work = max(self.work, abs(terms["external_work"]))
        work = self.work + (abs(terms["damping"]) if model.dry else 0.0)
        torn, stored = open_in_contacts(terms), stored_in(terms)
        self.snapped += min(abs(torn - self.torn), max(self.stored - stored, 0.0))
        self.torn, self.stored = torn, stored
        open_ = abs(torn) - self.snapped
        if self.work > self.least and (abs(terms["kinetic"]) > RINGING * work or open_ > TORN_LEDGER * work):
            self._stop_unstable(step)
        return {"rotation": self.rotation}

    def _stop_unstable(self, step: int) -> None:
        model = self.model
        why = (
            f"The time step is {model.dt:.4g} s; the proven bound is {model.bound:.4g} s (limited by "
            f'{model.limited_by}). Use time_step = "gershgorin" with step_fraction <= 1'
        )
        kind, row, i = self._fastest()
        block = int(model.layout.owner[kind][row])
        if model.dt <= model.bound:
            why = self.configuration.advice(self.leap)
            bears = np.abs(model.contacts.force[: len(model.group)]).sum(axis=1) > 0.0
            if not self.configuration.any_size and loose_blocks(model, bears)[block]:
                why = f"Block {block} came loose: no joint that bears anything holds it. {FALLS}"
        raise Stopped(f"unstable at step {step}: {dof_words(model.layout, kind, row, i)}, runs away. {why}")

    def _check_rotation(self, step: int) -> None:
        for part in parts_of(self.model):
            rotation = part.rotations()
            most = float(rotation.max())
            if most > self.rotation_limit:
                more = min(2.0 * self.rotation_limit, 1.5)
                block = int(part.blocks[int(np.argmax(rotation.max(axis=1)))])
                where = ", ".join(f"{x:.4g}" for x in self.model.layout.centroid[block])
                raise TurnedTooFar(
                    f"step {step}: {part.name} block {block} at ({where}) m has rotated by {most:.3g} rad, more than "
                    f"solver.rotation_limit = {self.rotation_limit:g}. Displacements are linear in rotations here: a "
                    f"turn of {more:g} rad leaves an error of {50.0 * more**2:.2g} %. To accept that: --set "
                    f"solver.rotation_limit={more:g}. {FALLS}"
                )
            self.rotation = max(self.rotation, most)


class Swings(Observer):
    """How far swings go in a step: (w dt)^2 by the rows so far, w being the angular frequency of the mean square, the
    most of any component of a block or node among those that move fast."""

    REMEMBERED = ("changes", "motion")

    def __init__(self, model: Model) -> None:
        self.arm = np.array([1.0] * 3 + [smallest_block(model)] * 9)
        self.changes = [np.zeros_like(part.body.v) for part in parts_of(model)]
        self.motion = [np.zeros_like(part.body.v) for part in parts_of(model)]

    def look(self, model: Model, view: View, step: int) -> dict[str, float]:
        arrays = zip(parts_of(model), self.changes, self.motion, view.before, strict=True)
        for part, changes, motion, old in () if view.settling else arrays:
            arm = self.arm[: old.shape[1]]
            changes += (arm * (part.body.v - old)) ** 2
            motion += (arm * part.body.v) ** 2
        least = max(FAST**2 * max(float(motion.max(initial=0.0)) for motion in self.motion), 1e-300)
        pairs = zip(self.changes, self.motion, strict=True)
        most = max(float((changes / np.maximum(motion, least)).max(initial=0.0)) for changes, motion in pairs)
        return {"swing_in_a_step": most}


@compiled
def fastest(v, arm):
    """The largest of velocities (rows, n), each times an arm; not a number where one is none."""
    most = 0.0
    for row in range(len(v)):
        for i in range(v.shape[1]):
            speed = abs(v[row, i]) * arm[i]
            if not speed <= most:
                most = speed
                if np.isnan(speed):
                    return speed
    return most


def stiffest(model: Model) -> float:
    """N/m, of the stiffest element; 0 without any."""
    return max((element.stiffest for element in model.elements), default=0.0)


def smallest_block(model: Model) -> float:
    """Edge (m) of a cube of the volume of the smallest block."""
    return float(np.cbrt(model.layout.volume.min()))
