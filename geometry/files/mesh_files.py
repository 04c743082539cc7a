"""Meshes of tets from files that meshio reads: Gmsh's .msh (2.2, 4.0, 4.1) and VTK's .vtu.

Tets only: hexahedra, wedges and pyramids are refused, because splitting them would have to match across blocks.
Elements of the second order give the tets of their corners.
"""

import contextlib
import io
import re
from pathlib import Path
from typing import Any

import numpy as np

from geometry.blocks import GeometryError, Imported
from geometry.checks import require_lengths
from geometry.files.atomic import require_file
from geometry.meshes.blocks_of_tets import blocks_of_tets
from geometry.operating_system import SYSTEM

LARGEST = 2**30
"""Bytes of a file that is read."""
TETS = 5_000_000
GROUPS = ("gmsh:physical", "group", "region", "material", "CellEntityIds")
"""Cell data that say which group a tet belongs to; the first that a file has is taken."""
PARTS = ("gmsh:geometrical", "block", "unit")
"""Cell data that part tets of one group into blocks, all that a file has."""
CORNERS = {"tetra": 4, "tetra10": 4, "tetra20": 4, "tetra35": 4}
FLAT = re.compile(r"(vertex|line|triangle|quad|polygon)\d*")
ENCODING = re.compile(rb"""encoding\s*=\s*["']([^"']*)["']""")
PLAIN = (b"utf-8", b"us-ascii", b"ascii", b"iso-8859-1")


def read_mesh(path: Path, unit: float = 1.0) -> Imported:
    """Every connected part of the tets of a group as one block, with these tets inside.

    unit  m, the length that the file calls 1
    A block's faces are its surface triangles, put together where they form a flat convex face. Raises GeometryError.
    """
    path = Path(path)
    require_lengths("mesh", {"unit": unit})
    size = require_file(path, LARGEST)
    mesh = _meshio(path, size)
    chosen = [(cells.type, i) for i, cells in enumerate(mesh.cells) if not FLAT.fullmatch(cells.type)]
    others = sorted({f"{len(mesh.cells[i].data)} {kind}" for kind, i in chosen if kind not in CORNERS})
    if others:
        raise GeometryError(
            f"'{path}' holds {', '.join(others)} elements; only tets can be read: mesh the solids with tets"
        )
    if not chosen:
        raise GeometryError(f"'{path}' holds no tets, only surfaces, lines or points")
    tets = np.concatenate([np.asarray(mesh.cells[i].data)[:, : CORNERS[kind]] for kind, i in chosen]).astype(np.int64)
    points = np.asarray(mesh.points, dtype=float)
    _require_sane(path, points, tets)
    label, names = _groups(mesh, [i for _, i in chosen])
    part = _parts(mesh, [i for _, i in chosen], len(tets))
    notes = [
        f"{kind} elements: only their corners are used" for kind in sorted({k for k, _ in chosen}) if kind != "tetra"
    ]
    try:
        blocks, solid = blocks_of_tets(points * unit, tets, label, part, names)
    except GeometryError as error:
        raise GeometryError(f"'{path}': {error}") from None
    return Imported(blocks, tuple("" for _ in range(blocks.count)), None, solid, tuple(notes))


def _meshio(path: Path, size: int) -> Any:
    """The file as meshio understands it; what it says on the way is not shown."""
    import meshio

    readers = {".msh": meshio.gmsh.read, ".vtu": meshio.vtu.read}
    suffix = path.suffix.lower()
    if suffix not in readers:
        raise GeometryError(f"'{path}': meshes are read from {', '.join(readers)}, not from '{path.suffix}'")
    if suffix == ".vtu":
        _require_plain_xml(path)
    said = io.StringIO()
    try:
        with (
            SYSTEM.limited_memory(40 * size + 2**29),
            contextlib.redirect_stdout(said),
            contextlib.redirect_stderr(said),
        ):
            mesh = readers[suffix](path)
    except MemoryError:
        raise GeometryError(f"'{path}' claims to hold far more than its {size} bytes") from None
    except Exception as error:  # meshio raises whatever its parts do: IndexError, AssertionError, struct.error, ...
        reason = str(error).strip().split("\n")[0][:200] or type(error).__name__
        raise GeometryError(f"'{path}' is damaged, or no {suffix} mesh ({reason})") from None
    return mesh


def _require_plain_xml(path: Path) -> None:
    """No document type (it can define entities that grow without end), no encoding that could hide one."""
    with open(path, "rb") as file:
        head = file.read(512)
        encoding = ENCODING.search(head)
        if b"\0" in head[:16] or head[:2] in (b"\xff\xfe", b"\xfe\xff"):
            raise GeometryError(f"'{path}' is no .vtu file in UTF-8")
        if encoding and encoding[1].lower() not in PLAIN:
            raise GeometryError(f"'{path}' is in the encoding {encoding[1][:20]!r}; .vtu files in UTF-8 are read")
        file.seek(0)
        tail = b""
        while block := file.read(2**20):
            if b"<!DOCTYPE" in tail + block or b"<!ENTITY" in tail + block:
                raise GeometryError(f"'{path}' has a document type; .vtu files have none, and it is not read")
            tail = block[-16:]


def _require_sane(path: Path, points: np.ndarray, tets: np.ndarray) -> None:
    if points.ndim != 2 or points.shape[1] != 3:
        raise GeometryError(f"'{path}': its points have {points.shape[-1] if points.ndim else 0} coordinates, not 3")
    if len(tets) == 0 or len(tets) > TETS:
        raise GeometryError(f"'{path}' holds {len(tets)} tets, allowed: 1 to {TETS}")
    if tets.min() < 0 or tets.max() >= len(points):
        raise GeometryError(f"'{path}': a tet has a node that is not from 0 to {len(points) - 1}")
    if not np.isfinite(points[tets]).all():
        raise GeometryError(f"'{path}': a node of a tet is not finite")


def _cell_data(mesh: Any, name: str, which: list[int]) -> np.ndarray | None:
    """Whole numbers (T,) of the tets, or None where a file has none of this name."""
    if name not in mesh.cell_data:
        return None
    columns = mesh.cell_data[name]
    parts = [np.asarray(columns[i]) for i in which if i < len(columns)]
    if len(parts) < len(which) or any(
        p.ndim != 1 or len(p) != len(mesh.cells[i]) for p, i in zip(parts, which, strict=True)
    ):
        return None
    values = np.concatenate(parts)
    return values.astype(np.int64) if np.isfinite(values).all() else None


def _groups(mesh: Any, which: list[int]) -> tuple[np.ndarray, tuple[str, ...]]:
    """Group (T,) of every tet and the names of the groups."""
    count = sum(len(mesh.cells[i]) for i in which)
    for name in GROUPS:
        values = _cell_data(mesh, name, which)
        if values is not None:
            tags, label = np.unique(values, return_inverse=True)
            known = {}
            if name == "gmsh:physical":
                known = {int(v[0]): str(key) for key, v in mesh.field_data.items() if len(v) > 1 and int(v[1]) == 3}
            names = [known.get(int(tag), f"group{tag}") for tag in tags]
            if len(set(names)) == len(names):
                return label, tuple(names)
    return np.zeros(count, dtype=np.int64), ("units",)


def _parts(mesh: Any, which: list[int], count: int) -> np.ndarray:
    """(T,) the same number for tets that all of the file's own divisions put together."""
    columns = [values for values in (_cell_data(mesh, name, which) for name in PARTS) if values is not None]
    if not columns:
        return np.zeros(count, dtype=np.int64)
    return np.unique(np.stack(columns, axis=1), axis=0, return_inverse=True)[1].ravel()
