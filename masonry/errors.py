"""Errors that a user is told: one clear message, exit code 2, no traceback."""

import difflib
from collections.abc import Iterable, Sequence
from typing import Any


class SceneError(ValueError):
    """A scene that cannot be run: what, where, what is allowed, and the nearest valid choice."""

    @property
    def lines(self) -> list[str]:
        """Lines to show: a single one, whatever characters the quoted words have."""
        return [visible(str(self))]

    def within(self, where: str, without: str = "") -> "SceneError":
        """The same, with where it was met in front, and without a word that begins it."""
        return SceneError(f"{where}: {str(self).removeprefix(without)}")


class Faults(SceneError):
    """Several things that are wrong, a line each."""

    def __init__(self, lines: Sequence[str]) -> None:
        super().__init__("\n".join(map(visible, lines)))

    @property
    def lines(self) -> list[str]:
        return str(self).split("\n")

    def within(self, where: str, without: str = "") -> SceneError:
        first, *others = (line.removeprefix(without) for line in self.lines)
        return Faults([f"{where}: {first}", *others])

    def __reduce__(self) -> tuple[type, tuple[list[str]]]:
        return Faults, (self.lines,)


class Stopped(RuntimeError):
    """A run that was stopped because its numbers can no longer be trusted: reason, step, and the block to blame.

    `result`, where there is one, holds the rows up to the last trusted one.
    """

    result: Any = None


class TurnedTooFar(Stopped):
    """A run that was stopped because a block has turned further than small displacement allows."""


class MovedTooFar(Stopped):
    """A run that was stopped because blocks have crushed, slid or met further than a run can tell what follows."""


def visible(text: str) -> str:
    """A text in one line of letters that can be seen: newlines and what could steer a terminal are written as codes."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode("ascii") for c in text)


def extra(name: str) -> str:
    """How to install an optional part; the program is in no package index, so that it comes from its clone."""
    return f"in the clone of masonry-dem: pip install '.[{name}]'"


def closest(word: str, known: Iterable[str], likeness: float = 0.4) -> str | None:
    """The word most like this one, of which no more than its beginning is read; None where none is like it."""
    return next(iter(difflib.get_close_matches(word[:100], list(known), 1, likeness)), None)


def did_you_mean(word: str, known: Iterable[str], likeness: float = 0.4) -> str:
    """The same as a question for the end of a message; empty where none is like it."""
    close = closest(word, known, likeness)
    return f"; did you mean '{close}'?" if close else ""


def nearest(word: str, known: Iterable[str]) -> str:
    """Allowed words, and the nearest of them, for the end of a message."""
    allowed = sorted(known)
    hint = did_you_mean(word, allowed)
    return f"known here: {', '.join(allowed)}{hint}"
