"""IGES and BREP files, changed as text and as bytes."""

from pathlib import Path
from random import Random

from verification.fuzz.inputs import seeds
from verification.fuzz.inputs.foreign import importing
from verification.fuzz.kind import Attempt, Kind


def make(draw: Random, folder: Path) -> Attempt:
    """A changed file of either."""
    if draw.random() < 0.5:
        return importing(draw, folder, seeds.iges(), (".igs", ".iges"))
    return importing(draw, folder, seeds.brep(), (".brep",))


KIND = Kind("iges-brep", "IGES and BREP: cut, other numbers, other bytes", 0.8, make)
