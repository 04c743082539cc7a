"""Options of a task: what a user knows, in plain units; a bare number has the unit that the help names."""

import math
import numbers
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

from masonry.errors import SceneError, nearest
from masonry.quantity import is_plain, parse


class Entry(NamedTuple):
    """A value of an option: as it stands in the scene, "8 m", and in SI; NaN for a word."""

    text: str
    si: float


@dataclass(frozen=True)
class TaskOption:
    """A number, or a word of `words`, that a task asks for.

    default  its text, as a user would write it; "" where it follows from others, as `says` tells
    key      of the scene, and `guess`, the assumption that stands there while nobody gave another value
    several  how many values it may have, separated by commas
    """

    name: str
    says: str
    kind: str = "length"
    unit: str = "m"
    default: str = ""
    allowed: str = "(0, inf)"
    key: str = ""
    guess: str = ""
    several: int = 1
    words: tuple[str, ...] = ()

    @property
    def help(self) -> str:
        """Its line in the help."""
        return f"{self.says} (default {self.default})" if self.default else self.says

    @property
    def metavar(self) -> str:
        """The unit of a bare number, or the words."""
        if self.words:
            return "|".join(self.words)
        return f"{self.unit or 'NUMBER'},..." if self.several > 1 else self.unit or "NUMBER"

    def entries(self, value: Any, where: str) -> tuple[Entry, ...]:
        """The values of a text "8,6" or "8 m", a number, or a list of them. Raises SceneError."""
        value = value.tolist() if hasattr(value, "tolist") else value
        parts = value.split(",") if isinstance(value, str) and self.several > 1 else value
        parts = list(parts) if isinstance(parts, list | tuple) else [parts]
        if not 1 <= len(parts) <= self.several:
            number = "a single value" if self.several == 1 else f"1 to {self.several} values, with a comma between"
            raise SceneError(f"{where}: give {number}; here are {len(parts)}")
        return tuple(self._entry(part, where) for part in parts)

    def _entry(self, value: Any, where: str) -> Entry:
        if self.words:
            if value not in self.words:
                raise SceneError(f"{where}: {str(value)[:60]!r}; {nearest(str(value)[:60], self.words)}")
            return Entry(str(value), math.nan)
        text = _as_text(value, where)
        bare = isinstance(text, str) and _is_number(text)
        if not self.unit:
            si = parse(text, self.kind, where, self.allowed)
            return Entry(f"{si:.12g}", si)
        try:
            full = f"{text} {self.unit}" if bare else text
            si = parse(_with_gravity(full) if self.kind == "acceleration" else full, self.kind, where, self.allowed)
        except SceneError as error:
            raise SceneError(f"{error}; a bare number is in {self.unit}") from None
        return Entry(f"{text} {self.unit}" if bare else str(text), si)


class Entries:
    """The values of all options of a task. `dashes` is "--" where they come from a shell: messages then say so."""

    def __init__(self, options: tuple[TaskOption, ...], values: Mapping[str, Any], dashes: str = "") -> None:
        self._dashes = dashes
        known = {option.name: option for option in options}
        for name in values:
            if name not in known:
                raise SceneError(f"no option '{name[:60]}'; {nearest(name, known)}")
        self.chosen = {name for name, value in values.items() if value is not None}
        self._entries = {
            name: option.entries(values[name] if name in self.chosen else option.default, self.called(name))
            for name, option in known.items()
            if name in self.chosen or option.default
        }

    def called(self, name: str) -> str:
        """An option as the user writes it."""
        return f"--{name.replace('_', '-')}" if self._dashes else name

    def si(self, name: str) -> float:
        """Its only value, SI."""
        return self._entries[name][0].si

    def text(self, name: str) -> str:
        """Its only value, as it stands in a scene."""
        return self._entries[name][0].text

    def of_each(self, name: str, count: int, each: str) -> tuple[Entry, ...] | None:
        """A value for each of `count` things, called `each`: as many as there are, or a common one; None where none
        was given. Raises SceneError for another number of them."""
        entries = self._entries.get(name)
        if entries is None or len(entries) == count:
            return entries
        if len(entries) > 1:
            raise self.refusal(name, f"give 1 value, or one for each of the {count} {each}; here are {len(entries)}")
        return entries * count

    def optional(self, name: str) -> tuple[Entry, ...]:
        """All its values, none where it follows from others."""
        return self._entries.get(name, ())

    def refusal(self, name: str, says: str) -> SceneError:
        """An error that begins with the option."""
        return SceneError(f"{self.called(name)}: {says}")


def guesses(options: tuple[TaskOption, ...], entries: Entries) -> Iterator[tuple[str, str]]:
    """Key and assumption of each option that the user left."""
    for option in options:
        if option.guess and option.name not in entries.chosen:
            yield option.key, option.guess


def metres(value: float) -> str:
    """A length (m) as text, exact enough for units that must fill a wall."""
    return f"{value:.10g} m"


def round_up(value: float, step: float) -> float:
    """The next multiple of a step."""
    return round(math.ceil(round(value / step, 6)) * step, 6)


def _as_text(value: Any, where: str) -> Any:
    """A number as text, a text with single spaces, and anything else as it is."""
    if isinstance(value, str):
        return " ".join(value.split())
    if not isinstance(value, numbers.Real) or isinstance(value, bool):
        return value
    try:
        return f"{float(value):.12g}"
    except OverflowError:
        raise SceneError(f"{where}: no number is as large as this") from None


def _with_gravity(text: Any) -> Any:
    """An acceleration such as "0.3 g", whose g is that of gravity, not a gram."""
    return f"{text[:-1]}g_n" if isinstance(text, str) and text[-1:] == "g" and text[-2:-1] in " 0123456789." else text


def _is_number(text: str) -> bool:
    try:
        return is_plain(text) and math.isfinite(float(text))
    except ValueError:
        return False
