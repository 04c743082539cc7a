"""The thrust line of what bears its own weight: where the normal force of each joint between two units acts.

Units in one row (an arch, a stack) have a line from joint to joint; in a wall each joint has a mark of its own.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from masonry.pictures.camera import Camera
from masonry.pictures.crack_lines import EDGE_ON
from masonry.pictures.large.nearness import reach
from masonry.results.deformation import BlockCorners, Deformation
from masonry.results.joint_resultants import UnitJoints, unit_joints
from masonry.rows.history import Frame

if TYPE_CHECKING:
    from masonry.results.data import ResultData

COLOUR, WIDTH, MARK = "#7a2a8c", 1.5, 4.5
"""Colour, width of the line and size of a mark in points."""
LEAST = 0.02
"""Share of the largest normal force of a joint below which a joint of a wall has no mark."""
ROW, WALL = 3, 120
"""The fewest joints of a row that have a line, and the most of a wall that have marks: more would hide the picture."""


@dataclass(frozen=True)
class ThrustLine:
    """The joints between units in the order of drawing, whether a line joins them, and how far apart (m) the two
    sides of each contact (C,) may be."""

    joints: UnitJoints
    order: np.ndarray
    in_a_row: bool
    reach: np.ndarray

    def forces(self, result: "ResultData", frame: Frame) -> tuple[np.ndarray, np.ndarray]:
        """Normal force (J,) N, below 0 where it presses, and its place (J, 3) m before loading, of each joint in
        order; the place is not a number where the joint does not press."""
        contact = self.joints.contact
        normal = (frame.normal_stress * result.joints.area)[contact]
        along = np.add.reduceat(normal, self.joints.start[:-1])
        moment = np.add.reduceat(normal[:, None] * result.joints.point[contact], self.joints.start[:-1], axis=0)
        place = np.full((len(along), 3), np.nan)
        threshold = 0.0 if self.in_a_row else LEAST * np.abs(along).max(initial=0.0)
        presses = along < -threshold
        place[presses] = moment[presses] / along[presses, None]
        return along[self.order], place[self.order]

    def displaced(self, result: "ResultData", frame: Frame, times: float) -> np.ndarray:
        """(J, 3) m: the places midway between the two sides of their joints, displacements `times` larger; not a
        number where the joint does not press or has parted."""
        _, place = self.forces(result, frame)
        field = Deformation(BlockCorners(result.specimen.blocks), frame)
        shown = np.flatnonzero(np.isfinite(place[:, 0]))
        nearest = np.array([self._nearest(result, int(k), place[k]) for k in shown], dtype=np.int64)
        first, second = field.sides(result.joints, nearest, place[shown])
        place[shown] += 0.5 * times * (first + second)
        place[shown[np.linalg.norm(first - second, axis=1) > self.reach[nearest]]] = np.nan
        return place

    def _nearest(self, result: "ResultData", k: int, place: np.ndarray) -> int:
        """The contact of joint k that is nearest to a place (3,) m."""
        joint = self.order[k]
        contact = self.joints.contact[self.joints.start[joint] : self.joints.start[joint + 1]]
        return int(contact[np.argmin(np.linalg.norm(result.joints.point[contact] - place, axis=1))])

    def draw(self, axes: Any, flat: np.ndarray) -> None:
        """Draw the line through places (J, 2), broken where one is not a number, or the marks."""
        axes.plot(*flat.T, "o-" if self.in_a_row else "o", color=COLOUR, lw=WIDTH, ms=MARK, zorder=4.0)

    def key(self) -> Any:
        """Its entry of the legend."""
        from matplotlib.lines import Line2D

        word = "thrust line" if self.in_a_row else "normal force of a joint acts here"
        return Line2D([], [], color=COLOUR, lw=WIDTH * self.in_a_row, marker="o", ms=MARK, label=word)


def thrust_line(result: "ResultData", camera: Camera) -> ThrustLine | None:
    """Thrust line of joints that are seen edge-on; None without gravity, and for fewer or more joints than help."""
    if not result.scene_table.get("gravity"):
        return None
    joints = unit_joints(result.specimen.blocks, result.joints)
    if (row := row_of(joints.units)) is not None:
        return ThrustLine(joints, row, True, reach(result)) if len(row) >= ROW else None
    first = joints.contact[joints.start[:-1]]
    shown = np.flatnonzero(np.abs(result.joints.normal[first] @ camera.toward) < EDGE_ON)
    return ThrustLine(joints, shown, False, reach(result)) if 0 < len(shown) <= WALL else None


def row_of(units: np.ndarray) -> np.ndarray | None:
    """(J,) the joints between units (J, 2) from one end of a row to the other; None where the units are no row."""
    names, members = np.unique(units, return_counts=True)
    if len(names) != len(units) + 1:
        return None
    order, here = [], int(names[members == 1][0])
    remaining = dict(enumerate(units.tolist()))
    while (joint := next((j for j, pair in remaining.items() if here in pair), None)) is not None:
        a, b = remaining.pop(joint)
        order.append(joint)
        here = b if here == a else a
    return np.array(order) if not remaining else None
