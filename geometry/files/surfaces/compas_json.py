"""JSON of COMPAS: the blocks of a model, of an assembly, or of meshes, with their places; nothing else of the file.

What `compas.json_dump` writes is `{"dtype": "package/Class", "data": {...}}` for each object, with "value" in place of
"data" before version 2. Objects are told by what they hold, not by their class, so that classes made from them are read
too. Contacts, materials and forces are left out: joints are found anew.
"""

import json
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from geometry.blocks import GeometryError
from geometry.files.atomic import require_file
from geometry.files.surfaces.surface import Surface
from geometry.polyhedra.validate import FARTHEST

LARGEST = 1 << 30
"""Bytes of a file that is read."""
SUPPORT = "support"
"""Name of the blocks that a model or an assembly takes for its supports."""
FRAME = ("point", "xaxis", "yaxis")
BOX = np.array([[x, y, z] for z in (-0.5, 0.5) for x, y in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))])
BOX_FACES = [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
SHAPES = ("Mesh", "Polyhedron", "Box")
"""Classes that are blocks by themselves."""
NUMBERED = re.compile(r"block \d+")
ALLOWED = "a Mesh, Polyhedron or Box, a list of these, an Assembly or a BlockModel"


class Named(NamedTuple):
    """An object of the file: class, what it holds, and its own name, "" where that is its class."""

    dtype: str
    data: Any
    name: str


def read_compas(path: Path, notes: list[str] | None = None) -> list[Surface]:
    """A surface for each block, named as in the file, or "block 7" by its number, or SUPPORT; in the file's own unit.

    notes  gets a sentence where parts of lists are no blocks and were left out
    Raises GeometryError where the file is no JSON, holds nothing that has a shape, or a block without one.
    """
    require_file(path, LARGEST)
    try:
        content = json.loads(path.read_bytes().decode("utf-8-sig"), parse_constant=_refuse_constant)
        unread: list[str] = []
        surfaces = list(_surfaces(content, np.eye(4), "", unread))
    except RecursionError:
        raise GeometryError(f"'{path.name}': lists or tables nested too deeply") from None
    except GeometryError as error:
        raise GeometryError(f"'{path.name}': {error}") from None
    except ValueError as error:
        raise GeometryError(f"'{path.name}' is no JSON ({f'{error}'[:200]})") from None
    except (AttributeError, TypeError, LookupError) as error:
        raise GeometryError(f"'{path.name}': a table of it has not the form that COMPAS gives it ({error})") from None
    if not surfaces:
        raise GeometryError(f"'{path.name}' holds no blocks of COMPAS: {ALLOWED}, as compas.json_dump writes them")
    if unread and notes is not None:
        words = ", ".join(f"{times} of {kind}" for kind, times in Counter(unread).items())
        notes.append(f"what lists of the file hold besides blocks, which was left out: {words[:500]}")
    return _told_apart(surfaces)


def _told_apart(surfaces: list[Surface]) -> list[Surface]:
    """The surfaces; where lists of the file gave some of them the same number, numbered through the whole file."""
    times = Counter(surface.name for surface in surfaces if NUMBERED.fullmatch(surface.name))
    if not times or max(times.values()) == 1:
        return surfaces
    return [s._replace(name=f"block {n}") if s.name in times else s for n, s in enumerate(surfaces)]


def _refuse_constant(word: str) -> float:
    raise ValueError(f"{word} is no number")


def _named(value: dict[str, Any]) -> Named:
    """An object, whichever version wrote it; a bare table stands for what it holds."""
    dtype = value.get("dtype", value.get("datatype"))
    data = value.get("data", value.get("value")) if isinstance(dtype, str) else value
    if isinstance(dtype, str) and isinstance(data, dict) and isinstance(data.get("datatype"), str):
        data = data.get("data")  # version 0.17 has what it holds within a table of its own
    attributes = data.get("attributes") if isinstance(data, dict) else None
    inside = [table.get("name") for table in (data, attributes) if isinstance(table, dict)]
    names = [name for name in (value.get("name"), *inside) if isinstance(name, str) and name]
    dtype = dtype if isinstance(dtype, str) else ""
    class_name = next((name for name in names if name not in (dtype.rpartition("/")[2], "Mesh", "Box", "Block")), "")
    return Named(dtype, data, class_name)


def _surfaces(value: Any, place: np.ndarray, name: str, unread: list[str]) -> Iterator[Surface]:
    """The shapes of a value; place (4, 4) takes its coordinates to those of the file. What of lists has none is left
    out, and its class put into `unread`."""
    if isinstance(value, list):
        for number, item in enumerate(value):
            shapes = list(_surfaces(item, place, f"block {number}", unread))
            if not shapes and isinstance(item, dict):
                unread.append(_named(item).dtype or "a table")
            yield from shapes
        return
    if not isinstance(value, dict):
        return
    named = _named(value)
    data = named.data
    shape = _shape(data)
    if shape is not None:
        points, faces = shape
        if not faces:
            raise GeometryError(f"{named.name or name or 'a mesh'} has no faces")
        with np.errstate(all="ignore"):
            points = points @ place[:3, :3].T + place[:3, 3]
        yield Surface(named.name or name, _points(points), faces)
    elif isinstance(data, dict) and "elements" in data:
        yield from _of_model(data, place)
    elif isinstance(data, dict) and (nodes := _nodes(data)):
        yield from _of_nodes(nodes, place)
    elif named.dtype.rpartition("/")[2] in SHAPES:
        called = named.name or name or "one"
        raise GeometryError(f"{called}, a {named.dtype}, has not the tables of its corners and faces")
    elif not named.dtype:
        for key, item in value.items():
            yield from _surfaces(item, place, str(key), unread)


def _of_model(data: dict[str, Any], place: np.ndarray) -> Iterator[Surface]:
    """The elements of a model, each placed by itself, by those above it in the tree, and by the model."""
    listed = data["elements"]
    elements = {str(e.get("guid")): e for e in listed} if isinstance(listed, list) else dict(listed)
    places = dict.fromkeys(elements, place @ _matrix(data.get("transformation")))

    def descend(node: dict[str, Any], above: np.ndarray) -> None:
        element = elements.get(str(node.get("element")))
        here = above if element is None else above @ _own_place(element)
        if element is not None:
            places[str(node["element"])] = here
        for child in node.get("children") or []:
            descend(child, here)

    tree = data.get("tree") or {}
    descend(_named(tree).data.get("root") or {}, place @ _matrix(data.get("transformation")))
    in_tree = _order(_named(data.get("graph") or {}).data)
    for number, guid in enumerate(sorted(elements, key=lambda guid: in_tree.get(guid, len(in_tree)))):
        yield from _of_element(elements[guid], places[guid], number)


def _order(graph: Any) -> dict[str, int]:
    """Number of each element of a model, by its guid, as its graph has it."""
    nodes = graph.get("node") if isinstance(graph, dict) else None
    pairs = nodes.items() if isinstance(nodes, dict) else ()
    return {str(node.get("element")): int(key) for key, node in pairs if isinstance(node, dict) and key.isdecimal()}


def _of_element(value: dict[str, Any], place: np.ndarray, number: int) -> Iterator[Surface]:
    dtype, data, name = _named(value)
    if dtype.endswith("/Group"):  # of other elements, without a shape of its own
        return
    called = SUPPORT if data.get("is_support") else name or f"block {number}"
    shapes = list(_surfaces(data.get("geometry"), place, called, []))
    if not shapes:
        raise GeometryError(f"element {number}, a {dtype or 'table'}, holds no mesh; make a Block of its modelgeometry")
    yield from (shape._replace(name=called) for shape in shapes)


def _own_place(element: dict[str, Any]) -> np.ndarray:
    data = _named(element).data
    return _matrix(data.get("transformation", data.get("frame")))


def _nodes(data: dict[str, Any]) -> dict[str, Any]:
    """The nodes of an assembly that hold a block."""
    graph = data.get("graph")
    inside = _named(graph).data if isinstance(graph, dict) else data
    nodes = inside.get("node") if isinstance(inside, dict) else None
    return {key: node for key, node in nodes.items() if isinstance(node, dict)} if isinstance(nodes, dict) else {}


def _of_nodes(nodes: dict[str, Any], place: np.ndarray) -> Iterator[Surface]:
    for key, node in nodes.items():
        block = node.get("block")
        if not isinstance(block, dict):
            raise GeometryError(f"node {key} holds no block")
        named = _named(block)
        is_support = node.get("is_support", (named.data.get("attributes") or {}).get("is_support"))
        shapes = list(_surfaces(block | {"name": SUPPORT} if is_support else block, place, f"block {key}", []))
        if not shapes:
            raise GeometryError(f"node {key} holds a block without a mesh")
        yield from shapes


def _shape(data: Any) -> tuple[np.ndarray, list[np.ndarray]] | None:
    """Corners and faces of a mesh, a polyhedron or a box; None of anything else."""
    if not isinstance(data, dict):
        return None
    if isinstance(data.get("vertex"), dict) and isinstance(data.get("face"), dict):
        usual = data.get("default_vertex_attributes", data.get("dva")) or {}
        corners = [[{**usual, **at}.get(axis, 0.0) for axis in "xyz"] for at in data["vertex"].values()]
        number = {str(key): n for n, key in enumerate(data["vertex"])}
        try:
            faces = [[number[str(key)] for key in face] for face in data["face"].values() if face]
        except (KeyError, TypeError):
            raise GeometryError("a face names a vertex that is not there") from None
        return _points(corners), _loops(faces, len(corners))
    if isinstance(data.get("vertices"), list) and isinstance(data.get("faces"), list):
        corners = [_named(at).data if isinstance(at, dict) else at for at in data["vertices"]]
        return _points(corners), _loops(data["faces"], len(corners))
    if all(key in data for key in ("xsize", "ysize", "zsize")):
        sizes = _points([[data["xsize"], data["ysize"], data["zsize"]]])[0]
        place = _matrix(data.get("frame"))
        return (BOX * sizes) @ place[:3, :3].T + place[:3, 3], [np.array(face) for face in BOX_FACES]
    return None


def _points(corners: Any) -> np.ndarray:
    try:
        points = np.array(corners, dtype=float).reshape(-1, 3)
    except (TypeError, ValueError):
        raise GeometryError("a vertex is not three numbers") from None
    if not np.all(np.abs(points) <= FARTHEST):
        raise GeometryError(f"a vertex lies beyond {FARTHEST:.0e}")
    return points


def _loops(faces: list[Any], count: int) -> list[np.ndarray]:
    loops = [np.asarray(face) if isinstance(face, list) else np.zeros(0) for face in faces]
    for n, loop in enumerate(loops):
        if loop.ndim != 1 or loop.dtype.kind != "i" or len(loop) < 3 or loop.min() < 0 or loop.max() >= count:
            raise GeometryError(f"face {n} is no list of three or more of {count} vertices")
    return loops


def _matrix(value: Any) -> np.ndarray:
    """(4, 4) of a transformation, or of a frame: where its origin and axes lie. The identity where there is none."""
    if value is None:
        return np.eye(4)
    data = _named(value).data if isinstance(value, dict) else None
    try:
        if isinstance(data, dict) and "matrix" in data:
            matrix = np.array(data["matrix"], dtype=float)
        else:
            frame: dict[str, Any] = data or {}
            axes = [_named(frame[key]).data if isinstance(frame[key], dict) else frame[key] for key in FRAME]
            point, x, y = np.array(axes, dtype=float)
            matrix = np.eye(4)
            with np.errstate(all="ignore"):  # what is not finite is told below
                x /= np.linalg.norm(x)
                z = np.cross(x, y) / np.linalg.norm(np.cross(x, y))
            matrix[:3] = np.stack([x, np.cross(z, x), z, point], axis=1)
    except (KeyError, TypeError, ValueError):
        matrix = np.zeros(0)
    if matrix.shape != (4, 4) or not np.isfinite(matrix).all() or not np.array_equal(matrix[3], [0, 0, 0, 1]):
        raise GeometryError("a transformation is neither a matrix of 4 x 4 numbers, the last row 0 0 0 1, nor a frame")
    return matrix
