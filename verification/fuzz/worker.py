"""What a process of the campaign does: it tries one input after the other, in a room of its own."""

import os
import resource
from collections.abc import Generator, Sequence
from functools import cache
from pathlib import Path
from random import Random
from typing import Any, NamedTuple

from masonry.assembly import size_limits as size_guard
from masonry.quantity import parse
from masonry.sweep import engine
from verification.fuzz.inputs import reading
from verification.fuzz.kind import kind_of
from verification.fuzz.room import Room, made
from verification.fuzz.trial import MEMORY, Trial, tried

ADDRESSES = 4 * MEMORY
"""Bytes that a process may ask for; what it takes of them is measured."""
BLOCKS, CONTACT_POINTS, TETS = 300, 20_000, 20_000
"""Sizes that scenes may have here, in place of those of `masonry.assembly.size_limits`, so that none takes long."""


class Task(NamedTuple):
    """One input: the seed of the campaign, the kind, its number within the kind, and the folder of all rooms."""

    seed: int
    kind: str
    number: int
    root: str


def act(task: Task) -> Trial:
    """Try it. The same task makes the same input in any process."""
    draw = Random(f"{task.seed} {task.kind} {task.number}")
    return tried(kind_of(task.kind), draw, task.number, prepared(Path(task.root)))


def warm(scene: str) -> None:
    """Have compiled what a scene compiles before its first step: the cells of its units."""
    from masonry.laboratory import laboratory
    from masonry.scene import load

    laboratory.check(load(scene, {"specimen.cells.total": 12}))
    laboratory.check(load(scene, {"specimen.cells.total": 12, "specimen.cells.form": "space"}))


@cache
def prepared(root: Path) -> Room:
    """A room, and the program made ready for many inputs: small sizes only, quick readers, no runs in a sweep."""
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    resource.setrlimit(resource.RLIMIT_AS, (ADDRESSES, hard))
    resource.setrlimit(resource.RLIMIT_CORE, (0, hard if hard == 0 else resource.getrlimit(resource.RLIMIT_CORE)[1]))
    size_guard.BLOCKS, size_guard.CONTACT_POINTS, size_guard.TETS = BLOCKS, CONTACT_POINTS, TETS
    setattr(engine, "work", no_runs)  # noqa: B010 (another function than the type checker knows)
    reading.quicken()
    parse("1 furlong", "length", "")  # loads what knows the units
    return made(root / f"process-{os.getpid()}")


def no_runs(act: Any, tasks: Sequence[Any], workers: int, limit: float) -> Generator[tuple[int, Any]]:
    """A sweep whose runs are not done already ends with a row that says so."""
    from masonry.runtime.processes import Lost

    yield from ((number, Lost("no runs here", 0.0)) for number in range(len(tasks)))
