"""Expected next motion of the specimen: its last one, for as much displacement of the drive.

Every free velocity is the drive's speed times a field (the displacement that the last increment brought, for a unit of
the drive's) plus a rest, and only the rest is damped by viscosity. Steady loading then meets no drag and sends out no
waves; what is damped is what follows from cracks. A little local damping besides ends swings, which the field follows.
"""

import numpy as np

from geometry.jit_cache import compiled
from masonry.configuration.parts.parts import parts_of
from masonry.kinematics.motion import Guided
from masonry.model.damping import LITTLE
from masonry.model.model import Model
from masonry.runtime.state_file import State, attributes, load_attributes

RATIO, SUDDEN = 0.2, 2.0
"""Viscosity over the critical one at the frequency of the expected motion: where all moves as expected, and where
nothing does, so that a specimen with a sudden crack does not swing beyond where it comes to rest, and break there."""
LEAST, MOST = 0.01, 0.3
"""Bounds of the share c dt / 2."""
AT_FIRST = Guided(0.05, LITTLE)
"""The damping until the first increment is made, of the dead loads that settle as well."""


class Predictor:
    """Learns the field from increment to increment, and sets the viscosity of the model's damping.

    kinetic  energy (J) of the expected motion at the last increment's end
    trust    share of the kinetic energy that was expected
    """

    def __init__(self, model: Model) -> None:
        self.model = model
        self.parts = [(part.body, part.masses, part.displacements) for part in parts_of(model)]
        self.last = [place.copy() for _, _, place in self.parts]
        self.energies = [np.empty((2, *place.shape)) for place in self.last]
        self.displacement = self.kinetic = 0.0
        self.trust = 1.0
        self.half_c_dt, model.damping = AT_FIRST.half_c_dt, AT_FIRST

    def _damp(self, half_c_dt: float) -> None:
        self.half_c_dt = half_c_dt
        self.model.damping = Guided(half_c_dt, LITTLE)

    def settle(self, displacement: float = 0.0) -> None:
        """The specimen is at rest with the drive at `displacement` (m, signed): what moved it was not the drive."""
        self.displacement = displacement
        for (_, _, place), last in zip(self.parts, self.last, strict=True):
            last[...] = place

    def learn(self, displacement: float, speed: float, force: float, stiffness: float | None = None) -> None:
        """The drive has come to `displacement` (m, signed), moves at `speed` (m/s) and exerts `force` (N).

        stiffness  N/m, where it is not the force over the displacement
        """
        rest = foreseen = 0.0
        for (body, m, _), (of_rest, of_expected) in zip(self.parts, self.energies, strict=True):
            compare(speed, body.guess, body.v, m, of_rest, of_expected)
            rest += float(np.sum(of_rest))
            foreseen += float(np.sum(of_expected))
        self.trust = trust = foreseen / (foreseen + rest) if foreseen > 0.0 else 1.0
        inertia, travel = 0.0, displacement - self.displacement
        for (body, m, place), last, (energy, _) in zip(self.parts, self.last, self.energies, strict=True):
            expect(trust, travel, place, last, body.dt_over_mass, body.guess, m, energy)
            inertia += float(np.sum(energy))
        self.displacement = displacement
        self.kinetic = 0.5 * inertia * speed**2
        if inertia > 1e-20:  # kg: something moves with the drive, not round-off
            secant = abs(force / displacement) if stiffness is None else stiffness
            ratio = trust * RATIO + (1.0 - trust) * SUDDEN
            wanted = ratio * np.sqrt(secant / inertia) * self.model.dt
            self._damp(float(min(max(wanted, LEAST), MOST)))

    def state(self) -> State:
        """Where all was at the end of the last increment, and the damping that followed; the field is the bodies'."""
        return {
            **attributes(self, ("displacement", "kinetic", "half_c_dt", "trust")),
            "last": [last.copy() for last in self.last],
        }

    def restore(self, state: State) -> None:
        """Go on from there."""
        load_attributes(self, ("displacement", "kinetic", "half_c_dt", "trust"), state)
        for last, saved in zip(self.last, state["last"], strict=True):
            last[...] = saved
        self._damp(self.half_c_dt)


@compiled
def compare(speed, guess, v, m, of_rest, of_expected):
    """Write twice the kinetic energies (rows, dofs) of what moves otherwise than expected, and of what is expected."""
    for row in range(m.shape[0]):
        for i in range(m.shape[1]):
            expected = speed * guess[row, i]
            unexpected = v[row, i] - expected
            of_rest[row, i] = m[row, i] * (unexpected * unexpected)
            of_expected[row, i] = m[row, i] * (expected * expected)


@compiled
def expect(trust, travel, place, last, dt_over_mass, guess, m, energy):
    """Bring the guess nearer to what the last increment of the drive, of so much travel, brought, and keep the place;
    write twice its kinetic energy (rows, dofs)."""
    for row in range(m.shape[0]):
        for i in range(m.shape[1]):
            if dt_over_mass[row, i] == 0.0:
                guess[row, i] = 0.0
            else:
                guess[row, i] += trust * ((place[row, i] - last[row, i]) / travel - guess[row, i])
            last[row, i] = place[row, i]
            energy[row, i] = m[row, i] * (guess[row, i] * guess[row, i])
