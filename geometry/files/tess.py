"""Neper's tessellations (.tess, formats 2.0 to 4.x) as blocks; faces that its regularisation has bent become triangles.

A cell of a plane tessellation is drawn out through a thickness: x along the length, the file's y becomes z.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np

from geometry.blocks import GeometryError, Imported
from geometry.checks import require_lengths
from geometry.files.tess_blocks import TessFaces, drawn_out, solid
from geometry.files.tess_text import TessSection, read_sections
from geometry.polyhedra.construct import with_own_points
from geometry.polyhedra.validate import require_sound

CORNERS = 200
"""The most corners of a face, or faces of a cell times ten."""


def read_tess(path: Path, unit: float = 1.0, thickness: float | None = None) -> Imported:
    """The cells of a tessellation, one block each, all of one unit.

    unit       m, the length that the file calls 1
    thickness  m, along y; needed for a plane tessellation only
    The groups are those of *group within **cell ("group1", ...), or "units". Raises GeometryError, with the line.
    """
    path = Path(path)
    require_lengths("tessellation", {"unit": unit})
    sections = read_sections(path)
    dimension = _dimension(path, sections)
    vertices = _vertices(_section(path, sections, "vertex")) * unit
    if dimension == 2 and thickness is None:
        raise GeometryError(f"'{path}' is a plane tessellation: a thickness is needed to draw its cells out along y")
    faces = _faces(_section(path, sections, "face"), len(vertices), unit)
    ids, group = _cells(_section(path, sections, "cell"), sections)
    if dimension == 2:
        require_lengths("tessellation", {"thickness": thickness or 0.0})
        blocks, notes = drawn_out(path, vertices, faces, float(thickness or 0.0))
    else:
        cell_start, signed = _polyhedra(_section(path, sections, "polyhedron"), len(faces.start) - 1)
        blocks, notes = solid(path, vertices, faces, cell_start, signed)
    if blocks.count != len(ids):
        raise GeometryError(f"'{path}': **cell announces {len(ids)} cells, there are {blocks.count}")
    names, index = np.unique(group, return_inverse=True)
    groups = ("units",) if len(names) == 1 else tuple(f"group{number}" for number in names)
    blocks = with_own_points(replace(blocks, group=index.astype(np.int64), groups=groups))
    try:
        require_sound(blocks)
    except GeometryError as error:
        raise GeometryError(f"'{path}': {error}") from None
    return Imported(blocks, tuple(f"cell {number}" for number in ids), None, None, tuple(notes))


def _section(path: Path, sections: dict[str, TessSection], name: str) -> TessSection:
    if name not in sections:
        raise GeometryError(f"'{path}': the section **{name} is missing")
    return sections[name]


def _dimension(path: Path, sections: dict[str, TessSection]) -> int:
    version = _section(path, sections, "format").words
    if not version or version[0].split(".")[0] not in ("2", "3", "4"):
        raise GeometryError(f"'{path}': format {' '.join(version)[:20]!r} is unknown; formats 2.0 to 4.x can be read")
    general = _section(path, sections, "general").words
    if not general or general[0] not in ("2", "3"):
        raise GeometryError(f"'{path}': **general must begin with the dimension, 2 or 3, found {general[:1]}")
    return int(general[0])


def _vertices(section: TessSection) -> np.ndarray:
    count = section.count()
    table = section.real(5 * count).reshape(count, 5)
    _require_numbered(section, table[:, 0])
    return table[:, 1:4]


def _faces(section: TessSection, vertex_count: int, unit: float) -> TessFaces:
    count = section.count()
    corner, number, fan, middle = [], [], np.empty(count, dtype=np.int64), np.empty((count, 3))
    for f in range(count):
        label, corners = section.whole(2)
        if label != f + 1:
            raise section.error(f"face {f + 1} is expected here, found {label}", back=2)
        if not 3 <= corners <= CORNERS:
            raise section.error(f"face {f + 1} has {corners} corners, allowed: 3 to {CORNERS}", back=1)
        loop = section.whole(int(corners))
        if loop.min() < 1 or loop.max() > vertex_count or len(np.unique(loop)) < len(loop):
            raise section.error(f"face {f + 1} has corners twice, or not from 1 to {vertex_count}", back=1)
        edges = section.whole(1)[0]
        if edges != corners:
            raise section.error(f"face {f + 1} has {corners} corners and {edges} edges", back=1)
        section.real(int(edges) + 4)
        state, fan[f] = section.whole(2)
        middle[f] = section.real(3) * unit
        if state <= 0 or not 0 <= fan[f] <= corners:
            fan[f] = -1
        corner.append(loop - 1)
        number.append(int(corners))
    if not corner:
        raise section.error("there are no faces")
    return TessFaces(np.concatenate([[0], np.cumsum(number)]), np.concatenate(corner), fan, middle)


def _polyhedra(section: TessSection, face_count: int) -> tuple[np.ndarray, np.ndarray]:
    """Start (B + 1,) and faces (.,) of the cells: k + 1 if face k looks outward, -(k + 1) if it looks inward."""
    count = section.count()
    signed, number = [], []
    for b in range(count):
        label, faces = section.whole(2)
        if label != b + 1:
            raise section.error(f"polyhedron {b + 1} is expected here, found {label}", back=2)
        if not 4 <= faces <= 10 * CORNERS:
            raise section.error(f"polyhedron {b + 1} has {faces} faces, allowed: 4 to {10 * CORNERS}", back=1)
        signed.append(section.whole(int(faces)))
        size = np.abs(signed[-1])
        if size.min() < 1 or size.max() > face_count:
            raise section.error(f"polyhedron {b + 1} has faces that are not from 1 to {face_count}", back=1)
        number.append(int(faces))
    if not signed:
        raise section.error("there are no polyhedra")
    return np.concatenate([[0], np.cumsum(number)]), np.concatenate(signed)


def _cells(section: TessSection, sections: dict[str, TessSection]) -> tuple[np.ndarray, np.ndarray]:
    """Number and group (B,) of every cell."""
    count = int(section.whole(1)[0])
    limit = sum(s.left for s in sections.values())
    if not 0 < count <= limit:
        raise section.error(f"{count} cells are announced", back=1)
    ids = sections["cell.id"].whole(count) if "cell.id" in sections else np.arange(count) + 1
    group = sections["cell.group"].whole(count) if "cell.group" in sections else np.zeros(count, dtype=np.int64)
    return ids, group


def _require_numbered(section: TessSection, label: np.ndarray) -> None:
    wrong = label != np.arange(len(label)) + 1
    if wrong.any():
        first = int(np.argmax(wrong))
        raise section.error(f"{section.name} {first + 1} is expected here, found {label[first]:g}", back=section.place)
