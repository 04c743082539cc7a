"""resultants.csv: what each joint between two units carries: force, place of the normal force, eccentricity.

A joint is all contact of two units in one plane. Blocks of one unit (its divisions, cells) have no joint here.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geometry.blocks import Blocks, Joints
from geometry.polyhedra.indexing import ranges

if TYPE_CHECKING:
    from masonry.rows.history import Standing

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
    count = len(between.units)
    if not count:
        return {name: np.zeros(0) for name in ("moment", *COLUMNS)}
    faces = faces_of(joints, between)
    tables = [_columns(faces, between, standing.force) for standing in standings.values()]
    columns = {name: np.concatenate([table[name] for table in tables]) for name in COLUMNS if tables}
    return {"moment": np.repeat(list(standings), count)} | columns


class JointFaces(NamedTuple):
    """The faces of J joints: their contacts, sorted as in UnitJoints, as points (C, 3) m and signs (C,), each with its
    joint (C,); area (J,) m2, normal (J, 3) and middle (J, 3) m; corners from the middle (N, 3) m, each with its joint
    (N,), and where those of a joint begin (J,)."""

    point: np.ndarray
    sign: np.ndarray
    joint: np.ndarray
    area: np.ndarray
    normal: np.ndarray
    middle: np.ndarray
    corner: np.ndarray
    of_corner: np.ndarray
    first_corner: np.ndarray


def faces_of(joints: Joints, between: UnitJoints) -> JointFaces:
    """The faces of the joints between units."""
    contact, first, count = between.contact, between.start[:-1], len(between.units)
    joint = np.repeat(np.arange(count), np.diff(between.start))
    point, part, sign = joints.point[contact], joints.area[contact], between.sign[contact]
    area = np.add.reduceat(part, first)
    middle = np.add.reduceat(part[:, None] * point, first) / area[:, None]
    polygons = len(joints.patch_start) - 1
    each, patch = np.divmod(np.unique(joint * polygons + joints.patch[contact]), polygons)
    number, rows = ranges(joints.patch_start[patch], np.diff(joints.patch_start)[patch])
    of_corner = each[number]
    corner = joints.patch_points[rows] - middle[of_corner]
    normal = sign[first, None] * joints.normal[contact[first]]
    begins = np.searchsorted(of_corner, np.arange(count))
    return JointFaces(point, sign, joint, area, normal, middle, corner, of_corner, begins)


def _columns(faces: JointFaces, between: UnitJoints, forces: np.ndarray) -> dict[str, np.ndarray]:
    """The columns COLUMNS of a moment, from the forces (C, 3) N of the contacts."""
    first = between.start[:-1]
    force = faces.sign[:, None] * forces[between.contact]
    along = np.einsum("ci,ci->c", force, faces.normal[faces.joint])
    total, pressing = np.add.reduceat(force, first), np.add.reduceat(along, first)
    shear = np.linalg.norm(total - pressing[:, None] * faces.normal, axis=1)
    size = np.add.reduceat(np.abs(force).sum(axis=1), first)
    presses = np.abs(pressing) > LEAST * np.maximum(size, 1e-300)
    place = np.full((len(total), 3), np.nan)
    place[presses] = (np.add.reduceat(along[:, None] * faces.point, first)[presses]) / pressing[presses, None]
    vectors = {"normal": faces.normal, "force": total, "place": place}
    scalars = {
        "unit_a": between.units[:, 0],
        "unit_b": between.units[:, 1],
        "area": faces.area,
        "normal_force": pressing,
        "shear_force": shear,
        "eccentricity": _eccentricity(faces, place - faces.middle),
    }
    return scalars | {f"{name}_{axis}": v[:, k] for name, v in vectors.items() for k, axis in enumerate("xyz")}


def _eccentricity(faces: JointFaces, offset: np.ndarray) -> np.ndarray:
    """(J,) how far a place lies off the middle of its joint (J, 3) m, over how far the joint reaches there."""
    far = np.linalg.norm(offset, axis=1)
    size = np.maximum.reduceat(np.abs(faces.corner).max(axis=1), faces.first_corner)
    along = np.einsum("ci,ci->c", faces.corner, offset[faces.of_corner])
    reach = np.maximum.reduceat(along, faces.first_corner)
    centred = far <= LEAST * size
    return np.where(centred, 0.0, far * far / np.where(centred, 1.0, reach))


def resultants_csv(table: Mapping[str, np.ndarray]) -> str:
    """The table as text, with units in the first line; what is not known stays empty."""
    heads = ["moment", *(f"{name} [{unit}]" for name, unit in COLUMNS.items())]
    numbers = [table[name].tolist() if name in table else [] for name in COLUMNS]
    cells = [[f"{number:.9g}" if isfinite(number) else "" for number in column] for column in numbers]
    rows = zip(map(str, table.get("moment", ())), *cells, strict=True)
    return "".join(",".join(row) + "\n" for row in [heads, *rows])
