"""Blocks that a dictionary of a scene holds as objects: they go into the scene as text, so that it stands alone."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from geometry.blocks import Blocks, Specimen
from geometry.files.blocks_text import text_of_blocks
from geometry.polyhedra.validate import require_sound
from masonry.errors import SceneError, nearest
from masonry.importing.block_writing import specimen_of_bodies
from masonry.importing.named_sets import section_of, sets_of
from masonry.scene import Scene, load
from masonry.scene.tables.specimens.blocks_file import FileSpec

BODIES = "blocks"
OF_BODIES = ("names", "groups", "units", "tolerance", "open_gaps")
"""Keys beside `blocks`: the words of `masonry.write_blocks`."""


def scene_of(scene: "Scene | str | Path | Mapping[str, Any]") -> Scene:
    """A scene as it is, else the one of that file, packaged name or dictionary. Raises SceneError or GeometryError."""
    return scene if isinstance(scene, Scene) else load(with_packed_blocks(scene))


def with_packed_blocks(tables: Any) -> Any:
    """Tables or settings of a scene with a `specimen` of blocks as text, where it was handed over as objects: a
    Specimen or Blocks, bodies of vertices and faces, or a table with such `blocks`. Whatever else is handed back as it
    is. Raises SceneError or GeometryError."""
    if not isinstance(tables, Mapping) or "specimen" not in tables:
        return tables
    specimen = tables["specimen"]
    is_list = isinstance(specimen, Sequence) and not isinstance(specimen, str)
    if (
        is_list
        or isinstance(specimen, Specimen | Blocks)
        or hasattr(specimen, "elements")
        or hasattr(specimen, "blocks")
    ):
        specimen = {BODIES: specimen}
    if not isinstance(specimen, Mapping) or BODIES not in specimen:
        return tables
    return {**tables, "specimen": _packed(specimen)}


def _packed(table: Mapping[str, Any]) -> dict[str, Any]:
    known = {BODIES, *OF_BODIES, *FileSpec.model_fields} - {"path", "content"}
    for key in table:
        if key not in known:
            raise SceneError(f"specimen.{key}: unknown key; {nearest(str(key), known)}")
    if table.get("kind", "file") != "file":
        raise SceneError(f"specimen.kind = {table['kind']!r:.60}: blocks that are handed over are of kind 'file'")
    bodies, words = table[BODIES], {key: table[key] for key in OF_BODIES if key in table}
    if isinstance(bodies, Specimen | Blocks) and words:
        raise SceneError(
            f"specimen.{next(iter(words))}: is for bodies of vertices and faces, not for a Specimen or Blocks"
        )
    rest = {key: value for key, value in table.items() if key not in (BODIES, *words)}
    return {**rest, "kind": "file", "content": text_of_blocks(_specimen(bodies, words))}


def _specimen(bodies: Any, words: Mapping[str, Any]) -> Specimen:
    if isinstance(bodies, Specimen):
        require_sound(bodies.blocks)
        return bodies
    if isinstance(bodies, Blocks):
        require_sound(bodies)
        return Specimen(bodies, sets_of(bodies, [""] * bodies.count), section_of(bodies, None), "file")
    for members in ("elements", "blocks"):  # of a BlockModel and of an Assembly of COMPAS
        if callable(getattr(bodies, members, None)):
            bodies = list(getattr(bodies, members)())
    if not isinstance(bodies, Sequence | np.ndarray) or isinstance(bodies, str):
        raise SceneError(
            f"specimen.blocks = {bodies!r:.60}: give a list of bodies, each a pair of vertices and faces or a mesh, or "
            "a Specimen or Blocks of `geometry`"
        )
    return specimen_of_bodies(list(bodies), **words)
