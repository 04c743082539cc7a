"""What a bad input is, and the kinds of it."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Concatenate

from hypothesis import strategies as st

from masonry.runtime.shell import OK, STOPPED, USAGE
from tests.fuzz.odd import Draw

SHOWN = 2000
"""Letters of a word or file that a failed test shows."""


@dataclass(frozen=True)
class Attempt:
    """One call of the program.

    words         those after `masonry`
    files         name in the working folder -> content, or the path that a link of this name leads to
    writes        names in the working folder that it may write where it accepts the input
    when_refused  names that it may write in any case
    codes         exit codes that it may end with
    """

    words: list[str]
    files: dict[str, bytes | Path] = field(default_factory=dict)
    writes: tuple[str, ...] = ()
    when_refused: tuple[str, ...] = ()
    codes: tuple[int, ...] = (OK, USAGE, STOPPED)

    def _repr_pretty_(self, printer: Any, cycle: bool) -> None:
        """As Hypothesis shows it when a test fails."""
        words, files = [word[:SHOWN] for word in self.words], dict(self.files)
        files = {name: at if isinstance(at, Path) else at[:SHOWN] for name, at in files.items()}
        printer.text(f"Attempt({words!r}, {files!r})")


@dataclass(frozen=True)
class Kind:
    """A kind of bad input.

    inputs  makes them
    share   of all inputs of a long campaign, relative to those of the other kinds
    few     how many `make test` tries
    """

    inputs: st.SearchStrategy[Attempt]
    share: float
    few: int


KINDS: dict[str, Kind] = {}
"""By name; a function with `@kind(...)` in a module of tests/fuzz/kinds is one."""


def kind(name: str, share: float, few: int = 25) -> Callable[[Callable[Concatenate[Draw, ...], Attempt]], None]:
    """Make a kind of a function that draws an Attempt."""

    def keep(make: Callable[Concatenate[Draw, ...], Attempt]) -> None:
        assert name not in KINDS
        KINDS[name] = Kind(st.composite(make)(), share, few)

    return keep
