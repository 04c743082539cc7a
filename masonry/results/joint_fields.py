"""joints.vtkhdf: the surfaces of the joints and what happens on them at every frame, for ParaView.

A cell is the part of a joint that one contact point stands for. It has opening, slip, stresses and damage by mode as
numbers, and opening and slip as vectors too, for glyphs. Points move midway between the two faces.
"""

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geometry.blocks import Joints
from geometry.jit_cache import compiled
from geometry.joints.tributary_areas import tiles
from masonry.results.deformation import BlockCorners, Deformation
from masonry.results.dry_joints import LEAST_DAMAGE
from masonry.results.vtkhdf import VTK_POLYGON, Data, VtkCells, write
from masonry.rows.history import Frame

if TYPE_CHECKING:
    from masonry.results.data import ResultData

NUMBERS = ("opening", "slip", "normal_stress", "shear_stress", "damage", "damage_tension", "damage_shear")

IN_CACHE = 5_000
"""Contacts whose tiles are moved at a time: to make large arrays costs more than to fill them."""


class JointGrid:
    """The contact points of a result as tiles of their joints, and their data in a frame."""

    def __init__(self, result: "ResultData") -> None:
        self.joints = joints = result.joints
        self.shape = BlockCorners(result.specimen.blocks)
        self._last: tuple[Frame, _Motion] | None = None
        start, points = tiles(joints)
        self.owner = np.repeat(np.arange(len(joints.area)), np.diff(start))
        self.cells = VtkCells(
            points=points,
            connectivity=np.arange(len(points)),
            offsets=start,
            types=np.full(len(joints.area), VTK_POLYGON),
            still={
                "block_a": joints.block_a.astype(np.int32),
                "block_b": joints.block_b.astype(np.int32),
                "group": result.joint_group.astype(np.int32),
                "normal": joints.normal.astype(np.float32),
                "area": joints.area,
            },
        )

    def _motion(self, frame: Frame) -> "_Motion":
        """How the contacts moved in a frame; points and cells ask for it one after the other."""
        if self._last is None or self._last[0] is not frame:
            self._last = frame, _Motion.of(self.joints, Deformation(self.shape, frame))
        return self._last[1]

    def point_data(self, frame: Frame) -> Data:
        """`displacement` (points, 3) m: the mean of the two sides."""
        motion, corner, start = self._motion(frame), self.cells.points, self.cells.offsets
        moved = np.empty_like(corner)
        for begin in range(0, self.cells.count, IN_CACHE):
            contacts = slice(begin, min(begin + IN_CACHE, self.cells.count))
            middle, gradient = motion.of_middle(self.joints, contacts)
            points = slice(start[contacts.start], start[contacts.stop])
            owner, centre = self.owner[points] - begin, self.joints.point[contacts]
            moved[points] = displaced(owner, corner[points], centre, middle, gradient)
        return {"displacement": moved}

    def cell_data(self, frame: Frame) -> Data:
        """The fields of the contacts: numbers (cells,), vectors (cells, 3) m, and `mode` as `mode_of` has it."""
        joints = self.joints
        first, second, _ = self._motion(frame)
        along = np.einsum("ni,ni->n", second - first, joints.normal)
        data: Data = {name: getattr(frame, name) for name in NUMBERS}
        if frame.crushing is not None:
            data["crushing"] = frame.crushing
        return data | {
            "mode": mode_of(frame),
            "opening_vector": frame.opening[:, None] * joints.normal,
            "slip_vector": second - first - along[:, None] * joints.normal,
        }


class _Motion(NamedTuple):
    """Displacements (C, 3) m of the contact points as matter of block a and of block b, and the field they are from."""

    first: np.ndarray
    second: np.ndarray
    field: Deformation

    @classmethod
    def of(cls, joints: Joints, field: Deformation) -> "_Motion":
        return cls(*field.sides(joints, np.arange(len(joints.area)), joints.point), field)

    def of_middle(self, joints: Joints, contacts: slice) -> tuple[np.ndarray, np.ndarray]:
        """Displacement (n, 3) m and its gradient (n, 3, 3), midway between the sides of some contacts: a side that
        moves as nodes of tets do has a gradient of 0."""
        gradient = np.zeros((contacts.stop - contacts.start, 3, 3))
        for block, node, corner in (
            (joints.block_a, joints.node_a, joints.corner_a),
            (joints.block_b, joints.node_b, joints.corner_b),
        ):
            nodal = node[contacts] >= 0
            if corner is not None:
                nodal |= corner[contacts, 0] >= 0
            gradient += np.where(nodal, 0.0, 0.5)[:, None, None] * self.field.gradient[block[contacts]]
        return 0.5 * (self.first[contacts] + self.second[contacts]), gradient


def mode_of(frame: Frame) -> np.ndarray:
    """(C,) 0 intact, 1 damaged with tension in the lead, 2 with shear in the lead."""
    led = np.where(frame.damage_tension >= frame.damage_shear, 1.0, 2.0)
    return np.where(frame.damage > LEAST_DAMAGE, led, 0.0)


def write_joints(path: Path, result: "ResultData") -> None:
    """Write the VTKHDF file; without frames it holds the joints only."""
    grid = JointGrid(result)
    write(path, grid.cells, result.history.frames, grid.point_data, grid.cell_data)


@compiled
def displaced(owner, point, centre, shift, gradient):
    """(n, 3) m, shift + gradient (point - centre) of points (n, 3): of each the centre (m, 3), shift (m, 3) and
    gradient (m, 3, 3) of its owner (n,). Nothing is made on the way: for many points that costs more than the sums."""
    moved = np.empty((len(point), 3))
    for n in range(len(point)):
        m = owner[n]
        x, y, z = point[n, 0] - centre[m, 0], point[n, 1] - centre[m, 1], point[n, 2] - centre[m, 2]
        for i in range(3):
            moved[n, i] = shift[m, i] + ((gradient[m, i, 0] * x + gradient[m, i, 2] * z) + gradient[m, i, 1] * y)
    return moved
