"""The words of the command line: settings, folders, options of every command."""

from pathlib import Path
from random import Random

from verification.fuzz.inputs.odd import NUMBERS, QUANTITIES, TEXTS, one_of, paths
from verification.fuzz.kind import Attempt, Kind

SCENES = ("couplet", "wallette-mode-1", "bending-0")
KEYS = (
    "law",
    "kinematics",
    "confinement",
    "contact.unit_unit.cohesion",
    "specimen.length",
    "specimen.cells.total",
    "support.0.on",
    "support.1.fix",
    "drive.on",
    "drive.steps",
    "drive.direction",
    "traction.0.stress.z",
    "scatter",
    "gauge",
    "curve.x",
    "title",
    "name",
    "assumptions",
    "solver.damping",
    "kinematics.units",
    "material",
    "base",
    "specimen.kind",
    "settle.steps",
    "gravity.z",
    "contact",
    "",
    ".",
    "a..b",
    "support.-1.on",
    "support.x",
    'contact."unit_unit".law',
    "specimen.divisions.0",
    "specimen",
    "support",
    "x" * 2000,
    "a." * 500,
)
OPTIONS = (
    "--out",
    "--set",
    "--threads",
    "--overwrite",
    "--quiet",
    "--to",
    "--geometry",
    "--view",
    "--unit",
    "--section",
    "--tolerance",
    "--thickness",
    "--facet",
    "--group",
    "--open-gaps",
    "--workers",
    "--compare",
    "--format",
    "--list",
    "--scheduler",
    "--version",
    "--help",
    "--no-such",
    "-x",
    "--",
)
CHEAP = ("check", "export", "import", "list", "picture", "plot", "--version", "--help", "", "chekc", "no\nsuch")


def make(draw: Random, folder: Path) -> Attempt:
    """Words that no one should write."""
    odd = (*TEXTS, *QUANTITIES, *map(_short, NUMBERS), *paths(folder))
    names = [word for word in odd if not word.startswith(("/", "..", "~"))]  # what is asked for elsewhere is no fault
    kind = draw.randrange(6)
    if kind < 3:
        pairs = [f"{one_of(draw, KEYS)}={one_of(draw, odd)}" for _ in range(1 + draw.randrange(3))]
        if draw.random() < 0.1:
            pairs.append(one_of(draw, odd))
        return Attempt(["check", one_of(draw, SCENES), *(word for pair in pairs for word in ("--set", pair))])
    if kind == 3:
        return Attempt(["run", "couplet", "--set", "drive.on=nothing", one_of(draw, OPTIONS), one_of(draw, names)])
    if kind == 4:
        name = one_of(draw, names)
        to = one_of(draw, (name, f"{name}.step", f"{name}.png", f"no/{name}.msh"))
        command = one_of(draw, (["export", "couplet", "--to", to], ["picture", "couplet", "--geometry", "--out", to]))
        return Attempt(command, _below(folder, to))
    words = [one_of(draw, CHEAP), *(one_of(draw, (*OPTIONS, *names, *SCENES)) for _ in range(draw.randrange(5)))]
    return Attempt(words, tuple(place for word in words for place in _below(folder, word)))


def _short(number: object) -> str:
    return "1" + "0" * 400 if isinstance(number, int) and abs(number) > 10**300 else str(number)


def _below(folder: Path, word: str) -> tuple[str, ...]:
    """The name that a word gives to a file in the working folder."""
    import os

    try:
        inside = Path(os.path.abspath(folder / word)).relative_to(folder)
    except ValueError:
        return ()
    return (str(inside), "couplet-geometry.png", *(f"{name}-geometry.png" for name in SCENES))


KIND = Kind("words", "words of the command line: --set, --out, options", 14, make)
