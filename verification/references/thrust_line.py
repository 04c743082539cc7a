"""The largest factor of vertical loads on an arch by its line of thrust, joint by joint, without blocks or contacts.

The force and moment that pass through the first joint are three unknowns; at any other joint the loads before it are
taken away. An arch stands where at each joint the resultant presses, passes within it, and lies within the friction
angle: linear in the unknowns and in the factor (Heyman 1966; Gilbert and Melbourne 1994).
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import linprog

FINE = 200_000
"""Strips into which earth is cut."""


@dataclass(frozen=True)
class Ring:
    """An arch of plane joints between fixed abutments: (n + 1, 2, 2) m, x and z of the inner and outer ends, from left
    to right."""

    joints: np.ndarray

    @property
    def outlines(self) -> np.ndarray:
        """(n, 4, 2) m of the voussoirs."""
        a, b = self.joints[:-1], self.joints[1:]
        return np.stack([a[:, 0], a[:, 1], b[:, 1], b[:, 0]], axis=1)

    def weights(self, per_area: float) -> tuple[np.ndarray, np.ndarray]:
        """(n,) N and (n,) m: weight of each voussoir and x of its centroid; per_area N/m2."""
        x, z = self.outlines[:, :, 0], self.outlines[:, :, 1]
        cross = x * np.roll(z, -1, axis=1) - np.roll(x, -1, axis=1) * z
        area = 0.5 * cross.sum(axis=1)
        centre = ((x + np.roll(x, -1, axis=1)) * cross).sum(axis=1) / (6.0 * area)
        return per_area * np.abs(area), centre

    def pressed(self, x: np.ndarray, force: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(n,) N and (n,) m of small forces (m,) N at places (m,) m: what comes to each voussoir's extrados."""
        outer = self.joints[:, 1, 0]
        inside = (x > outer[0]) & (x < outer[-1])
        owner = np.searchsorted(outer, x[inside]) - 1
        total = np.bincount(owner, force[inside], len(outer) - 1)
        moment = np.bincount(owner, force[inside] * x[inside], len(outer) - 1)
        return total, moment / np.where(total > 0.0, total, 1.0)

    def height(self, x: np.ndarray) -> np.ndarray:
        """Z of the extrados, m; beside it that of its ends."""
        return np.asarray(np.interp(x, self.joints[:, 1, 0], self.joints[:, 1, 1]))

    def filled(self, level: float, per_area: float) -> tuple[np.ndarray, np.ndarray]:
        """Weight of earth up to a level (m) on each voussoir, per_area N/m2, and where it acts."""
        outer = self.joints[:, 1, 0]
        ends = np.linspace(outer[0], outer[-1], FINE + 1)
        x = 0.5 * (ends[1:] + ends[:-1])
        return self.pressed(x, per_area * np.maximum(level - self.height(x), 0.0) * np.diff(ends))

    def under_axle(
        self, load: float, x: float, level: float, patch: float, tan_spread: float
    ) -> tuple[np.ndarray, np.ndarray]:
        """What an axle (N) at x (m) on a road presses each voussoir with, and where."""
        half = 0.5 * patch + tan_spread * (level - float(self.height(np.array([x]))[0]))
        ends = np.clip(self.joints[:, 1, 0], x - half, x + half)
        return load * np.diff(ends) / (2.0 * half), 0.5 * (ends[1:] + ends[:-1])

    def largest_factor(self, dead: np.ndarray, live: np.ndarray, tan_friction: float) -> float:
        """The largest factor of live loads: (n, 2) downward forces N and their moments F x, N m, of each voussoir.

        inf where any factor is balanced; ValueError where the dead loads are not.
        """
        inner, outer = self.joints[:, 0], self.joints[:, 1]
        before = [np.vstack([np.zeros(2), np.cumsum(load, axis=0)]) for load in (dead, live)]
        count = len(inner)
        # unknowns: H, V, moment about the origin (x Fz - z Fx), factor
        force_x = np.tile([1.0, 0.0, 0.0, 0.0], (count, 1))
        force_z = np.column_stack([np.zeros(count), np.ones(count), np.zeros(count), -before[1][:, 0]])
        moment = np.column_stack([np.zeros((count, 2)), np.ones(count), -before[1][:, 1]])
        along = (outer - inner) / np.linalg.norm(outer - inner, axis=1)[:, None]
        normal = np.column_stack([along[:, 1], -along[:, 0]])
        rows, right = [], []

        def at_most(coefficients: np.ndarray, constant: np.ndarray) -> None:
            """Coefficients . unknowns + constant <= 0"""
            rows.append(coefficients)
            right.append(-constant)

        for end, sign in ((inner, 1.0), (outer, -1.0)):
            at_most(
                sign * (moment - end[:, :1] * force_z + end[:, 1:] * force_x),
                sign * (-before[0][:, 1] + end[:, 0] * before[0][:, 0]),
            )
        across, shear = (d[:, :1] * force_x + d[:, 1:] * force_z for d in (normal, along))
        across_dead, shear_dead = (-d[:, 1] * before[0][:, 0] for d in (normal, along))
        for sign in (1.0, -1.0):
            at_most(sign * shear - tan_friction * across, sign * shear_dead - tan_friction * across_dead)
        bounds = [(None, None)] * 3 + [(0.0, None)]
        answer = linprog([0, 0, 0, -1.0], np.vstack(rows), np.concatenate(right), bounds=bounds, method="highs")
        if answer.status in (3, 4):
            return np.inf
        if answer.status:
            raise ValueError("no line of thrust under the dead loads lies within the arch")
        return float(answer.x[3])


def ring(span: float, rise: float, thickness: float, voussoirs: int) -> Ring:
    """Of an intrados over a span with a rise (m), in the middle of x = 0, springing at z = 0."""
    inner = (0.25 * span**2 + rise**2) / (2.0 * rise)
    half = np.arccos((inner - rise) / inner)
    angle = np.linspace(-half, half, voussoirs + 1)
    way = np.column_stack([np.sin(angle), np.cos(angle)])
    centre = np.array([0.0, rise - inner])
    return Ring(np.stack([centre + inner * way, centre + (inner + thickness) * way], axis=1))


def added(*loads: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """(n, 2) forces and moments of loads and the places where they act."""
    return np.asarray(sum(np.column_stack([force, force * x]) for force, x in loads))
