"""Histories of a drive: expressions, turning points and tables, in --set."""

from pathlib import Path
from random import Random

from verification.fuzz.inputs.odd import QUANTITIES, TEXTS, one_of
from verification.fuzz.inputs.texts import changed_text
from verification.fuzz.kind import Attempt, Kind

SEEDS = (
    "0.1 mm * sin(2 pi t / 1 s) * ramp(t / 4 s)",
    "0.2 mm * triangle(t / 2 s) - 0.1 mm * sin(pi t / 3 s) * (1 - ramp(t / 1 s))",
    "(((0.1 mm))) * t / 1 s",
    '["0.1 mm", "-0.1 mm", "0 mm"]',
    '[["0 s", "0 mm"], ["1 s", "0.1 mm"], ["2 s", "-0.1 mm"]]',
)
LONG = ("(", "sin(", "1 mm * ", "-", "[", "t * ", "1 mm + ")
DURATIONS = ("1 s", "4 s", "1e9 s", "0 s", "nan s")


def make(draw: Random, folder: Path) -> Attempt:
    """A changed history on the couplet that is sheared back and forth."""
    seed = one_of(draw, SEEDS if draw.random() < 0.8 else (*QUANTITIES, *TEXTS))
    if draw.random() < 0.1:
        seed = one_of(draw, LONG) * one_of(draw, (30, 500, 20_000)) + seed
    changed = changed_text(draw, seed.encode("utf-8", "surrogatepass")).decode("utf-8", "surrogateescape")
    words = ["check", "couplet-cyclic", "--set", f"drive.history={changed}"]
    if draw.random() < (0.1 if seed.startswith("[") else 0.9):
        words += ["--set", f"drive.duration={one_of(draw, DURATIONS)}"]
    return Attempt(words)


def target(data: bytes) -> None:
    """An expression of these letters, worked out at some times."""
    import numpy as np

    from masonry.scene.tables.expression import read
    from verification.fuzz.target import refused

    def worked_out(text: str) -> None:
        read(text, "length")(np.linspace(0.0, 1.0, 5))

    refused(worked_out, data.decode("utf-8", "surrogateescape"))


KIND = Kind("histories", "histories of a drive: expressions, turning points, tables", 5, make, target)
