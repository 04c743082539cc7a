"""Blocks from closed surfaces: an OBJ, PLY, STL or COMPAS file with one body or many, or a folder of such files.

A reader of other people's files: call read_surfaces by `geometry.files.sandbox.guarded`.
"""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from geometry.blocks import GeometryError, Imported
from geometry.checks import require_lengths
from geometry.files.surfaces.bodies import bodies_of
from geometry.files.surfaces.closing import Changes
from geometry.files.surfaces.compas_json import read_compas
from geometry.files.surfaces.obj import read_obj
from geometry.files.surfaces.surface import Surface
from geometry.specimens.from_arrays import from_mesh

SUFFIXES = (".obj", ".ply", ".stl")
MOST_FACES = 2_000_000
FAR = 1e3
"""Times their size that bodies may lie from the origin before they are moved there."""
LEAST = 1e-12
"""m: moves of corners that are not told, being rounding."""


def files_of(path: Path) -> list[Path]:
    """The file itself, or the surface files of a folder by name, numbers in their order: stone_2 before stone_10."""
    if not path.is_dir():
        return [path]
    files = [file for file in path.iterdir() if file.suffix.lower() in SUFFIXES and file.is_file()]
    if not files:
        raise GeometryError(f"'{path}': the folder holds no {', '.join(SUFFIXES)} files")
    return sorted(files, key=lambda file: [int(w) if w.isdecimal() else w for w in re.split(r"(\d+)", file.name)])


def read_surfaces(path: Path, unit: float | None = None, holes: float = 0.0, flat: float = 0.0) -> Imported:
    """Every closed body as one block.

    unit   m, what 1 in the file stands for; 1 m where it is None, which is said
    holes  m, how wide a hole of a surface may be that is closed
    flat   m, how far the corners of a face may stand off a plane: they are moved into it
    Named as the groups of the file, of a folder as its files; several bodies of one name get numbers. Faces that are
    not flat become triangles. Raises GeometryError for what is open, crosses itself or encloses nothing.
    """
    path = Path(path)
    notes = ["1 in the file is taken as 1 m; --unit says otherwise"] if unit is None else []
    unit = 1.0 if unit is None else unit
    require_lengths("surfaces", {"unit": unit})
    surfaces = _surfaces(path, notes)
    shift, changes = _shift([surface.points for *_, surface in surfaces]), Changes()
    moved = _moved([(called, surface) for called, _, surface in surfaces], shift)
    try:
        mesh, counts = bodies_of(moved, path.name, changes, holes / unit, flat / unit)
    except GeometryError as error:
        raise GeometryError(f"{error}{_far_away(shift * unit)}") from None
    names = []
    for (_, name, _), count in zip(surfaces, counts, strict=True):
        names += [name] if count == 1 else [f"{name}-{n}" if name else "" for n in range(1, count + 1)]
    if shift.any():
        notes.append(_far(shift * unit))
    blocks = from_mesh(mesh._replace(points=mesh.points * unit), range(len(names)), ["units"] * len(names))
    return Imported(blocks, tuple(names), None, None, (*_notes(changes, unit), *notes))


def _surfaces(path: Path, notes: list[str]) -> list[tuple[str, str, Surface]]:
    """Name of each surface of a file or a folder in a message, its own name, and the surface; notes gets sentences."""
    in_folder, listed = path.is_dir(), []
    for file in files_of(path):
        surfaces = READERS.get(file.suffix.lower(), _by_trimesh)(file, notes)
        if not surfaces:
            raise GeometryError(f"'{file.name}' holds no faces")
        if sum(len(surface.faces) for surface in surfaces) > MOST_FACES:
            raise GeometryError(f"'{file.name}' holds more than {MOST_FACES} faces; thin it out where it was made")
        for number, surface in enumerate(surfaces, start=1):
            name = surface.name or (file.stem if in_folder or len(surfaces) == 1 else "")
            listed.append((_called(file, name, number, len(surfaces)), name, surface))
    return listed


def _moved(surfaces: list[tuple[str, Surface]], shift: np.ndarray) -> list[tuple[str, Surface]]:
    """The surfaces with their points moved by -shift (3,); what shared points shares them still."""
    if not shift.any():
        return surfaces
    points = {id(surface.points): surface.points - shift for _, surface in surfaces}
    return [(called, surface._replace(points=points[id(surface.points)])) for called, surface in surfaces]


def _shift(parts: list[np.ndarray]) -> np.ndarray:
    """Shift taken off all corners (., 3) where they lie far from the origin against their size; else zeros (3,)."""
    different = {id(points): points for points in parts}.values()
    ends = np.array([(points.min(axis=0), points.max(axis=0)) for points in different])
    low, high = ends[:, 0].min(axis=0), ends[:, 1].max(axis=0)
    size = float((high - low).max())
    if not np.isfinite(size) or size <= 0:
        return np.zeros(3)
    step = 10.0 ** np.ceil(np.log10(size))
    far = np.abs(low + high) / 2 > FAR * size
    return np.where(far.any(), np.round((low + high) / 2 / step) * step, 0.0)


def _far(shift: np.ndarray) -> str:
    """That the bodies were moved, and why."""
    x, y, z = -shift
    reach = float(np.abs(shift).max())
    return (
        f"the bodies lie {reach:.3g} m from the origin, where numbers of seven digits, as in binary files, are "
        f"rounded to {reach * 2.0**-24 * 1e3:.2g} mm: all were moved by ({x:.10g}, {y:.10g}, {z:.10g}) m"
    )


def _far_away(shift: np.ndarray) -> str:
    """Advice where bodies that lie far away (m) were refused: their rounding may be the reason."""
    if not shift.any():
        return ""
    return f"; {_far(shift).partition(':')[0]}: export them nearer to the origin, or in a format of full precision"


def _called(file: Path, name: str, number: int, of: int) -> str:
    """Name of a surface in a message."""
    if of == 1:
        return f"'{file.name}'"
    which = f"'{name}'" if name else f"group {number}"
    return f"{which} of '{file.name}'"


def _by_trimesh(file: Path, notes: list[str]) -> list[Surface]:
    """PLY and STL, as trimesh understands them; an STL file in words has a surface for each solid."""
    import trimesh

    try:
        scene: Any = trimesh.load_scene(str(file), process=False)
        meshes = [(name, mesh) for name, mesh in scene.geometry.items() if hasattr(mesh, "faces")]
    except Exception as error:  # its readers raise whatever their parts do: ValueError, IndexError, struct.error, ...
        reason = str(error).strip().split("\n")[0][:200] or type(error).__name__
        raise GeometryError(f"'{file.name}' is damaged, or no {file.suffix} file ({reason})") from None
    surfaces = []
    for name, mesh in meshes:
        points, faces = np.asarray(mesh.vertices, dtype=float), np.asarray(mesh.faces, dtype=np.int64)
        if len(faces) and (faces.min() < 0 or faces.max() >= len(points)):
            raise GeometryError(f"'{file.name}': a face names corners that are not there, of {len(points)}")
        if len(faces):
            surfaces.append(Surface(name if len(meshes) > 1 else "", points, list(faces)))
    return surfaces


READERS: dict[str, Callable[[Path, list[str]], list[Surface]]] = {".obj": read_obj, ".json": read_compas}
"""By suffix; trimesh reads all others."""


def _notes(changes: Changes, unit: float) -> list[str]:
    """Changes, in sentences."""
    notes = []
    if changes.doubled:
        notes.append(f"faces that were there twice, of which one was left out: {changes.doubled}")
    if changes.collapsed:
        notes.append(f"faces without three corners that differ, which were left out: {changes.collapsed}")
    if changes.holes:
        notes.append(f"holes that were closed, of up to {changes.widest * unit * 1e3:.3g} mm: {changes.holes}")
    if changes.junctions:
        notes.append(
            f"corners that lay on an edge of a neighbour, which were put into that edge: {changes.junctions}; the "
            f"bodies have {changes.volume * unit**3:.6g} m^3"
        )
    if changes.turned:
        notes.append(f"blocks with faces that looked inwards, which were turned: {changes.turned}")
    if changes.moved * unit > LEAST:
        moved = changes.moved * unit * 1e3
        notes.append(f"faces that were flat but for noise were made flat: corners moved by up to {moved:.3g} mm")
    if changes.bent:
        other = changes.other_volume / changes.volume - 1
        notes.append(
            f"faces that are not flat, by up to {changes.highest * unit * 1e3:.3g} mm: {changes.bent} of "
            f"{changes.faces}; each became the triangles of least area (fans round their middles would change the "
            f"volume by {other:+.2g})"
        )
    return notes
