"""Trees of tables, lists and values, changed at random places; and written as TOML, every value in one line."""

import json
from collections.abc import Iterator
from copy import deepcopy
from random import Random
from typing import Any

from verification.fuzz.inputs.odd import NUMBERS, QUANTITIES, TEXTS, one_of, value

DEEP = 150
"""Tables within tables, at most."""
Place = tuple[Any, Any]
"""A table or list, and a key in it."""


def changed(draw: Random, tree: Any, spare: tuple[str, ...] = ()) -> Any:
    """A copy with one to three changes; `spare` are values that fit this file better than any, such as paths."""
    tree = deepcopy(tree)
    for _ in range(1 + draw.randrange(3)):
        places = list(_places(tree))
        if not places:
            return tree
        _change(draw, *one_of(draw, places), places, spare)
    return tree


def _places(tree: Any) -> Iterator[Place]:
    items = tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else ()
    for key, below in list(items):
        yield tree, key
        yield from _places(below)


def _change(draw: Random, table: Any, key: Any, places: list[Place], spare: tuple[str, ...]) -> None:
    old = table[key]
    kind = draw.randrange(10)
    if kind == 0:
        del table[key]
    elif kind == 1:
        other, name = one_of(draw, places)
        if isinstance(other, dict) or name < len(other):
            other[name] = deepcopy(old)
    elif kind == 2 and isinstance(table, dict):
        table[_renamed(draw, str(key))] = table.pop(key)
    elif kind == 3:
        table[key] = one_of(draw, ([old], [[old]], {"x": old}, str(old), [old] * 50, {str(key): {str(key): old}}, []))
    elif kind == 4:
        table[key] = _deep(draw, old)
    elif kind == 5 and isinstance(old, str):
        table[key] = _other_quantity(draw, old)
    elif kind == 6 and spare:
        table[key] = one_of(draw, spare)
    elif kind == 7:
        table[key] = one_of(draw, NUMBERS)
    else:
        table[key] = value(draw)


def _renamed(draw: Random, key: str) -> str:
    at = draw.randrange(len(key) + 1)
    return one_of(draw, (key[:at] + key[at + 1 :], key.upper(), f"{key}.{key}", key[:at] + one_of(draw, TEXTS)))


def _other_quantity(draw: Random, old: str) -> str:
    number, space, unit = old.partition(" ")
    units = ("mm", "m", "MPa", "GPa/m", "N/m", "deg", "%", "kg/m^3", "s", "furlong", "mPa", "Pa*m")
    numbers = ("0", "-1", "1e9", "1e-9", "1e308", "1e-320", "nan", "1e400", number + "0" * 8, f"-{number}")
    return one_of(
        draw, (f"{one_of(draw, numbers)} {unit}", f"{number}{space}{one_of(draw, units)}", one_of(draw, QUANTITIES))
    )


def _deep(draw: Random, old: Any) -> Any:
    deep = old
    for _ in range(draw.randrange(DEEP)):
        deep = [deep] if draw.random() < 0.5 else {"a": deep}
    return deep


def toml(tree: dict[str, Any]) -> str:
    """The tree as TOML that means the same: tables below the top are written inline."""
    return "".join(f"{_plain(str(key))} = {_inline(below)}\n" for key, below in tree.items())


def _inline(tree: Any) -> str:
    """Without recursion in depth: what is deep is deep on purpose."""
    parts: list[str] = []
    waiting: list[Any] = [("value", tree)]
    while waiting:
        kind, item = waiting.pop()
        if kind == "text":
            parts.append(item)
        elif isinstance(item, dict):
            inner = []
            for n, (key, below) in enumerate(item.items()):
                inner += [("text", f"{', ' * (n > 0)}{_plain(str(key))} = "), ("value", below)]
            waiting += reversed([("text", "{"), *inner, ("text", "}")])
        elif isinstance(item, list | tuple):
            inner = [part for below in item for part in (("value", below), ("text", ", "))]
            waiting += reversed([("text", "["), *inner, ("text", "]")])
        else:
            parts.append(_plain(item))
    return "".join(parts)


def _plain(item: Any) -> str:
    if isinstance(item, bool):
        return "true" if item else "false"
    if isinstance(item, str):
        return json.dumps(item, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(item, int) and abs(item) > 10**300:
        return f"{'-' * (item < 0)}1{'0' * 400}"
    return str(item)
