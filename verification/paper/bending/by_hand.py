"""Horizontal bending by hand: what a wall in running bond carries by each path that a crack may take through it.

All cracks stand between the load rollers, where the moment is constant. A crack goes through the head joints at
mid-length of every other course; in each course between, it goes either on through the unit, or round it: through the
next head joint, which turns the bed joints between by friction and cohesion (torsion about z), each over half a unit.
With W = H t^2/6 and f the tensile strength that a course meets, for the nominal stress M/W

    brittle: all parts reach their first limit together   mean f + n T_e/W,    T_e = tau J/r about the middle
    plastic: all parts yield, an upper bound              3 mean f + n T_p/W,  T_p = tau int r dA about the pressed edge

with tau = c - sigma tan(phi) in each of n bed joints, an overlap of a x t each, J = a t (a^2 + t^2)/12 and r its half
diagonal. The least over all paths is the estimate.
"""

from dataclasses import dataclass
from itertools import product

import numpy as np

from masonry.errors import SceneError
from masonry.scene import Scene
from masonry.scene.tables.specimen import BendingSpec


@dataclass(frozen=True)
class BentWall:
    """Strengths in Pa, lengths in m: of interfaces and units in tension, of a bed joint in shear; overlap, thickness,
    height; number of courses."""

    interface: float
    units: float
    shear: float
    overlap: float
    thickness: float
    height: float
    courses: int

    def paths(self) -> set[tuple[int, int]]:
        """(courses cracked through the unit, bed joints turned) of every path that the crack may take."""
        between = range(0, self.courses, 2)
        beds = [(c > 0) + (c < self.courses - 1) for c in between]
        choices = product((0, 1), repeat=len(beds))
        return {(len(beds) - sum(c), int(np.dot(c, beds))) for c in choices}

    def brittle(self, path: tuple[int, int]) -> float:
        """Nominal stress M/W (Pa) if all parts reach their first limit together."""
        a, t = self.overlap, self.thickness
        torsion = self.shear * a * t * (a**2 + t**2) / 12 / (0.5 * np.hypot(a, t))
        return self._tension(path) + path[1] * torsion / self._modulus

    def plastic(self, path: tuple[int, int]) -> float:
        """Nominal stress M/W (Pa) if all parts yield, about the pressed edge: an upper bound."""
        return (
            3.0 * self._tension(path) + path[1] * self.shear * edge_moment(self.overlap, self.thickness) / self._modulus
        )

    def bounds(self) -> tuple[float, float]:
        """The least of both over all paths, Pa."""
        return min(map(self.brittle, self.paths())), min(map(self.plastic, self.paths()))

    @property
    def _modulus(self) -> float:
        return self.height * self.thickness**2 / 6

    def _tension(self, path: tuple[int, int]) -> float:
        return (path[0] * self.units + (self.courses - path[0]) * self.interface) / self.courses


def wall_of(scene: Scene) -> BentWall:
    """The wall of a bending scene."""
    spec, joint, unit = bending_spec(scene), scene.contact["unit_unit"], scene.contact["within_units"]
    strengths = (joint.tensile_strength, unit.tensile_strength, joint.cohesion, joint.tan_friction)
    interface, units, cohesion, friction = (float(value or 0.0) for value in strengths)
    return BentWall(
        interface,
        units,
        cohesion + friction * float(scene.confinement or 0.0),
        0.5 * (spec.unit_length + spec.joint_thickness),
        spec.thickness,
        spec.courses * (spec.unit_height + spec.joint_thickness),
        spec.courses,
    )


def bending_spec(scene: Scene) -> BendingSpec:
    """The specimen of a bending scene; SceneError for another kind."""
    if not isinstance(scene.specimen, BendingSpec):
        raise SceneError(f"{scene.name}: specimen.kind is '{scene.specimen.kind}'; only 'bending' is known by hand")
    return scene.specimen


def edge_moment(a: float, t: float) -> float:
    """Integral (m3) of the distance from the middle of a side of length a over a rectangle a x t: half that of a
    rectangle a x 2 t from its middle."""
    b, d = 2.0 * t, float(np.hypot(a, 2.0 * t))
    mean = d / 6 + a**2 / (12 * b) * np.log((b + d) / a) + b**2 / (12 * a) * np.log((a + d) / b)
    return float(mean * a * t)
