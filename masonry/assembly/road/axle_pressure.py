"""Axles on a road: each presses on a width that grows with the depth of what lies between it and the blocks below.

An axle at x spreads from its patch by the angle of the vehicle down to the depth of the blocks below x. On that width
it presses straight down, evenly over the plan: so its force and its line of action are those of the axle. What of the
width lies beside the blocks presses on the ground there. Across, it is spread over the whole depth of the blocks.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from geometry.blocks import Joints, Specimen
from geometry.polyhedra.measures import face_areas_normals_centroids
from geometry.polyhedra.polygons import areas_normals_centroids, cut, pad
from masonry.assembly.road.fill import open_faces
from masonry.errors import SceneError
from masonry.model.layout import KINDS, Layout
from masonry.model.loads import Load, add_force
from masonry.scene.tables.road.vehicle import Vehicle, Way

COVERS = 0.02
"""By how much of their plan the faces below a road may overlap, or leave gaps."""
NARROW = 1e-6
"""Least half width that an axle presses on, over the length of the road."""


class Pressure(NamedTuple):
    """Vertical forces on faces: owner (n,), the block; force (n,) N, downwards; centre (n, 3) m, where it acts."""

    owner: np.ndarray
    force: np.ndarray
    centre: np.ndarray


@dataclass(frozen=True)
class RoadBed:
    """The faces that a road lies on.

    owner           (F,) their blocks
    corners, count  (F, K, 3) m and (F,), as polygons of geometry/polyhedra/polygons.py
    normal, centre  (F, 3)
    low, high       m, where they begin and end along x
    level           m, z of the road
    """

    owner: np.ndarray
    corners: np.ndarray
    count: np.ndarray
    normal: np.ndarray
    centre: np.ndarray
    low: float
    high: float
    level: float

    def depth_at(self, x: float) -> float:
        """m, from the road to the highest of the faces at x; beside them all, that at their end."""
        x, eps = float(np.clip(x, self.low, self.high)), NARROW * (self.high - self.low)
        first, last = self.corners[:, :, 0].min(axis=1), self.corners[:, :, 0].max(axis=1)
        slope = -self.normal[:, 0] / self.normal[:, 2]
        height = self.centre[:, 2] + slope * (np.clip(x, first, last) - self.centre[:, 0])
        return self.level - float(height[(first - eps <= x) & (x <= last + eps)].max())

    def width_at(self, x: float, vehicle: Vehicle) -> tuple[float, float]:
        """m, from where to where an axle at x presses on the faces; one that is a line at their end does so there."""
        half = 0.5 * vehicle.patch + self.depth_at(x) * float(np.tan(vehicle.spread))
        least = NARROW * (self.high - self.low)
        if half >= least:
            return x - half, x + half
        if self.low - least <= x <= self.high + least:
            x = float(np.clip(x, self.low + least, self.high - least))
        return x - least, x + least

    def share_on(self, low: float, high: float) -> float:
        """Of the width from one x to another (m), that on the faces."""
        return max(min(high, self.high) - max(low, self.low), 0.0) / (high - low)

    def shares(self, vehicle: Vehicle, position: float, direction: Way) -> list[float]:
        """Of the load of each axle, that on the faces; 0 where it presses on the ground beside them alone."""
        places = vehicle.places(position, direction).tolist()
        return [self.share_on(*self.width_at(x, vehicle)) for x in places]

    def pressure(self, vehicle: Vehicle, position: float, direction: Way) -> Pressure:
        """Of all axles, where the vehicle stands at a position (m) and leads in a direction."""
        parts = [
            self._of_axle(load, *self.width_at(x, vehicle))
            for load, x in zip(vehicle.axles, vehicle.places(position, direction), strict=True)
        ]
        return Pressure(*(np.concatenate(arrays) for arrays in zip(*parts, strict=True)))

    def _of_axle(self, load: float, low: float, high: float) -> Pressure:
        x = self.corners[:, :, 0]
        near = np.flatnonzero((x.max(axis=1) > low) & (x.min(axis=1) < high))
        corners, count = cut(self.corners[near], self.count[near], x[near] - low)
        corners, count = cut(corners, count, high - corners[:, :, 0])
        area, normal, centre = areas_normals_centroids(corners)
        plan = np.where(count > 2, area * normal[:, 2], 0.0)
        below = np.flatnonzero(plan > 0.0)
        force = load * self.share_on(low, high) * plan[below] / max(plan.sum(), 1e-300)
        return Pressure(self.owner[near[below]], force, centre[below])

    def reach(self, vehicle: Vehicle) -> tuple[float, float]:
        """m, the least and the greatest position at which some axle presses on the faces."""
        left, right = (self.width_at(x, vehicle) for x in (self.low, self.high))
        before, behind = left[1] - self.low, self.high - right[0]
        return self.low - before - 0.5 * vehicle.length, self.high + behind + 0.5 * vehicle.length


def road_bed(vehicle: Vehicle, specimen: Specimen, joints: Joints, chosen: np.ndarray) -> RoadBed:
    """Of a vehicle, on some blocks (n,). Raises SceneError where these bear no road."""
    blocks = specimen.blocks
    where = f"vehicle.on = '{vehicle.on}'"
    faces = open_faces(blocks, joints, chosen, where)
    if not len(faces):
        raise SceneError(f"{where}: no free face of these blocks looks up; name those that the road lies on")
    corners, count = (array[faces] for array in pad(blocks.points, blocks.face_start, blocks.face_points))
    area, normal, centre = (array[faces] for array in face_areas_normals_centroids(blocks))
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    plan = float(area @ normal[:, 2]) / float(np.prod((high - low)[:2]))
    if abs(plan - 1.0) > COVERS:
        raise SceneError(
            f"{where}: the free faces that look up cover {100 * plan:.3g} % of the rectangle around them; a road "
            "along x lies on faces that cover it once, side by side: name blocks that do"
        )
    if vehicle.level < high[2] - NARROW * (high[0] - low[0]):
        raise SceneError(
            f"vehicle.level = {vehicle.level:.6g} m: '{vehicle.on}' reaches up to {high[2]:.6g} m; give that or more"
        )
    owner = blocks.face_block()[faces]
    return RoadBed(owner, corners, count, normal, centre, float(low[0]), float(high[0]), vehicle.level)


def load_of(pressure: Pressure, layout: Layout) -> Load:
    """Its forces on rigid and affine blocks, by kind."""
    load: Load = dict.fromkeys(KINDS)
    for block, force, centre in zip(pressure.owner.tolist(), pressure.force, pressure.centre, strict=True):
        add_force(layout, load, block, np.array([0.0, 0.0, -force]), centre - layout.centroid[block])
    return load
