"""What a kind of bad input is; each module of `kinds` that holds a KIND is one, found without a list."""

import importlib
import pkgutil
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from random import Random

from masonry.errors import SceneError, nearest
from verification.fuzz import kinds


@dataclass(frozen=True)
class Attempt:
    """One call of the program.

    words         those after `masonry`
    writes        names in the working folder that it may write where it accepts the input
    when_refused  names that it may write in any case
    """

    words: list[str]
    writes: tuple[str, ...] = ()
    when_refused: tuple[str, ...] = ()


@dataclass(frozen=True)
class Kind:
    """A kind of bad input.

    name    how it is called on the command line and in the table
    what    what is made bad, in a few words
    share   of all inputs, relative to those of the other kinds
    make    puts the input into an empty folder, the working folder of the call, and says what to call
    target  takes any bytes as the text of such a file, for `--atheris`; raises only what a user may be told
    """

    name: str
    what: str
    share: float
    make: Callable[[Random, Path], Attempt]
    target: Callable[[bytes], None] | None = None


@cache
def all_kinds() -> dict[str, Kind]:
    """Name -> kind. Raises ValueError where two share a name."""
    found: dict[str, Kind] = {}
    for entry in pkgutil.walk_packages(kinds.__path__, f"{kinds.__name__}."):
        kind = getattr(importlib.import_module(entry.name), "KIND", None)
        if isinstance(kind, Kind):
            if kind.name in found:
                raise ValueError(f"two kinds are called '{kind.name}'")
            found[kind.name] = kind
    return dict(sorted(found.items()))


def kind_of(name: str) -> Kind:
    """The kind of this name. Raises SceneError."""
    known = all_kinds()
    if name not in known:
        raise SceneError(f"no kind of bad input '{name[:80]}'; {nearest(name, known)}")
    return known[name]
