"""The largest factor of vertical loads on an arch by its line of thrust, joint by joint, without blocks or contacts.

The force and moment that pass through the first joint are three unknowns; at any other joint the loads before it are
taken away. An arch stands where at each joint the resultant presses, passes within it, and lies within the friction
angle: linear in the unknowns and in the factor (Heyman 1966; Gilbert and Melbourne 1994).
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import linprog

GAUSS = np.array([-1.0, 1.0]) / np.sqrt(3.0)
"""Places at which two points integrate a cubic over -1 to 1, with weights of 1."""


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
        area, middle = _area_and_middle(self.outlines)
        return per_area * area, middle

    def height(self, x: np.ndarray) -> np.ndarray:
        """Z of the extrados, m; beside it that of its ends."""
        return np.asarray(np.interp(x, self.joints[:, 1, 0], self.joints[:, 1, 1]))

    def filled(self, level: float, per_area: float) -> tuple[np.ndarray, np.ndarray]:
        """Weight of earth up to a level (m) above all voussoirs, per_area N/m2, and where it acts."""
        x = self.joints[:, 1, 0]
        middle, half = 0.5 * (x[1:] + x[:-1]), 0.5 * np.diff(x)
        places = middle[:, None] + half[:, None] * GAUSS
        columns = per_area * half[:, None] * (level - self.height(places))
        total = columns.sum(axis=1)
        return total, (columns * places).sum(axis=1) / total

    def under_axle(
        self, load: float, x: float, level: float, patch: float, tan_spread: float
    ) -> tuple[np.ndarray, np.ndarray]:
        """Forces on each voussoir from an axle (N) at x (m) on a road, and where they act."""
        half = 0.5 * patch + tan_spread * (level - float(self.height(np.array([x]))[0]))
        ends = np.clip(self.joints[:, 1, 0], x - half, x + half)
        return load * np.diff(ends) / (2.0 * half), 0.5 * (ends[1:] + ends[:-1])

    def cuts(self, dead: np.ndarray, live: np.ndarray, first: int, unknowns: int) -> "Cuts":
        """Forces and moment in each joint, to the right; unknowns first, first + 1, first + 2 of so many are the force
        along x and z in the first joint, and its moment.

        dead, live  (n, 2) downward forces N of each voussoir, and their moments F x, N m
        """
        count = len(self.joints)
        dead_before, live_before = (np.vstack([np.zeros(2), np.cumsum(load, axis=0)]) for load in (dead, live))
        wrench = np.zeros((count, 3, unknowns + 2))
        wrench[:, np.arange(3), first + np.arange(3)] = 1.0
        wrench[:, 1:, -2], wrench[:, 1:, -1] = -live_before, -dead_before
        return Cuts(self.joints, wrench)

    def largest_factor(self, dead: np.ndarray, live: np.ndarray, tan_friction: float) -> float:
        """The largest factor of live loads on this arch alone; loads as in `cuts`, the rest as `largest_factor`."""
        return largest_factor([self.cuts(dead, live, 0, 3)], tan_friction)


@dataclass(frozen=True)
class Cuts:
    """Joints and what passes through them, as linear in some unknowns.

    joints  (n, 2, 2) m, x and z of both ends: forces that press go to the right of one who looks from the first end to
            the second
    wrench  (n, 3, u + 2) force along x and z, and moment x Fz - z Fx about the origin, of each unknown, of the factor,
            and of the dead loads
    """

    joints: np.ndarray
    wrench: np.ndarray

    def conditions(self, tan_friction: float) -> np.ndarray:
        """(4 n, u + 2) of which none may be above 0: the resultant passes between the ends, within friction."""
        force_x, force_z, moment = (self.wrench[:, k] for k in range(3))
        first, second = self.joints[:, 0], self.joints[:, 1]
        along = (second - first) / np.linalg.norm(second - first, axis=1)[:, None]
        normal = np.column_stack([along[:, 1], -along[:, 0]])
        about = [moment - end[:, :1] * force_z + end[:, 1:] * force_x for end in (first, second)]
        across, shear = (d[:, :1] * force_x + d[:, 1:] * force_z for d in (normal, along))
        return np.vstack([about[0], -about[1], shear - tan_friction * across, -shear - tan_friction * across])


def largest_factor(cuts: list[Cuts], tan_friction: float) -> float:
    """The largest factor at which all cuts bear what passes through them.

    inf where any factor is balanced; ValueError where the dead loads are not.
    """
    rows = np.vstack([cut.conditions(tan_friction) for cut in cuts])
    scale = np.abs(rows[:, -1]).max() or 1.0
    cost = np.zeros(rows.shape[1] - 1)
    cost[-1] = -1.0
    bounds = [(None, None)] * (len(cost) - 1) + [(0.0, None)]
    matrix = np.column_stack([rows[:, :-2], rows[:, -2] / scale])
    answer = linprog(cost, matrix, -rows[:, -1] / scale, bounds=bounds, method="highs")
    if answer.status in (3, 4):
        return np.inf
    if answer.status:
        raise ValueError("no line of thrust under the dead loads lies within the arch")
    return float(answer.x[-1])


@dataclass(frozen=True)
class Spans:
    """Arches side by side whose intrados spring at z = 0, on piers of some width, height (m) and number of courses, the
    uppermost of which is cut to the springings."""

    rings: tuple[Ring, ...]
    piers: tuple[tuple[float, float, int], ...]

    @property
    def extrados(self) -> Ring:
        """Voussoirs and springers side by side, of which the outer ends alone mean anything."""
        return Ring(np.concatenate([ring.joints for ring in self.rings]))

    def largest_factor(self, weight: float, dead: np.ndarray, live: np.ndarray, tan_friction: float) -> float:
        """As `largest_factor`.

        weight      of the stone, N/m2
        dead, live  (n, 2) N and N m, of what lies on voussoirs and springers, side by side
        """
        starts = np.cumsum([0, *(len(ring.joints) for ring in self.rings)])
        cuts = []
        for k, ring in enumerate(self.rings):
            rows = slice(starts[k], starts[k + 1] - 1)
            cuts.append(ring.cuts(added(ring.weights(weight)) + dead[rows], live[rows], 3 * k, 3 * len(self.rings)))
        for k, pier in enumerate(self.piers):
            on_top = np.stack([live[starts[k + 1] - 1], dead[starts[k + 1] - 1]])
            cuts.append(_pier_cuts(cuts[k], cuts[k + 1], pier, weight, on_top))
        return largest_factor(cuts, tan_friction)


def _pier_cuts(before: Cuts, behind: Cuts, pier: tuple[float, float, int], weight: float, on_top: np.ndarray) -> Cuts:
    """Of the bed joints of a pier between two arches; on_top (2, 2) force and moment on it, of the factor and dead."""
    (width, height, courses), x_left = pier, before.joints[-1, 0, 0]
    rise = height / courses
    head = np.array([[x_left, -rise], [x_left + width, -rise], *behind.joints[0], *before.joints[-1, ::-1]])
    area, centre = _area_and_middle(head)
    wrench, joints = before.wrench[-1] - behind.wrench[0], []
    wrench[1:, -2:] -= on_top.T
    all_wrenches = []
    for course in range(courses):
        load, x = (weight * area, centre) if course == 0 else (weight * width * rise, x_left + 0.5 * width)
        wrench = wrench - np.outer([0.0, load, load * x], np.eye(wrench.shape[1])[-1])
        joints.append([[x_left, -rise * (course + 1)], [x_left + width, -rise * (course + 1)]])
        all_wrenches.append(wrench)
    return Cuts(np.array(joints), np.array(all_wrenches))


def _area_and_middle(outline: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """m2 and x (m) of the centroid of polygons (..., n, 2) m, whichever way round."""
    x, z = outline[..., 0], outline[..., 1]
    cross = x * np.roll(z, -1, axis=-1) - np.roll(x, -1, axis=-1) * z
    area = 0.5 * cross.sum(axis=-1)
    return np.abs(area), ((x + np.roll(x, -1, axis=-1)) * cross).sum(axis=-1) / (6.0 * area)


def ring(span: float, rise: float, thickness: float, voussoirs: int, middle: float = 0.0) -> Ring:
    """Of an intrados over a span with a rise (m), springing at z = 0, its middle at some x (m)."""
    inner = (0.25 * span**2 + rise**2) / (2.0 * rise)
    half = np.arccos((inner - rise) / inner)
    angle = np.linspace(-half, half, voussoirs + 1)
    way = np.column_stack([np.sin(angle), np.cos(angle)])
    centre = np.array([middle, rise - inner])
    return Ring(np.stack([centre + inner * way, centre + (inner + thickness) * way], axis=1))


def added(*loads: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """(n, 2) forces and moments of loads and the places where they act."""
    return np.asarray(sum(np.column_stack([force, force * x]) for force, x in loads))
