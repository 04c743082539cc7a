"""What a user may be told: one clear message, exit code 2, no traceback."""

from typing import Any


class SceneError(ValueError):
    """A scene that cannot be run: what, where, what is allowed, and the nearest valid choice."""


class Stopped(RuntimeError):
    """A run that was stopped because its numbers can no longer be trusted: reason, step, and the block to blame.

    `result`, where there is one, holds the rows up to the last trusted one.
    """

    result: Any = None
