"""What a user may be told: one clear message, exit code 2, no traceback."""

import difflib
from collections.abc import Iterable
from typing import Any


class SceneError(ValueError):
    """A scene that cannot be run: what, where, what is allowed, and the nearest valid choice."""


class Stopped(RuntimeError):
    """A run that was stopped because its numbers can no longer be trusted: reason, step, and the block to blame.

    `result`, where there is one, holds the rows up to the last trusted one.
    """

    result: Any = None


def nearest(word: str, known: Iterable[str]) -> str:
    """What is allowed, and the nearest of it, for the end of a message."""
    allowed = sorted(known)
    close = difflib.get_close_matches(word, allowed, 1, 0.4)
    hint = f"; did you mean '{close[0]}'?" if close else ""
    return f"known here: {', '.join(allowed)}{hint}"
