"""Sizes are capped before anything is built: a slip of a unit must not fill the memory or run for a year."""

from math import prod
from typing import Any

import numpy as np

from geometry.polyhedra.measures import volumes
from masonry.assembly.specimens import blocks_from
from masonry.errors import SceneError
from masonry.scene import Scene
from masonry.scene.tables.point_counts import DENSITIES
from masonry.scene.tables.specimens.structures import Structure

BLOCKS, CONTACT_POINTS, TETS = 5e5, 5e6, 5e6
"""The most that a scene may ask for; about 10 GB of memory each."""
TETS_PER_CUBE = 8.0
"""Tets in a cube of the mesh size (6 to 7 were measured)."""
TETS_PER_FAN = 45
"""Tets in a block that is filled with a fan (12 in a box, 36 to 44 in a cell of space)."""


def require_sane_size(scene: Scene) -> None:
    """Refuse a scene whose estimated size is beyond what a machine can hold; says which key to change."""
    spec = scene.specimen
    blocks, volume = blocks_and_volume(spec)
    _require(blocks, BLOCKS, "blocks", _amount_key(spec))
    _require_few_points(scene, blocks, volume)
    meshed = any(map(scene.is_meshed, scene.kinematics))
    if meshed and spec.mesh == "fan":
        _require(TETS_PER_FAN * blocks, TETS, "tets", "specimen.mesh")
    elif meshed and spec.mesh_size is not None:
        edge = min(spec.mesh_size, volume ** (1 / 3))
        _require(TETS_PER_CUBE * volume / edge**3 if edge**3 > 0 else float("inf"), TETS, "tets", "specimen.mesh_size")


def blocks_and_volume(spec: Any) -> tuple[float, float]:
    """About how many blocks a specimen has, and the volume (m3) of its units."""
    if spec.kind == "file":
        blocks = blocks_from(spec)[0].blocks
        volume = float(volumes(blocks).sum())
        if spec.is_divided:
            depth = float(np.ptp(blocks.points[:, 1])) if blocks.count else 0.0
            return blocks.count + _blocks(spec, blocks.count, volume, depth), volume
        return blocks.count, volume
    if spec.kind == "boxes":
        return sum(prod(box.divisions) for box in spec.box), sum(prod(box.size) for box in spec.box)
    if isinstance(spec, Structure):
        units, volume, depth = spec.amount
        return _blocks(spec, units, volume, depth), volume
    if spec.kind in ("wallette", "bending"):
        units, depth = spec.courses * spec.units_per_course, spec.thickness
        volume = units * spec.unit_length * spec.thickness * spec.unit_height
        return _blocks(spec, units, volume, depth), volume
    units, depth = getattr(spec, "units", 2), spec.width
    volume = units * spec.length * spec.width * spec.height
    beds = 0.0
    if spec.mortar is not None:
        beds = _blocks(spec.mortar, units - 1, (units - 1) * spec.length * spec.width * spec.mortar.thickness, depth)
    return _blocks(spec, units, volume, depth) + beds, volume


def _blocks(table: Any, units: float, volume: float, depth: float) -> float:
    """About how many blocks a grid or cells in so many units make, of this volume (m3) in all and depth (m)."""
    cells = table.cells
    if cells is None:
        return float(units * prod(table.divisions))
    if cells.size is not None:
        one = cells.size**3 if cells.form == "space" else cells.size**2 * depth
        return volume / one if one > 0 else float("inf")
    return float(cells.total or units * cells.per_unit)


def _require_few_points(scene: Scene, blocks: float, volume: float) -> None:
    """Three faces of each block lie in a joint."""
    spec = scene.specimen
    key = next(key for key in DENSITIES if getattr(spec, key) is not None)
    if scene.points_per_edge is not None:
        x, y, z = scene.points_per_edge
        points = x * y + y * z + z * x
    elif spec.points_per_face is not None:
        points = 3 * spec.points_per_face
    else:
        assert spec.contact_spacing is not None
        points = 3 * max(1.0, 1.6 * (volume / blocks) ** (1 / 3) / spec.contact_spacing) ** 2
    _require(blocks * points, CONTACT_POINTS, "contact points", f"specimen.{key}")


def _amount_key(spec: Any) -> str:
    """The key to blame for too many blocks."""
    if getattr(spec, "cells", None) is not None:
        return "specimen.cells"
    return "specimen" if isinstance(spec, Structure) and not spec.is_divided else "specimen.divisions"


def _require(count: float, most: float, what: str, key: str) -> None:
    if not count <= most:
        raise SceneError(f"{key}: this would make about {count:.2g} {what}; at most {most:.0e} are allowed")
