"""Neper's tessellations: torn, with counts that lie, corners that are none, numbers that are none."""

from pathlib import Path
from random import Random

from verification.fuzz.inputs import seeds
from verification.fuzz.inputs.foreign import importing
from verification.fuzz.inputs.odd import one_of
from verification.fuzz.kind import Attempt, Kind


def make(draw: Random, folder: Path) -> Attempt:
    """A changed tessellation."""
    return importing(draw, folder, seeds.tess(), (".tess",), (_sections, _flat))


def _sections(draw: Random, content: bytes) -> bytes:
    """Sections in another order, twice, or missing."""
    head, *parts = content.split(b"\n **")
    for _ in range(1 + draw.randrange(3)):
        n, m = draw.randrange(len(parts)), draw.randrange(len(parts))
        parts[n] = one_of(draw, (parts[m], parts[n] + b"\n **" + parts[m], b"", parts[n].split(b"\n")[0]))
    return b"\n **".join([head, *parts]) + one_of(draw, (b"", b"\n***end\n"))


def _flat(draw: Random, content: bytes) -> bytes:
    """Corners on each other, on a line, or bent far off their faces."""
    return content.replace(
        one_of(draw, (b"0.05", b"0.2", b"0.07")), one_of(draw, (b"0.0", b"0.2", b"1e7", b"-0.05", b"nan"))
    )


def target(data: bytes) -> None:
    """A tessellation of these bytes."""
    from geometry.files.tess import read_tess
    from verification.fuzz.target import with_file

    with_file(data, ".tess", lambda path: read_tess(path, thickness=0.1))


KIND = Kind("tess", "Neper's tessellations, plane and in space", 4, make, target)
