"""STEP files: torn, with numbers that lie, references in circles, and other letters in names."""

from pathlib import Path
from random import Random

from verification.fuzz.inputs import seeds
from verification.fuzz.inputs.foreign import importing
from verification.fuzz.inputs.odd import TEXTS, one_of
from verification.fuzz.kind import Attempt, Kind


def make(draw: Random, folder: Path) -> Attempt:
    """A changed STEP file."""
    return importing(draw, folder, seeds.step(), (".step", ".stp"), (_names, _references, _circle))


def _names(draw: Random, content: bytes) -> bytes:
    """Odd letters in the names of solids."""
    name = one_of(draw, TEXTS).encode("utf-8", "surrogatepass") + one_of(
        draw, (b"", b"\\X2\\000A000D\\X0\\", b"\\X2\\D800\\X0\\", b"''", b"\\X\\1B[2J")
    )
    return content.replace(b"MANIFOLD_SOLID_BREP('", b"MANIFOLD_SOLID_BREP('" + name).replace(
        b"PRODUCT('", b"PRODUCT('" + name
    )


def _references(draw: Random, content: bytes) -> bytes:
    """One reference led elsewhere."""
    parts = content.split(b"#")
    n = 1 + draw.randrange(len(parts) - 1)
    digits = len(parts[n]) - len(parts[n].lstrip(b"0123456789"))
    parts[n] = one_of(draw, (b"1", b"0", b"999999", b"99999999999999999999", b"-1", b"")) + parts[n][digits:]
    return b"#".join(parts)


def _circle(draw: Random, content: bytes) -> bytes:
    """Entities that stand on themselves, or for a thousand million others."""
    more = [
        f"#{900_000 + n} = NEXT_ASSEMBLY_USAGE_OCCURRENCE('','a','',#{n % 40 + 1},#{(n * 7) % 40 + 1},$);"
        for n in range(60)
    ]
    more += [f"#{800_000 + n} = CONVERSION_BASED_UNIT('X',#{800_000 + n});" for n in range(3)]
    return content.replace(b"ENDSEC;\nEND", "\n".join(more).encode() + b"\nENDSEC;\nEND")


def target(data: bytes) -> None:
    """What is read of a STEP file besides its shapes."""
    from geometry.files.step_labels import labels
    from geometry.files.step_reader import length_unit, records
    from verification.fuzz.target import refused

    entities = records(data.decode("latin-1"))
    refused(lambda found: labels(found, 1000), entities)
    refused(length_unit, entities)


KIND = Kind("step", "STEP: references, names, numbers, circles", 2.5, make, target)
