"""Blocks from Python: arrays of vertices and faces become a file of blocks that a scene of kind "file" names."""

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from geometry.blocks import Blocks, GeometryError, Specimen
from geometry.files.blocks_h5 import save_blocks
from geometry.joints.gaps import Unmended
from geometry.joints.heal import Mended, mend
from geometry.polyhedra.overlaps import Overlapping
from geometry.polyhedra.validate import require_sound
from geometry.specimens.from_arrays import polyhedra
from masonry.errors import SceneError
from masonry.importing.hints import ways_out, with_ways_out
from masonry.importing.importing import FLAT, SUFFIX, ImportSettings
from masonry.importing.named_sets import SECTIONS, section_of, sets_of
from masonry.quantity import parse

LARGEST = 10**9
"""Number of a unit, as in a scene of boxes."""


def write_blocks(
    path: str | Path,
    blocks: Sequence[Any],
    names: Sequence[str] | None,
    groups: str | Sequence[str],
    units: Sequence[int] | None,
    section: str | None,
    tolerance: str,
    open_gaps: bool,
) -> Path:
    """See `masonry.write_blocks`."""
    path = Path(path)
    if not path.name.endswith(SUFFIX):
        raise SceneError(f"'{path}': the name of a file of blocks ends in {SUFFIX}")
    area = None if section is None else parse(section, "area", "section", f"[{SECTIONS[0]}, {SECTIONS[1]}]")
    specimen = specimen_of_bodies(blocks, names, groups, units, tolerance, open_gaps)
    save_blocks(path, specimen if area is None else replace(specimen, section=area))
    return path


def specimen_of_bodies(
    blocks: Sequence[Any],
    names: Sequence[str] | None = None,
    groups: str | Sequence[str] = "units",
    units: Sequence[int] | None = None,
    tolerance: str = "0.1 mm",
    open_gaps: bool = False,
) -> Specimen:
    """Bodies of vertices and faces as a specimen, mended, with its sets; the words are those of
    `masonry.write_blocks`. Raises SceneError or GeometryError."""
    solids = [_arrays(block, b) for b, block in enumerate(blocks)]
    named = _for_each(names, len(solids), "names", str, "") if names is not None else [""] * len(solids)
    called = [f"{name} (block {b})" if name else f"block {b}" for b, name in enumerate(named)]
    in_group = [groups] * len(solids) if isinstance(groups, str) else groups
    of_group = _for_each(in_group, len(solids), "groups", str, "units")
    of_unit = _for_each(range(len(solids)) if units is None else units, len(solids), "units", int, 0)
    for unit in of_unit:
        if not 0 <= unit <= LARGEST:
            raise SceneError(f"units: {unit} is no number of a unit; allowed: 0 to {LARGEST}")
    width = parse(tolerance, "length", "tolerance", "[1e-9, 1]")
    build = partial(polyhedra, solids, called, of_unit, of_group)
    mended = _mended(build, ImportSettings(tolerance=width, open_gaps=open_gaps), called)
    sound = mended.blocks
    require_sound(sound)
    _require_own_names(sound, named)
    overlap = mended.deepest
    return Specimen(sound, sets_of(sound, named), section_of(sound, None), "file", overlap=overlap)


def _require_own_names(blocks: Blocks, names: Sequence[str]) -> None:
    """Raise SceneError where a name stands for other blocks than the set of this name that every file has."""
    for name, members in sets_of(blocks, [""] * blocks.count).items():
        called = [b for b, other in enumerate(names) if other == name]
        if called and called != members.tolist():
            raise SceneError(
                f"names: '{name}' is the set of {len(members)} blocks, {members[:4].tolist()} at first, and cannot be "
                f"block {called[0]} besides; give another name"
            )


def _arrays(block: Any, b: int) -> tuple[Any, Any]:
    """Vertices and faces of a pair, a mesh of trimesh, or a mesh or an element of a model of COMPAS."""
    if hasattr(block, "modelgeometry"):
        block = block.modelgeometry
    if hasattr(block, "to_vertices_and_faces"):
        block = block.to_vertices_and_faces()
    elif hasattr(block, "vertices") and hasattr(block, "faces"):
        block = block.vertices, block.faces
    try:
        vertices, faces = block
    except (TypeError, ValueError):
        raise GeometryError(
            f"block {b} must be a pair of vertices and faces, or a mesh with `vertices` and `faces`, not "
            f"{type(block).__name__}"
        ) from None
    return vertices, faces


def _for_each(values: Any, count: int, what: str, kind: type, example: Any) -> list[Any]:
    """One value a block, of one kind."""
    if isinstance(values, str) or len(values) != count:
        got = "one text" if isinstance(values, str) else f"{len(values)}"
        raise SceneError(f"{what}: one for each of the {count} blocks, not {got}")
    items = [value.item() if isinstance(value, np.generic) else value for value in values]
    for b, value in enumerate(items):
        if not isinstance(value, kind) or isinstance(value, bool) or value == "" != example:
            raise SceneError(f"{what}: block {b} has {value!r:.60}, for example {example!r}")
    return items


def _mended(build: Callable[[float], Blocks], wishes: ImportSettings, names: Sequence[str]) -> Mended:
    """The blocks that `build` makes where faces count as flat within a length (m), mended as by an import."""

    def attempt(wishes: ImportSettings) -> Mended:
        refused: GeometryError | None = None
        for fraction in FLAT:
            try:
                return mend(build(fraction * wishes.tolerance), wishes.tolerance, names, wishes.open_gaps)
            except GeometryError as error:
                refused = refused or error
        assert refused is not None
        raise refused

    try:
        return attempt(wishes)
    except (Unmended, Overlapping) as error:
        said = str(with_ways_out(error, ways_out(attempt, wishes, error, bridging=False)))
    said = re.sub(r"--tolerance (\S+)mm", r'tolerance = "\1 mm"', said).replace("--open-gaps", "open_gaps = True")
    raise GeometryError(said.replace(" (--tolerance)", ""))
