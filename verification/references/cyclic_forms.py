"""Closed form of a couplet that is sheared back and forth under constant compression, one leg after the other.

A leg begins elastically, with slope k_s. It slides where it meets the strength that is left, and then goes on along the
envelope where it left it: with the softening variable "displacement" by the way that it makes while it slides, with
"plastic" by the plastic slip r. Tension and cohesion keep each other's share: nothing opens. See `closed_forms` for the
envelopes.
"""

from dataclasses import dataclass

import numpy as np

from verification.references.closed_forms import Floats, Joint, shear, shear_work


@dataclass
class Sheared:
    """A joint on its way: place and stress at the last turn, what it has slid, and energy that is gone (J/m2).

    slid  m: place on the envelope ("displacement"), or the path of plastic slip ("plastic")
    """

    law: str
    joint: Joint
    compression: float
    variable: str = "displacement"
    place: float = 0.0
    stress: float = 0.0
    slid: float = 0.0
    gone: float = 0.0

    @property
    def peak_at(self) -> float:
        """us0 = t_max/ks (m)."""
        return float(self.joint.peak(self.compression)) / self.joint.ks

    def strength(self, slid: Floats) -> Floats:
        """Pa, after sliding so far."""
        total = slid + self.peak_at if self.variable == "plastic" else np.maximum(slid, self.peak_at)
        return shear(self.law, self.joint, total, self.compression)

    def along(self, places: Floats) -> tuple[Floats, Floats]:
        """Stress (Pa) and energy gone (J/m2) at places (n,) m on one leg in order; the last one is the next turn."""
        direction = np.sign(places[-1] - self.place)
        made = np.abs(places - self.place)
        slid = self.slid_by(made, float(direction * self.stress))
        elastic = direction * self.stress + self.joint.ks * made
        stress = np.minimum(elastic, self.strength(slid))
        gone = self.gone + self.dissipated_in_leg(slid)
        self.place, self.stress = float(places[-1]), float(direction * stress[-1])
        self.slid, self.gone = float(slid[-1]), float(gone[-1])
        return direction * stress, gone

    def slid_by(self, made: Floats, start: float) -> Floats:
        """The softening variable `made` m from the start of a leg at `start` Pa."""
        if self.variable == "displacement":
            first = max(self.slid, self.peak_at)
            elastic = (float(self.strength(np.array([first]))[0]) - start) / self.joint.ks
            return np.asarray(first + np.maximum(made - elastic, 0.0))
        path = self.slid + np.concatenate([[0.0], np.geomspace(1e-12, made[-1], 200_001)])
        reached = path - self.slid + (self.strength(path) - start) / self.joint.ks
        return np.asarray(np.interp(made, reached, path))

    def dissipated_in_leg(self, slid: Floats) -> Floats:
        """Energy (J/m2) that the leg has taken: under the envelope, less what stays elastic by the total slip."""
        if self.variable == "plastic":
            return self._under(slid + self.peak_at) - self._under(np.array([self.slid + self.peak_at]))
        first = np.array([max(self.slid, self.peak_at)])
        stored = 0.5 * (self.strength(slid) ** 2 - self.strength(first) ** 2) / self.joint.ks
        return self._under(slid) - self._under(first) - stored

    def _under(self, slip: Floats) -> Floats:
        return shear_work(self.law, self.joint, slip, self.compression)


def legs(places: Floats) -> list[slice]:
    """The rows (n,) m of a drive, split where it turns; each leg ends with its reversal."""
    direction = np.sign(np.diff(places))
    reversals = np.flatnonzero(direction[1:] * direction[:-1] < 0.0) + 1
    bounds = [-1, *reversals.tolist(), len(places) - 1]
    return [slice(a + 1, b + 1) for a, b in zip(bounds[:-1], bounds[1:], strict=True)]


def followed(joint: Sheared, places: Floats) -> tuple[Floats, Floats]:
    """Stress (Pa) and energy gone (J/m2) at all places (n,) m that a drive passed, in order, from 0."""
    stresses = [joint.along(places[leg]) for leg in legs(places)]
    return np.concatenate([stress for stress, _ in stresses]), np.concatenate([gone for _, gone in stresses])
