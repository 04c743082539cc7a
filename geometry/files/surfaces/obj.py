"""Wavefront OBJ: the corners and the polygons of each object or group; normals, textures, materials are left out."""

from pathlib import Path

import numpy as np

from geometry.blocks import GeometryError
from geometry.files.surfaces.surface import Surface
from geometry.polyhedra.validate import FARTHEST


def read_obj(path: Path, notes: list[str] | None = None) -> list[Surface]:
    """A surface for each `o` or `g` that has faces, in the file's own unit. Raises GeometryError with the line."""
    corners: list[list[float]] = []
    named: list[tuple[str, list[np.ndarray]]] = [("", [])]
    with open(path, encoding="utf-8", errors="replace") as file:
        for number, line in enumerate(_whole_lines(file), start=1):
            word, *rest = line.split(maxsplit=1) or [""]
            said = rest[0] if rest else ""
            if word == "v":
                corners.append(_corner(said, path, number))
            elif word == "f":
                named[-1][1].append(_face(said, len(corners), path, number))
            elif word in ("o", "g"):
                named.append((said.strip(), []))
    points = np.array(corners).reshape(-1, 3)
    return [Surface(name, points, faces) for name, faces in named if faces]


def _whole_lines(file):
    """Lines without remarks; one that ends in a backslash goes on in the next, which counts as an empty one."""
    whole, skipped = "", 0
    for line in file:
        whole += line.split("#")[0].rstrip("\r\n")
        if whole.endswith("\\"):
            whole, skipped = whole[:-1] + " ", skipped + 1
            continue
        yield whole
        yield from [""] * skipped
        whole, skipped = "", 0
    if whole:
        yield whole


def _corner(said: str, path: Path, number: int) -> list[float]:
    try:
        place = [float(word) for word in said.replace("_", "no").split()[:3]]
    except ValueError:
        place = []
    if len(place) != 3 or not all(abs(x) <= FARTHEST for x in place):
        raise GeometryError(f"'{path.name}', line {number}: a corner is three numbers, up to {FARTHEST:.0e}")
    return place


def _face(said: str, count: int, path: Path, number: int) -> np.ndarray:
    """Numbers from 0 of the corners of a face; a negative one counts from the last corner so far."""
    try:
        numbers = np.array([int(word.split("/")[0]) for word in said.split()], dtype=np.int64)
    except (ValueError, OverflowError):
        numbers = np.zeros(0, dtype=np.int64)
    numbers = np.where(numbers < 0, numbers + count, numbers - 1)
    if len(numbers) < 3 or numbers.min() < 0 or numbers.max() >= count:
        raise GeometryError(
            f"'{path.name}', line {number}: a face is three or more numbers of the {count} corners before it"
        )
    return numbers
