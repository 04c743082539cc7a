"""resultants.csv: what each joint between two units carries: force, place of the normal force, eccentricity.

A joint is all contact of two units in one plane. Blocks of one unit (its divisions, cells) have no joint here.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from geometry.blocks import Blocks, Joints
from geometry.polyhedra.indexing import ranges

if TYPE_CHECKING:
    from masonry.monitors.reactions import Standing

SAME_DIRECTION, SAME_PLANE = 1e-4, 1e-5
"""Normals, and places of a plane over the size of the specimen, that differ by less belong to one joint."""
LEAST = 1e-9
"""Share of the largest force of a joint at which a normal force has no place."""
COLUMNS = {
    **{"unit_a": "1", "unit_b": "1", "area": "m2", "normal_x": "1", "normal_y": "1", "normal_z": "1"},
    **{"force_x": "N", "force_y": "N", "force_z": "N", "normal_force": "N", "shear_force": "N"},
    **{"place_x": "m", "place_y": "m", "place_z": "m", "eccentricity": "1"},
}
"""Columns of the table and their units; the moment, "peak" or "end", stands before them."""


@dataclass(frozen=True)
class UnitJoints:
    """The J joints between units: their units (J, 2), the lower number first; contacts sorted by joint, and where each
    joint begins (J + 1,); sign (C,) is -1 where side a of a contact is the unit of the higher number."""

    units: np.ndarray
    contact: np.ndarray
    start: np.ndarray
    sign: np.ndarray


def unit_joints(blocks: Blocks, joints: Joints) -> UnitJoints:
    """Sort the contacts by the joint that they belong to."""
    a, b = blocks.unit[joints.block_a], blocks.unit[joints.block_b]
    contact = np.flatnonzero(a != b)
    sign = np.where(a > b, -1.0, 1.0)
    normal = (sign[:, None] * joints.normal)[contact]
    size = float(np.ptp(blocks.points, axis=0).max()) * SAME_PLANE
    plane = np.einsum("ci,ci->c", normal, joints.point[contact]) / size
    pair = np.column_stack([np.minimum(a, b), np.maximum(a, b)])[contact]
    keys = np.column_stack([pair, np.rint(normal / SAME_DIRECTION), np.rint(plane)])
    kinds, which = np.unique(keys, axis=0, return_inverse=True)
    order = np.argsort(which.ravel(), kind="stable")
    start = np.searchsorted(which.ravel()[order], np.arange(len(kinds) + 1))
    return UnitJoints(kinds[:, :2].astype(int), contact[order], start, sign)


def resultants(blocks: Blocks, joints: Joints, standings: Mapping[str, "Standing"]) -> dict[str, np.ndarray]:
    """A table, column by column: `moment` and COLUMNS, a row for each joint at each moment.

    The force (N) is what the unit of the higher number does to the other; the normal points from the lower to the
    higher, so a normal force below 0 presses. Its place is the centre of the normal force, and the eccentricity is how
    far that lies from the middle of the joint, over how far the joint reaches in that direction: 1 at the edge. Both
    are nan where no normal force acts.
    """
    between = unit_joints(blocks, joints)
    rows: dict[str, list[object]] = {"moment": [], **{name: [] for name in COLUMNS}}
    for moment, standing in standings.items():
        for j, units in enumerate(between.units):
            contacts = between.contact[between.start[j] : between.start[j + 1]]
            row = _row(joints, contacts, between.sign[contacts], standing.force)
            for name, value in zip(rows, [moment, *units, *row], strict=True):
                rows[name].append(value)
    return {name: np.array(values) for name, values in rows.items()}


def _row(joints: Joints, contacts: np.ndarray, sign: np.ndarray, forces: np.ndarray) -> list[float]:
    """Area, normal, force, its parts, its place and eccentricity."""
    area, point = joints.area[contacts], joints.point[contacts]
    normal = sign[0] * joints.normal[contacts[0]]
    force = sign[:, None] * forces[contacts]
    along = force @ normal
    total, pressing = force.sum(axis=0), float(along.sum())
    shear = float(np.linalg.norm(total - pressing * normal))
    place, eccentricity = np.full(3, np.nan), np.nan
    if abs(pressing) > LEAST * max(np.abs(force).sum(), 1e-300):
        place = (along @ point) / pressing
        eccentricity = _eccentricity(joints, contacts, place - (area @ point) / area.sum())
    return [float(area.sum()), *normal, *total, pressing, shear, *place, eccentricity]


def _eccentricity(joints: Joints, contacts: np.ndarray, off: np.ndarray) -> float:
    """How far a place lies off the middle of a joint (3,) m, over how far the joint reaches there."""
    patches = np.unique(joints.patch[contacts])
    sides = np.diff(joints.patch_start)[patches]
    corners = joints.patch_points[ranges(joints.patch_start[patches], sides)[1]]
    middle = joints.area[contacts] @ joints.point[contacts] / joints.area[contacts].sum()
    far = float(np.linalg.norm(off))
    if far <= LEAST * float(np.abs(corners - middle).max()):
        return 0.0
    return far * far / float(((corners - middle) @ off).max())


def resultants_csv(table: Mapping[str, np.ndarray]) -> str:
    """The table as text, with units in the first line; what is not known stays empty."""
    heads = ["moment", *(f"{name} [{unit}]" for name, unit in COLUMNS.items())]
    lines = [",".join(heads)]
    for k in range(len(table.get("moment", ()))):
        cells = [f"{table[name][k]:.9g}" if np.isfinite(table[name][k]) else "" for name in COLUMNS]
        lines.append(",".join([str(table["moment"][k]), *cells]))
    return "\n".join(lines) + "\n"
