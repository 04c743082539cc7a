"""Gmsh's meshes, 2.2 and 4.1, text and binary."""

from pathlib import Path
from random import Random

from verification.fuzz.inputs import seeds
from verification.fuzz.inputs.foreign import importing
from verification.fuzz.inputs.odd import one_of
from verification.fuzz.kind import Attempt, Kind


def make(draw: Random, folder: Path) -> Attempt:
    """A changed mesh."""
    return importing(draw, folder, seeds.msh(), (".msh",), (_other_kind, _other_head))


def _other_kind(draw: Random, content: bytes) -> bytes:
    """Elements of another type under the same nodes."""
    return content.replace(
        b" 4 2 ", one_of(draw, (b" 5 2 ", b" 11 2 ", b" 2 2 ", b" 99 2 ", b" 4 0 ", b" 4 -1 ", b" 4 1000000000 "))
    )


def _other_head(draw: Random, content: bytes) -> bytes:
    """Another version, kind or size of numbers than the file has."""
    line = content.split(b"\n")[1]
    return content.replace(
        line,
        one_of(
            draw,
            (
                b"2.2 0 8",
                b"2.2 1 8",
                b"4.1 0 8",
                b"4.1 1 8",
                b"4.0 1 8",
                b"4.1 1 4",
                b"9 0 8",
                b"1 0 8",
                b"2.2 7 8",
                b"",
                b"x y z",
                b"2.2 0 99999999999",
            ),
        ),
        1,
    )


KIND = Kind("msh", "Gmsh's meshes 2.2 and 4.1, text and binary", 2.5, make)
