"""From a scene's words to a specimen: blocks with named sets."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache
from inspect import signature
from pathlib import Path
from typing import Any

import numpy as np

from geometry.blocks import GeometryError, Specimen, TetMesh
from geometry.cells.request import CellRequest
from geometry.files.blocks_h5 import load_blocks
from geometry.files.blocks_text import blocks_of_text
from geometry.specimens.bending import bending
from geometry.specimens.boxes import boxes
from geometry.specimens.numbered import numbered_by_place
from geometry.specimens.placed import on_floor, turned, with_slabs
from geometry.specimens.stacked import couplet, prism
from geometry.specimens.wallette import wallette
from geometry.structures.arch import arch
from geometry.structures.bridge import BridgeArch, Pier, bridge
from geometry.structures.column import column
from geometry.structures.dome import dome
from geometry.structures.multi_leaf import multi_leaf
from geometry.structures.openings import Opening
from geometry.structures.tower import tower
from geometry.structures.vault import vault
from geometry.structures.wall import wall
from masonry.errors import SceneError
from masonry.jit.sources import source_hash
from masonry.scene import Scene
from masonry.scene.tables.cells import CellsTable
from masonry.scene.tables.specimens.structures import OpeningTable

STRUCTURES: dict[str, Callable[..., Specimen]] = {
    "arch": arch,
    "bridge": bridge,
    "vault": vault,
    "dome": dome,
    "column": column,
    "tower": tower,
    "wall": wall,
    "multi-leaf": multi_leaf,
}
"""Structures that people build: their parameters are keys of the scene's table."""

RING = ("radius", "angle", "level")
"""Of a ring, what its table makes of the keys that a scene gives."""


def specimen_of(scene: Scene) -> Specimen:
    """The blocks of a scene, with named sets; raises GeometryError for what cannot be built."""
    section = scene.specimen.section
    if scene.specimen.kind == "file" and blocks_from(scene.specimen)[0].joints is not None:
        _require_what_goes_with_gaps(scene, scene.specimen.is_divided)
    specimen = _specimen_of(scene)
    specimen = specimen if section is None else replace(specimen, section=section)
    specimen = with_slabs(specimen, [(slab.name, slab.origin, slab.size, slab.group) for slab in scene.specimen.slab])
    specimen = numbered_by_place(specimen) if scene.is_large and scene.specimen.kind in ("file", "boxes") else specimen
    if scene.specimen.turned is not None:
        stated = specimen.joints and replace(specimen.joints, points=as_turned(scene, specimen.joints.points))
        blocks = replace(specimen.blocks, points=as_turned(scene, specimen.blocks.points))
        specimen = replace(specimen, blocks=blocks, joints=stated)
    if (floor := scene.floor) is None:
        return specimen
    return on_floor(specimen, floor.level, floor.size, floor.thickness, _travel_of_ground(scene))


def _travel_of_ground(scene: Scene) -> float:
    """m, at most, by which something that does not follow the ground comes to lie beside where it stood on it."""
    if not scene.ground:
        return 0.0
    lasts = scene.solver.duration or max(ground.runs_for for ground in scene.ground)
    motions = [
        (motion, ground.begin) for ground in scene.ground for axis, motion in ground.motions.items() if axis != "z"
    ]
    ends = [abs(float(motion.displacement_at(np.array([lasts - begin]))[0])) for motion, begin in motions]
    return max([*ends, *(motion.peak_displacement for motion, _ in motions)], default=0.0)


def as_turned(scene: Scene, points: np.ndarray) -> np.ndarray:
    """Points (n, 3) m of the specimen as it was built, where it stands in the scene."""
    rotation = scene.specimen.turned
    if rotation is None:
        return points
    return turned(points, np.eye(3)["xyz".index(rotation.about)], rotation.angle, rotation.through)


def _specimen_of(scene: Scene) -> Specimen:
    """With the section that is the specimen's own."""
    spec = scene.specimen
    parts = (spec, getattr(spec, "mortar", None))
    forms = {cells.form for part in parts if (cells := getattr(part, "cells", None))}
    forms |= {spec.core.form} if spec.kind == "multi-leaf" else set()
    if not forms:
        return _built(spec)
    from masonry.jit.compiler import REST, once

    with once(f"{'-'.join(sorted(forms))}-{source_hash(('geometry/cells',))}", REST):
        return _built(spec)


def _built(spec: Any) -> Specimen:
    if spec.kind == "couplet" or spec.kind == "prism":
        mortar = (spec.mortar.thickness, _filling(spec.mortar)) if spec.mortar else None
        size = (spec.length, spec.width, spec.height)
        if spec.kind == "couplet":
            return couplet(*size, _filling(spec), mortar, spec.plates)
        return prism(spec.units, *size, _filling(spec), mortar, spec.plates)
    if spec.kind in STRUCTURES:
        return _structure(spec)
    if spec.kind == "file":
        return _of_file(spec)
    if spec.kind == "boxes":
        return boxes([(b.name, b.origin, b.size, b.group, b.unit, b.divisions) for b in spec.box], spec.section)
    wall: dict[str, Any] = {
        key: getattr(spec, key)
        for key in ("courses", "units_per_course", "unit_length", "unit_height", "thickness", "joint_thickness")
    }
    wall |= {"divisions": _filling(spec), "bond": spec.bond, "unit_width": spec.unit_width}
    if spec.kind == "wallette":
        return wallette(**wall, plates=spec.plates, base=spec.base, beam=spec.beam, shoes=spec.shoes)
    rollers = ("support_distance", "load_distance", "roller_width", "bottom_plate")
    return bending(**wall, **{key: getattr(spec, key) for key in rollers})


def _structure(spec: Any) -> Specimen:
    """Specimen from the function of a structure, by the keys that it asks for, its units divided."""
    build = STRUCTURES[spec.kind]
    ring = dict(zip(RING, spec.ring, strict=True)) if hasattr(spec, "ring") else {}
    values = {key: ring[key] if key in ring else getattr(spec, key) for key in signature(build).parameters}
    if "opening" in values:
        values["opening"] = [_opening(table) for table in spec.opening]
    if spec.kind == "bridge":
        values |= {"arch": [BridgeArch(**dict(table)) for table in spec.arch]}
        values |= {"pier": [Pier(**dict(table)) for table in spec.pier]}
    if "core" in values:
        values["core"] = _cells(spec.core)
    return _divided(build(**values), spec)


def _opening(table: OpeningTable) -> Opening:
    """Opening from a table; the rest is as `Opening` has it."""
    return Opening(**{key: value for key, value in table if value is not None})


def _require_what_goes_with_gaps(scene: Scene, is_divided: bool) -> None:
    """Raise SceneError for what needs blocks that meet, where the joints of a file bridge gaps."""
    why = "the blocks of this file only nearly meet, and its joints bridge the gaps"
    if scene.is_large:
        raise SceneError(
            f'displacements = "large": {why}; large displacement finds contacts where blocks touch: import it without '
            "--gap, by a --tolerance that closes the gaps, or leave displacements small"
        )
    if any(scene.is_meshed(g) for g in scene.material):
        raise SceneError(f"kinematics 'tets': {why}, where no mesh has nodes; take 'rigid' or 'affine'")
    if is_divided:
        raise SceneError(f"specimen.divisions and cells: {why}, which parts of blocks do not share; leave them out")
    if scene.floor is not None:
        raise SceneError(f"[floor]: {why}; hold the lowest blocks by a [[support]] instead")


def _of_file(spec: Any) -> Specimen:
    return _divided(blocks_from(spec)[0], spec)


def _divided(specimen: Specimen, spec: Any) -> Specimen:
    """The units of a specimen divided as its table asks."""
    if not spec.is_divided:
        return specimen
    from geometry.specimens.divided import divided

    return divided(specimen, _filling(spec))


def _filling(table: Any) -> Sequence[int] | CellRequest:
    """Blocks along each axis, or the cells that a table asks for."""
    divisions: Sequence[int] = table.divisions
    return divisions if table.cells is None else _cells(table.cells)


def _cells(cells: CellsTable) -> CellRequest:
    """The cells that a table asks for."""
    plain = ("total", "per_unit", "size", "spread", "sizes", "sites", "seed", "regularise")
    sizes = {key: getattr(cells, key) for key in plain}
    return CellRequest(**sizes, space=cells.form == "space", laguerre=cells.kind == "laguerre")


def blocks_from(spec: Any) -> tuple[Specimen, TetMesh | None]:
    """Blocks and sets of the file that a specimen names or holds, and the tets if there are any. Raises SceneError or
    GeometryError."""
    if spec.content is not None:
        return _unpacked(spec.content)
    path = spec.path
    try:
        state = Path(path).stat()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise SceneError(
            f"specimen.path = '{path}' cannot be read: {reason}; `masonry import` and "
            "`masonry.write_blocks` write such files"
        ) from None
    return _read(path, state.st_mtime_ns, state.st_size)


@lru_cache(maxsize=2)
def _unpacked(content: str) -> tuple[Specimen, TetMesh | None]:
    try:
        return blocks_of_text(content)
    except GeometryError as error:
        raise SceneError(f"specimen.content: {error}") from None


@lru_cache(maxsize=2)
def _read(path: str, changed: int, size: int) -> tuple[Specimen, TetMesh | None]:
    return load_blocks(Path(path))
