"""Attributes that something remembers from one chunk of steps to the next, by name."""

from collections.abc import Iterable
from typing import Any

State = dict[str, Any]
"""By name: numbers, words, bools, None, arrays, lists of these, and tables of the same kind."""


def attributes(thing: object, names: Iterable[str]) -> State:
    """What they are now."""
    return {name: getattr(thing, name) for name in names}


def put_back(thing: object, names: Iterable[str], state: State) -> None:
    """Make them what they were."""
    for name in names:
        setattr(thing, name, state[name])
