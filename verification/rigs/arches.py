"""Arches of voussoirs: their blocks, the least thickness that limit analysis lets stand, and bounds of the thrust."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import linprog

from geometry.blocks import Specimen
from geometry.shapes import from_faces

WIDTH = 0.2
"""m, along y."""
SPRINGER = 0.1
"""m, height of the two blocks that the arch stands on."""


@dataclass(frozen=True)
class Arch:
    """A ring of mean radius 1 m cut into equal voussoirs with plane faces; thickness in m, angle of embrace in rad."""

    voussoirs: int
    thickness: float
    angle: float = np.pi

    def corners(self) -> np.ndarray:
        """(n + 1, 2, 2) m: x, z of the inner and outer end of each joint, from right to left."""
        angle = 0.5 * (np.pi - self.angle) + self.angle * np.arange(self.voussoirs + 1) / self.voussoirs
        radius = 1.0 + self.thickness * np.array([-0.5, 0.5])
        return radius[None, :, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)[:, None, :]

    def quads(self) -> np.ndarray:
        """(n, 4, 2) m: corners of each voussoir, counter-clockwise."""
        c = self.corners()
        return np.stack([c[:-1, 0], c[:-1, 1], c[1:, 1], c[1:, 0]], axis=1)

    def areas_and_centroids(self) -> tuple[np.ndarray, np.ndarray]:
        """(n,) m2 and (n, 2) m by the shoelace formula."""
        p, q = self.quads(), np.roll(self.quads(), -1, axis=1)
        cross = p[:, :, 0] * q[:, :, 1] - q[:, :, 0] * p[:, :, 1]
        area = 0.5 * cross.sum(axis=1)
        return area, np.einsum("nk,nki->ni", cross, p + q) / (6 * area[:, None])

    def specimen(self) -> Specimen:
        """Voussoirs 0 to n - 1, then the springers to the right and left; sets "arch" and "springers"."""
        half = 0.5 * self.thickness
        feet = [np.array([[x - half, -SPRINGER], [x + half, -SPRINGER], [x + half, 0], [x - half, 0]]) for x in (1, -1)]
        polygons = [*self.quads(), *feet]
        n = len(polygons)
        blocks = from_faces([prism(p) for p in polygons], range(n), [0] * n, ("units",))
        return Specimen(
            blocks, {"arch": np.arange(n - 2), "springers": np.array([n - 2, n - 1])}, WIDTH * self.thickness
        )


def prism(polygon: np.ndarray) -> list[np.ndarray]:
    """Faces of a prism over a polygon (k, 2) in x, z, which is counter-clockwise seen from -y."""
    front = np.insert(polygon, 1, 0.0, axis=1)
    back = front + [0.0, WIDTH, 0.0]
    sides = [
        np.array([front[i], back[i], back[j], front[j]])
        for i, j in ((i, (i + 1) % len(front)) for i in range(len(front)))
    ]
    return [front, back[::-1], *sides]


def stands(arch: Arch, friction: float) -> bool:
    """Whether forces at the ends of its joints can carry its weight (Livesley 1978): normal >= 0, |T| <= friction N.

    Unknowns of each joint: normal force at its inner and its outer end, and shear. Three equations a voussoir.
    """
    corner, n = arch.corners(), arch.voussoirs
    area, centre = arch.areas_and_centroids()
    along = corner[:, 1] - corner[:, 0]
    radial = along / np.linalg.norm(along, axis=1)[:, None]
    normal = np.stack([-radial[:, 1], radial[:, 0]], axis=1)  # from voussoir k - 1 to voussoir k
    matrix, load = np.zeros((3 * n, 3 * (n + 1))), np.zeros(3 * n)
    for k in range(n):
        for joint, sign in ((k, 1.0), (k + 1, -1.0)):
            for i, (place, force) in enumerate(
                [
                    (corner[joint, 0], normal[joint]),
                    (corner[joint, 1], normal[joint]),
                    (corner[joint, 0], radial[joint]),
                ]
            ):
                arm = place - centre[k]
                moment = arm[0] * force[1] - arm[1] * force[0]
                matrix[3 * k : 3 * k + 3, 3 * joint + i] = sign * np.array([*force, moment])
        load[3 * k + 1] = area[k] / area.sum()
    slide = np.zeros((2 * (n + 1), 3 * (n + 1)))
    for joint in range(n + 1):
        slide[2 * joint, 3 * joint : 3 * joint + 3] = -friction, -friction, 1.0
        slide[2 * joint + 1, 3 * joint : 3 * joint + 3] = -friction, -friction, -1.0
    bounds = [(0, None), (0, None), (None, None)] * (n + 1)
    found = linprog(np.zeros(matrix.shape[1]), slide, np.zeros(len(slide)), matrix, load, bounds, method="highs")
    return found.status == 0


def least_thickness(voussoirs: int, friction: float, halvings: int = 16) -> float:
    """m, by bisection between 0.05 and 0.15 of the mean radius."""
    low, high = 0.05, 0.15
    for _ in range(halvings):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if stands(Arch(voussoirs, middle), friction) else (middle, high)
    return 0.5 * (low + high)


def least_thrust(arch: Arch) -> float:
    """Of an arch whose abutments have gone apart: hinges at the outer end of a joint near the crown and at the inner
    end of one below it, on either side (Heyman 1966). Over the weight of a volume, its depth, and the radius squared.
    """
    return max(_thrusts(arch, upper=1, lower=0))


def greatest_thrust(arch: Arch) -> float:
    """Of one whose abutments have come nearer to each other: hinges at the inner end above and at the outer below."""
    return min(_thrusts(arch, upper=0, lower=1))


def _thrusts(arch: Arch, upper: int, lower: int) -> list[float]:
    """The thrust of each pair of joints of the right half, with hinges at the inner (0) or outer (1) ends of both.

    By symmetry the upper hinge carries half the weight between it and its mirror image. Moments about the lower one.
    """
    corner, n = arch.corners(), arch.voussoirs
    area, centre = arch.areas_and_centroids()
    found = []
    for i in range(1, n // 2 + 1):
        for j in range(i):
            high, low = corner[i, upper], corner[j, lower]
            if high[1] > low[1]:
                above, between = 0.5 * area[i : n - i].sum(), slice(j, i)
                turning = above * (low[0] - high[0]) + area[between] @ (low[0] - centre[between, 0])
                found.append(float(turning / (high[1] - low[1])))
    return found
