"""Sound texts, bytes and trees of values, changed at some places."""

import re
import struct
from collections.abc import Iterator
from copy import deepcopy
from typing import Any

from hypothesis import strategies as st

from tests.fuzz.odd import ANY_VALUE, NUMBERS, QUANTITIES, TEXTS, Draw, below, pick

NUMBER = re.compile(rb"(?<![\w.])[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?")
ODD = (
    *(b"nan", b"inf", b"-inf", b"0", b"-1", b"1e308", b"1e-320", b"1e999", b"2147483648", b"9223372036854775808"),
    *(b"1000000000", b"999999999999999999999", b"1.5", b"", b"x", b"0x10", b"--1", b"1_0", b"\xd9\xa3"),
)
INSERTED = tuple(text.encode("utf-8", "surrogatepass") for text in (*TEXTS, *QUANTITIES))
WORDS = (
    *(struct.pack("<q", number) for number in (0, 1, -1, 2**31 - 1, 10**9, 2**62, -(2**63))),
    *(struct.pack("<d", number) for number in (float("nan"), float("inf"), 1e308, -1e300, 5e-324)),
    *(b"\xff" * 4, b"\0" * 4, b"\xff\xff\xff\x7f", b"\0\xca\x9a\x3b"),
)
"""Numbers as binary files hold them."""
LARGEST = 300_000
"""Bytes of what is made; repeated parts stop there."""
DEEP = 100
"""Tables within tables, at most."""


def changed_text(draw: Draw, content: bytes) -> bytes:
    """One to three changes of a text file."""
    for _ in range(draw(st.integers(1, 3))):
        content = _change_of_text(draw, content)
    return content[:LARGEST]


def changed_word(draw: Draw, word: str) -> str:
    """The same of a word on the command line."""
    return changed_text(draw, word.encode("utf-8", "surrogatepass")).decode("utf-8", "surrogateescape")


def _change_of_text(draw: Draw, content: bytes) -> bytes:
    kind = below(draw, 10)
    if kind < 3:
        return _with_other_number(draw, content)
    if kind == 3:
        return changed_bytes(draw, content)
    if kind < 7:
        at = below(draw, len(content) + 1)
        if kind == 4:
            return content[:at]
        if kind == 5:
            return content[:at] + content[at + below(draw, 200) :]
        return content[:at] + draw(st.sampled_from(INSERTED) | st.binary(min_size=1, max_size=8)) + content[at:]
    lines = content.split(b"\n")
    n, m = below(draw, len(lines)), below(draw, len(lines))
    if kind == 7:
        lines[n], lines[m] = lines[m], lines[n]
    elif kind == 8:
        lines[n:n] = [lines[m]] * pick(draw, (1, 2, 50, 1000))
    else:
        del lines[n : n + 1 + below(draw, 5)]
    return b"\n".join(lines)


def _with_other_number(draw: Draw, content: bytes) -> bytes:
    """Another number in the place of one: odd, a thousand million times as large, negative, or another's."""
    numbers = list(NUMBER.finditer(content))
    if not numbers:
        return content
    one, other = pick(draw, numbers), pick(draw, numbers)
    new = pick(draw, (pick(draw, ODD), one[0] + b"000000000", b"-" + one[0], other[0], one[0] + b"1", b"3"))
    return content[: one.start()] + new + content[one.end() :]


def changed_bytes(draw: Draw, content: bytes) -> bytes:
    """One change of a binary file."""
    data = bytearray(content)
    if not data:
        return b"\0"
    at, kind = below(draw, len(data)), below(draw, 7)
    if kind == 0:
        for _ in range(draw(st.integers(1, 8))):
            data[below(draw, len(data))] ^= 1 << below(draw, 8)
    elif kind == 1:
        del data[at:]
    elif kind == 2:
        del data[at : at + 1 + below(draw, 64)]
    elif kind == 3:
        data[at:at] = data[at : at + 1 + below(draw, 256)] * pick(draw, (1, 3, 100))
    else:
        word = pick(draw, WORDS)
        data[at : at + len(word)] = word
    return bytes(data[:LARGEST])


def changed_tree(draw: Draw, tree: Any, spare: tuple[Any, ...] = ()) -> Any:
    """A copy with one to three changes; `spare` are values that fit this file better than any, such as paths."""
    tree = deepcopy(tree)
    for _ in range(draw(st.integers(1, 3))):
        places = list(_places(tree))
        if not places:
            return tree
        _change_of_tree(draw, places, spare)
    return tree


def _places(tree: Any) -> Iterator[tuple[Any, Any]]:
    """Each table or list with each key in it."""
    items = tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else ()
    for key, item in list(items):
        yield tree, key
        yield from _places(item)


def _change_of_tree(draw: Draw, places: list[tuple[Any, Any]], spare: tuple[Any, ...]) -> None:
    table, key = pick(draw, places)
    old, kind = table[key], below(draw, 10)
    if kind == 0:
        del table[key]
    elif kind == 1:
        other, name = pick(draw, places)
        other[name] = deepcopy(old)
    elif kind == 2 and isinstance(table, dict):
        table[_renamed(draw, str(key))] = table.pop(key)
    elif kind == 3:
        table[key] = pick(draw, ([old], [[old]], {"x": old}, str(old), [old] * 50, {str(key): {str(key): old}}, []))
    elif kind == 4:
        for _ in range(below(draw, DEEP)):
            old = [old] if draw(st.booleans()) else {"a": old}
        table[key] = old
    elif kind == 5 and isinstance(old, str):
        table[key] = _other_quantity(draw, old)
    elif kind == 6 and spare:
        table[key] = deepcopy(pick(draw, spare))
    elif kind == 7:
        table[key] = pick(draw, NUMBERS)
    else:
        table[key] = draw(ANY_VALUE)


def _renamed(draw: Draw, key: str) -> str:
    at = below(draw, len(key) + 1)
    return pick(draw, (key[:at] + key[at + 1 :], key.upper(), f"{key}.{key}", key[:at] + pick(draw, TEXTS)))


def _other_quantity(draw: Draw, old: str) -> str:
    number, _, unit = old.partition(" ")
    units = ("mm", "m", "MPa", "GPa/m", "N/m", "deg", "%", "kg/m^3", "s", "furlong", "mPa", "Pa*m")
    numbers = ("0", "-1", "1e9", "1e-9", "1e308", "1e-320", "nan", "1e400", number + "0" * 8, f"-{number}")
    return pick(draw, (f"{pick(draw, numbers)} {unit}", f"{number} {pick(draw, units)}", pick(draw, QUANTITIES)))
