"""Frequencies of a stack of rigid blocks on elastic joints, by transfer matrices, and of the beam it comes near to.

 | b | h   each block: mass m, inertia I about its middle; each joint below it: shear
 |---|     k = ks A, turning r = kn A b^2/12 about its middle
 |   |
 |---|     (Myklestad, 1944, J. Aeronaut. Sci. 11, 153-162, with shear in place of bending between masses)
 |   |
//////     in the limit a beam of GA = k h, EI = r h, with rotary inertia (Timoshenko, 1921)
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq

Floats = np.ndarray


@dataclass(frozen=True)
class Stack:
    """count blocks of width b (m) in the plane, depth and height (m), density (kg/m3), and kn, ks (Pa/m) of joints."""

    count: int
    width: float
    depth: float
    height: float
    density: float
    kn: float
    ks: float

    @property
    def area(self) -> float:
        return self.width * self.depth

    @property
    def mass(self) -> float:
        return self.density * self.area * self.height

    @property
    def inertia(self) -> float:
        return self.mass * (self.width**2 + self.height**2) / 12.0

    @property
    def shear(self) -> float:
        return self.ks * self.area

    @property
    def turning(self) -> float:
        return self.kn * self.area * self.width**2 / 12.0

    def up_and_down(self) -> Floats:
        """(n,) Hz, rising: a chain of n masses on n springs, w = 2 sqrt(k/m) sin((2 j - 1) pi/(4 n + 2))."""
        j = np.arange(1, self.count + 1)
        speed = 2.0 * np.sqrt(self.kn * self.area / self.mass)
        return np.asarray(speed * np.sin((2 * j - 1) * np.pi / (4 * self.count + 2)) / (2.0 * np.pi))

    def sideways(self, number: int) -> list[float]:
        """Hz, the slowest modes that rock and shear in the plane."""
        return roots(self._free_top, 0.3 * self.beam(1)[0], number)

    def beam(self, number: int) -> list[float]:
        """Hz of a Timoshenko beam from the middle of the lowest joint, which is half a block below the masses."""
        return roots(self._free_end, 1e-3 * float(self.up_and_down()[0]), number)

    def _free_top(self, omega: float) -> float:
        """0 where no force and no moment is left above the uppermost block; state: u, turn, force, moment there."""
        half, square = self.height / 2.0, omega**2
        joint = np.eye(4)
        joint[0, 2], joint[1, 3] = 1.0 / self.shear, 1.0 / self.turning
        rise = np.eye(4)  # along half a block: u grows by the turn, the moment falls by the force
        rise[0, 1], rise[3, 2] = half, -half
        inert = np.eye(4)
        inert[2, 0], inert[3, 1] = -self.mass * square, -self.inertia * square
        transfer = rise @ inert @ rise @ joint
        return _determinant(np.linalg.matrix_power(transfer, self.count))

    def _free_end(self, omega: float) -> float:
        """The same of the beam."""
        line, square = self.mass / self.height, omega**2
        shear, bending = self.shear * self.height, self.turning * self.height
        rotary = self.inertia / self.height
        slope = np.array(
            [
                [0.0, 1.0, 1.0 / shear, 0.0],
                [0.0, 0.0, 0.0, 1.0 / bending],
                [-line * square, 0.0, 0.0, 0.0],
                [0.0, -rotary * square, -1.0, 0.0],
            ]
        )
        below = np.eye(4)  # half of the lowest joint's compliance is beneath the masses
        below[0, 2], below[1, 3] = self.height / 2.0 / shear, self.height / 2.0 / bending
        return _determinant(expm(slope * self.height * self.count) @ below)


def _determinant(transfer: Floats) -> float:
    """Of what force and moment at the foot become at the top."""
    return float(np.linalg.det(transfer[2:, 2:]))


def roots(of: Callable[[float], float], start: float, number: int) -> list[float]:
    """Hz: the first zeros of a function of the angular frequency above a start (Hz)."""
    zeros: list[float] = []
    low = 2.0 * np.pi * start
    value = of(low)
    while len(zeros) < number:
        high = 1.01 * low
        after = of(high)
        if value * after < 0.0:
            zeros.append(brentq(of, low, high, xtol=1e-12 * low, rtol=1e-14) / (2.0 * np.pi))
        low, value = high, after
    return zeros


STACK = Stack(count=4, width=0.5, depth=0.2, height=0.25, density=2000.0, kn=1e9, ks=0.5e9)
"""That of the scene `stack`, but for the number of its blocks."""


def boxes(stack: Stack) -> list[dict[str, Any]]:
    """Entries of [[specimen.box]]: the foot, and the blocks upon it."""
    size = stack.width, stack.depth, stack.height
    low = [(-0.5 * stack.width, -0.5 * stack.depth, k * stack.height) for k in range(-1, stack.count)]
    names = ["foot", *(f"block {k}" for k in range(1, stack.count + 1))]
    return [
        {"name": name, "origin": [f"{x!r} m" for x in corner], "size": [f"{x!r} m" for x in size], "unit": k}
        for k, (name, corner) in enumerate(zip(names, low, strict=True))
    ]


def keys_of(stack: Stack) -> dict[str, Any]:
    """Keys by which the scene `stack` becomes this stack."""
    return {
        "specimen.box": boxes(stack),
        "material.units.density": f"{stack.density!r} kg/m^3",
        "contact.unit_unit.normal_stiffness": f"{stack.kn!r} Pa/m",
        "contact.unit_unit.shear_stiffness": f"{stack.ks!r} Pa/m",
    }


def set_off(stack: Stack, speed: np.ndarray, spin: np.ndarray) -> list[dict[str, Any]]:
    """Entries of [[motion]]: blocks that start at speeds (n,) m/s along x and spins (n,) rad/s about y."""
    return [
        {
            "on": f"block {k + 1}",
            "velocity": [f"{float(speed[k])!r} m/s", 0, 0],
            "spin": [0, f"{float(spin[k])!r} rad/s", 0],
        }
        for k in range(stack.count)
    ]
