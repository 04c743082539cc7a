"""Quantities: numbers with units, in --set and in options that take one."""

from pathlib import Path
from random import Random

from verification.fuzz.inputs.odd import QUANTITIES, TEXTS, one_of
from verification.fuzz.inputs.texts import changed_text
from verification.fuzz.kind import Attempt, Kind

SEEDS = (
    "0.87 MPa",
    "150 GPa/m",
    "58 N/m",
    "45 deg",
    "-9.81 m/s^2",
    "1900 kg/m^3",
    "25.4 mm",
    "1 %",
    "130 N/m/MPa",
    "2 inch*ft",
)
KEYS = (
    *("specimen.length", "contact.unit_unit.cohesion", "contact.unit_unit.normal_stiffness", "drive.displacement"),
    *("contact.unit_unit.friction_angle", "material.units.density", "drive.accuracy", "confinement", "gravity.z"),
)


def make(draw: Random, folder: Path) -> Attempt:
    """A changed quantity in the place of a sound one."""
    text = one_of(draw, (*SEEDS, *QUANTITIES, *TEXTS))
    changed = changed_text(draw, text.encode("utf-8", "surrogatepass")).decode("utf-8", "surrogateescape")
    if draw.random() < 0.8:
        return Attempt(["check", "couplet", "--set", f"{one_of(draw, KEYS)}={changed}"])
    option = one_of(draw, ("--unit", "--tolerance", "--thickness", "--facet", "--section"))
    return Attempt(["import", "none.step", "--out", "new.toml", option, changed])


def target(data: bytes) -> None:
    """A quantity of these letters, of every kind."""
    from masonry.quantity import KINDS, parse
    from verification.fuzz.target import refused

    text = data.decode("utf-8", "surrogateescape")
    for kind in KINDS:
        refused(lambda given, kind=kind: parse(given, kind, "a.toml: key"), text)  # type: ignore[misc]


KIND = Kind("quantity", "numbers and units", 8, make, target)
