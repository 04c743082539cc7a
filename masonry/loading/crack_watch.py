"""A sudden crack in a run at a constant rate or in steps: the drive is held, and the specimen brought to rest.

What a sudden crack breaks would else depend on the local damping of the run: with little of it the specimen swings
beyond where it comes to rest, and breaks there as well. So all such runs share the viscosity that brakes this swing.
"""

import numpy as np

from masonry.configuration import energy
from masonry.configuration.parts.parts import parts_of
from masonry.model.model import Model
from masonry.monitors.events import PARTED, SuddenCracks
from masonry.rows.rest_criterion import BRAKED
from masonry.runtime.state_file import State, attributes, load_attributes

JUMP, LEAST = 10.0, 1e-5
"""A sudden crack: kinetic energy over what is usual at this speed of the drive, and over the stored energy."""
MEMORY, AFTERWARDS, LOOKS = 0.02, 0.5, 5
"""Share of a look in what is usual; the same for so many looks after the drive was held, as a specimen that has cracked
may swing otherwise."""
STEPS, DECAY, LITTLE = 10, 0.7, 0.1
"""While the drive is held: steps from one braking to the next, the share of the velocities that one leaves, and the
most local damping, as much of it would make a crack creep."""
MOST = 30_000
"""Steps for which the drive is held in all: what falls over never comes to rest."""
REMEMBERED = ("usual", "pause", "stored", "most", "learning", "still", "waited")


class CrackWatch:
    """Looks after each chunk of steps whether the specimen moves by itself, and if so holds the drive until it rests.

    pause  steps for which it has been held so far; 0 while it moves
    steps  steps until the next braking
    """

    steps = STEPS

    def __init__(self, model: Model) -> None:
        assert isinstance(model.damping, float)
        self.model, self.cracks, self.damping = model, SuddenCracks(model), model.damping
        self.usual = self.stored = self.most = 0.0
        self.pause = self.learning = self.still = self.waited = 0

    def see(self, stored: float) -> None:
        """The specimen stores so much (J) now; pieces that came apart are measured by what they stored together."""
        self.most = max(self.most, stored)
        self.stored = max(stored, PARTED * self.most)

    def look(self, step: int, speed: float, before: list[np.ndarray]) -> None:
        """The drive moves at `speed` (m/s) after a step; velocities one step earlier (energy.velocities)."""
        kinetic = abs(energy.kinetic(self.model, before))
        expected = self.usual * speed**2
        if self.pause:
            brake(self.model, before, DECAY)
            self.cracks.sudden(step)
            self.still = self.still + 1 if kinetic <= BRAKED.energy * self.stored else 0
            self.waited += STEPS
            over = self.still >= BRAKED.looks or self.waited >= MOST
            self.hold(0 if over else self.pause + STEPS)
            self.learning = LOOKS
        elif self.leaps(kinetic, expected):
            self.cracks.sudden(step)
            self.hold(STEPS)
            self.still = 0
        else:
            if self.learning:  # what the drive's new start is felt as belongs to the crack before it
                self.cracks.sudden(step)
            else:
                self.cracks.calm(step)
            if speed != 0.0:
                weight = AFTERWARDS if self.learning else MEMORY
                self.usual += weight * (kinetic / speed**2 - self.usual)
            self.learning = max(self.learning - 1, 0)

    def leaps(self, kinetic: float, expected: float) -> bool:
        """Whether so much kinetic energy (J) is a sudden crack where so much is expected; not before anything broke."""
        if self.learning or self.waited >= MOST or self.usual == 0.0:
            return False
        return kinetic > max(JUMP * expected, LEAST * self.stored) and self.cracks.anything_dissipated()

    def hold(self, steps: int) -> None:
        """The drive has been held for so many steps, or (0) moves; its damping follows."""
        self.pause = steps
        self.model.damping = min(self.damping, LITTLE) if steps else self.damping

    def state(self) -> State:
        """State on which the next look depends."""
        return {**attributes(self, REMEMBERED), "cracks": self.cracks.state()}

    def restore(self, state: State) -> None:
        """Go on from there."""
        load_attributes(self, REMEMBERED, state)
        self.cracks.restore(state["cracks"])
        self.hold(self.pause)


def brake(model: Model, before: list[np.ndarray], left: float) -> None:
    """Leave a share of each free velocity: an impulse, booked as a force of the damping in this step, so that the
    energy balance stays closed."""
    for part, old in zip(parts_of(model), before, strict=True):
        part.brake(left, old)
