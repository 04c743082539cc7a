"""Words of a user about a file to import, as `ImportSettings`: for the command and for Python."""

import math
from collections.abc import Iterable, Mapping
from typing import Any

from masonry.errors import SceneError, nearest
from masonry.importing.importing import ImportSettings
from masonry.quantity import parse

QUANTITIES = {
    "unit": ("length", "[1e-9, 1e5]"),
    "tolerance": ("length", "[1e-9, 1]"),
    "thickness": ("length", "[1e-9, 1e5]"),
    "facet": ("length", "[1e-9, 1e5]"),
    "section": ("area", "[1e-12, 1e8]"),
    "holes": ("length", "[1e-9, 1e5]"),
    "gap": ("length", "[1e-9, 10]"),
    "angle": ("angle", f"(0, {math.pi / 3}]"),
}
"""Kind and interval of each; a unit by itself means one of it."""
OTHERS = ("groups", "open_gaps", "up")


def settings_of(words: Mapping[str, Any], mark: str = "") -> ImportSettings:
    """The settings that words ask for: those of `masonry import`, in which None stands for the usual.

    mark  what a message puts before a word: "--" on the command line
    Raises SceneError: one message with the word, what is wrong, and what is allowed.
    """
    settings: dict[str, Any] = {}
    for word, value in words.items():
        if word not in (*QUANTITIES, *OTHERS):
            raise SceneError(f"{mark}{word}: unknown; {nearest(word, (*QUANTITIES, *OTHERS))}")
        if value is None:
            continue
        if word in QUANTITIES:
            text = f"1 {value}" if word == "unit" and not f"{value}"[:1].isdigit() else value
            settings[word] = parse(text, QUANTITIES[word][0], f"{mark}{word}", QUANTITIES[word][1])
        elif word == "groups":
            settings[word] = _rules(value, mark)
        elif word == "open_gaps" and not isinstance(value, bool):
            raise SceneError(f"{mark}open_gaps = {value!r:.60}: give True or False")
        elif word == "up" and value not in ("x", "y", "z"):
            raise SceneError(f"{mark}up '{value}': allowed: x, y, z")
        else:
            settings[word] = value
    return ImportSettings(**settings)


def _rules(value: Any, mark: str) -> list[tuple[str, str]]:
    """Patterns and groups: a dictionary, or texts "brick*=units"."""
    if isinstance(value, Mapping):
        value = [f"{pattern}={group}" for pattern, group in value.items()]
    if isinstance(value, str) or not isinstance(value, Iterable):
        raise SceneError(f"{mark}groups = {value!r:.60}: give a dictionary, such as {{'brick*': 'units'}}")
    return [_rule(f"{text}", f"{mark}group" if mark else "groups:") for text in value]


def _rule(text: str, where: str) -> tuple[str, str]:
    pattern, equals, group = text.rpartition("=")
    if not equals or not pattern or not group or "." in group or not group.isprintable():
        raise SceneError(f"{where} '{text}': write PATTERN=GROUP, for example 'brick*=units'; no dot in a group")
    return pattern, group
