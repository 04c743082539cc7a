"""Do the parts of a result fit together? Rows, frames, blocks, joints and tets that come from a file."""

from dataclasses import fields
from typing import Any

import numpy as np

from geometry.blocks import Blocks, Joints, Specimen, TetMesh
from geometry.polyhedra.validate import require_sound_mesh, require_whole
from masonry.rows.history import Frame, History

MOST = 1e100
"""The largest number in rows and frames: beyond, pictures overflow."""
NEEDED = ("step", "time", "displacement", "stress", "support_stress")
"""Rows that pictures are drawn from."""
PER_CONTACT = ("opening", "slip", "normal_stress", "shear_stress", "damage_tension", "damage_shear", "crushing")


def require_whole_result(
    history: History,
    specimen: Specimen,
    joints: Joints,
    joint_group: np.ndarray,
    joint_groups: tuple[str, ...],
    joint_properties: dict[str, np.ndarray],
    mesh: TetMesh | None,
    **words: Any,
) -> None:
    """Raise ValueError, with the name of the array, unless all have the shapes and ranges that go together."""
    blocks = specimen.blocks
    require_whole(blocks)
    if mesh is not None:
        require_sound_mesh(blocks, mesh)
    if not (np.isfinite(specimen.section) and 0 < specimen.section < MOST):
        raise ValueError(f"the section is {specimen.section!r}, it must be an area above 0 m2")
    for name, members in specimen.sets.items():
        _require(f"set '{name}'", members, (len(members) if np.ndim(members) == 1 else None,), "i", blocks.count)
    _require_rows(history.rows)
    _require_joints(blocks, joints, 0 if mesh is None else len(mesh.nodes))
    for name, values in joint_properties.items():
        _require(f"joints/properties/{name}", np.nan_to_num(values), (len(joint_groups),), "f")
    contacts = len(joints.area)
    _require("joints/group", joint_group, (contacts,), "i", len(joint_groups))
    shapes: dict[str, tuple[int, ...]] = {name: (contacts,) for name in PER_CONTACT}
    shapes |= {
        "corners": blocks.points.shape,
        "stress": (blocks.count, 6),
        "nodes": (0 if mesh is None else len(mesh.nodes), 3),
    }
    for frame in history.frames:
        _require_frame(frame, shapes)


def _require_rows(rows: dict[str, np.ndarray]) -> None:
    length = {len(values) if np.ndim(values) == 1 else -1 for values in rows.values()}
    if len(length) > 1 or (rows and set(NEEDED) - set(rows)):
        raise ValueError("its rows are not of one length, or some are missing")
    for name, values in rows.items():
        _require(f"rows/{name}", values, (length.copy().pop(),), "fi")


def _require_joints(blocks: Blocks, joints: Joints, nodes: int) -> None:
    contacts, corners = len(np.atleast_1d(joints.area)), len(np.atleast_1d(joints.patch_points))
    start = joints.patch_start
    _require("joints/patch_start", start, (len(start) if np.ndim(start) == 1 else None,), "i", corners + 1)
    if len(start) == 0 or start[0] != 0 or start[-1] != corners or np.any(np.diff(start) < 0):
        raise ValueError(f"joints/patch_start must run from 0 to {corners}")
    _require("joints/patch_points", joints.patch_points, (corners, 3), "f")
    for name in ("block_a", "block_b"):
        _require(f"joints/{name}", getattr(joints, name), (contacts,), "i", blocks.count)
    _require("joints/patch", joints.patch, (contacts,), "i", len(start) - 1)
    for name in ("point", "normal"):
        _require(f"joints/{name}", getattr(joints, name), (contacts, 3), "f")
    _require("joints/area", joints.area, (contacts,), "f")
    for entry in fields(Joints):
        values = getattr(joints, entry.name)
        if values is not None and entry.name[:5] in ("node_", "corne", "share"):
            shape = (contacts,) if entry.name.startswith("node") else (contacts, 3)
            _require(f"joints/{entry.name}", values, shape, "f" if entry.name.startswith("share") else "i", nodes, -1)


def _require_frame(frame: Frame, shapes: dict[str, tuple[int, ...]]) -> None:
    for entry in fields(Frame):
        value = getattr(frame, entry.name)
        if value is None:  # crushing that is not modelled
            continue
        _require(f"frames/{entry.name}", np.asarray(value), shapes.get(entry.name, ()), "fi")


def _require(
    name: str, values: np.ndarray, shape: tuple[int | None, ...], kinds: str, end: int | None = None, minimum: int = 0
) -> None:
    """Of this shape and these kinds of numbers, finite; whole numbers from `minimum` to below `end`, where given."""
    if np.shape(values) != shape or values.dtype.kind not in kinds:
        raise ValueError(f"{name} has the shape {np.shape(values)} of {values.dtype}, it must be {shape} of numbers")
    if not np.all(np.abs(np.asarray(values, dtype=float)) <= MOST):
        raise ValueError(f"{name} holds numbers that are not finite, or too large")
    if end is not None and values.dtype.kind == "i" and np.any((values < minimum) | (values >= end)):
        raise ValueError(f"{name} holds numbers that are not from {minimum} to {end - 1}")
