"""Arguments of a Python user to the functions of masonry, checked first: one SceneError, as on the command line."""

import os
import re
from collections.abc import Callable, Sequence
from functools import wraps
from numbers import Integral, Real
from pathlib import Path
from typing import Any, TypeVar, cast

from geometry.errors import GeometryError
from masonry.errors import SceneError, visible

F = TypeVar("F", bound=Callable[..., Any])
SWITCHES = {
    "no-dilation": "dilation=False",
    "no-strength": "strength=False",
    "linear": "sides=",
    "safety": "safety=True",
    "pressed": "pressed=True",
    "overwrite": "overwrite=True",
    "open-gaps": "open_gaps=True",
    "group": "groups=",
}
"""Options of the commands that have another name, or a value, as arguments of functions."""


def in_words_of_python(text: str) -> str:
    """A sentence of a command, with its options as arguments of a function: crushing= in place of --crushing."""

    def argument(option: re.Match[str]) -> str:
        name, rest = option[1], option[2] or ""
        return SWITCHES[name] + rest if name in SWITCHES else f"{name.replace('-', '_')}="

    return re.sub(r"(?<![\w-])--([a-z]+(?:-[a-z]+)*)(=| (?=['\d]|\w+:))?", argument, text)


def speaking_python(function: F) -> F:
    """The same function, whose errors name arguments, not options of a command."""

    @wraps(function)
    def called_from_python(*args: Any, **named: Any) -> Any:
        try:
            return function(*args, **named)
        except (SceneError, GeometryError) as error:
            error.args = tuple(in_words_of_python(word) if isinstance(word, str) else word for word in error.args)
            raise

    return cast(F, called_from_python)


def refuse(name: str, value: Any, allowed: str) -> SceneError:
    """Error in an argument, with the values allowed."""
    return SceneError(f"{name} = {visible(f'{value!r:.60}')}: give {allowed}")


def flag(name: str, value: Any) -> bool:
    """True or False, and nothing that merely counts as one of them."""
    if isinstance(value, bool) or type(value).__name__ in ("bool_", "bool"):
        return bool(value)
    raise refuse(name, value, "True or False")


def whole(name: str, value: Any, low: int, high: int, what: str = "a whole number") -> int:
    """A whole number from low to high."""
    if isinstance(value, Integral) and not isinstance(value, bool) and low <= int(value) <= high:
        return int(value)
    raise refuse(name, value, f"{what} from {low} to {high}")


def threads(value: Any) -> int | str:
    """A number of threads, or AUTO."""
    from masonry.runtime.processors import AUTO, processors

    if isinstance(value, str) and value == AUTO:
        return AUTO
    return whole("threads", value, 1, processors(), f'"{AUTO}", or a number of threads')


def number(name: str, value: Any, low: float, high: float) -> float:
    """A number from low to high."""
    if isinstance(value, Real) and not isinstance(value, bool) and low <= float(value) <= high:
        return float(value)
    raise refuse(name, value, f"a number from {low:g} to {high:g}")


def stress(name: str, value: Any) -> float | None:
    """A stress as text, or in Pa; None stays."""
    from masonry.quantity import parse

    if value is None:
        return None
    if isinstance(value, str):
        return parse(value, "stress", name, "(0, 1e15]")
    if isinstance(value, Real) and not isinstance(value, bool) and 0.0 < float(value) <= 1e15:
        return float(value)
    raise refuse(name, value, "a stress above 0, such as '5 MPa', a number of Pa up to 1e15, or None")


def path(name: str, value: Any) -> Path:
    """The path of a file or folder."""
    if isinstance(value, str | os.PathLike) and isinstance(os.fspath(value), str):
        return Path(value)
    raise refuse(name, value, "the path of a file or folder")


def words(name: str, value: Any) -> Sequence[str]:
    """A list of words, or one text with commas between them."""
    if isinstance(value, str):
        return [word.strip() for word in value.split(",")]
    if isinstance(value, Sequence) and all(isinstance(word, str) for word in value):
        return value
    raise refuse(name, value, "a list of words")


def called(name: str, value: Any, *others: Any) -> Any:
    """A function, or one of a few other values."""
    if callable(value) or any(value is other for other in others):
        return value
    raise refuse(name, value, f"{', '.join(map(repr, others))} or a function")
