"""Specimens to files that other programs read: STEP solids, surfaces, tets in Gmsh's .msh and VTK's .vtu."""

import contextlib
import io
from pathlib import Path

import numpy as np

from geometry.blocks import Blocks, GeometryError, Specimen, TetMesh
from geometry.files.atomic import whole_file
from geometry.files.step_writer import step_text
from geometry.files.surfaces.writer import surface_text
from geometry.meshes.fan_tets import fan_tets, gathered

SUFFIXES = (".step", ".stp", ".obj", ".stl", ".msh", ".vtu")


def export(path: Path, specimen: Specimen, mesh: TetMesh | None = None) -> None:
    """Write the blocks to a file, its kind by the suffix; it appears whole or not at all.

    .step, .stp  one solid for each block, named by block_names
    .obj, .stl   the surface of each block as an object or a solid, in words, named by block_names
    .msh         Gmsh 2.2, binary: groups as physical groups, blocks as entities (their number plus one)
    .vtu         cell data group, block and unit
    Blocks without tets in mesh are written as fans of tets. Raises GeometryError for other suffixes.
    """
    path = Path(path)
    suffix = require_suffix(path)
    if suffix not in (".msh", ".vtu"):
        names = block_names(specimen)
        text = step_text(specimen.blocks, names) if suffix in (".step", ".stp") else None
        with whole_file(path) as place, open(place, "w", encoding="ascii" if text else "utf-8", newline="\n") as file:
            file.writelines(text or surface_text(specimen.blocks, names, suffix))
        return
    whole = _filled(specimen.blocks, mesh)
    with whole_file(path) as place:
        _write_tets(place, suffix, specimen.blocks, whole)


def require_suffix(path: Path) -> str:
    """The suffix of a file that can be written; GeometryError for others."""
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise GeometryError(f"'{path}': files are written as {', '.join(SUFFIXES)}, not as '{path.suffix}'")
    return suffix


def block_names(specimen: Specimen) -> list[str]:
    """A name for each block: that of a set which holds it alone, else its group, unit and number in the unit."""
    blocks = specimen.blocks
    key = np.stack([blocks.group, blocks.unit])
    _, part, size = np.unique(key, axis=1, return_inverse=True, return_counts=True)
    seen: dict[int, int] = {}
    names = []
    for b, p in enumerate(part.ravel().tolist()):
        seen[p] = seen.get(p, 0) + 1
        name = f"{blocks.groups[blocks.group[b]]}-{blocks.unit[b]}"
        names.append(name if size[p] == 1 else f"{name}-{seen[p]}")
    for name, members in specimen.sets.items():
        if len(members) == 1:
            names[int(members[0])] = name
    return names


def _filled(blocks: Blocks, mesh: TetMesh | None) -> TetMesh:
    """The mesh, with fans of tets in the blocks that it leaves empty."""
    if mesh is None:
        return fan_tets(blocks, np.ones(blocks.count, dtype=bool))
    empty = np.diff(mesh.tet_start) == 0
    filling = fan_tets(blocks, empty)
    return gathered(blocks.count, {b: (filling if empty[b] else mesh, b) for b in range(blocks.count)})


def _write_tets(place: Path, suffix: str, blocks: Blocks, mesh: TetMesh) -> None:
    import meshio

    block = np.repeat(np.arange(blocks.count), np.diff(mesh.tet_start)).astype(np.int32)
    group = blocks.group[block].astype(np.int32)
    cells = [("tetra", mesh.tets)]
    if suffix == ".vtu":
        data = {"group": [group], "block": [block], "unit": [blocks.unit[block].astype(np.int32)]}
        meshio.vtu.write(place, meshio.Mesh(mesh.nodes, cells, cell_data=data), compression=None)
        return
    tags = {"gmsh:physical": [group + 1], "gmsh:geometrical": [block + 1]}
    names = {name: np.array([g + 1, 3]) for g, name in enumerate(blocks.groups)}
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        meshio.gmsh.write(place, meshio.Mesh(mesh.nodes, cells, cell_data=tags, field_data=names), "2.2", binary=True)
