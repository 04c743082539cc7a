"""Which line of a TOML text each key stands in: the reader does not say, and messages should."""

import re

from masonry.scene.variant import Keys

_KEY = r"(?:[A-Za-z0-9_-]+|\"[^\"]*\"|'[^']*')"
_KEYS = rf"{_KEY}(?:\s*\.\s*{_KEY})*"
_HEADER = re.compile(rf"\s*(\[\[?)\s*({_KEYS})\s*\]")
_ASSIGNMENT = re.compile(rf"\s*({_KEYS})\s*=")


def split_key(text: str) -> list[str]:
    """'a."b.c".0' -> ['a', 'b.c', '0']."""
    return [part.strip("\"'") for part in re.findall(_KEY, text)]


def line_numbers(text: str) -> dict[Keys, int]:
    """Line number of every table header and key that starts a line."""
    numbers: dict[Keys, int] = {}
    count: dict[Keys, int] = {}

    def full(keys: list[str]) -> Keys:
        path: Keys = ()
        for key in keys:
            path += (key,)
            path += (count[path],) if path in count else ()
        return path

    table: Keys = ()
    open_text = ""
    for number, line in enumerate(text.split("\n"), start=1):
        if open_text:
            open_text = "" if open_text in line else open_text
            continue
        open_text = next((quotes for quotes in ('"""', "'''") if line.count(quotes) % 2), "")
        if header := _HEADER.match(line):
            keys = split_key(header[2])
            if header[1] == "[[":
                array = (*full(keys[:-1]), keys[-1])
                count[array] = count.get(array, -1) + 1
            table = full(keys)
            for n in range(1, len(table) + 1):
                numbers.setdefault(table[:n], number)
        elif assignment := _ASSIGNMENT.match(line):
            keys = split_key(assignment[1])
            for n in range(1, len(keys) + 1):
                numbers.setdefault((*table, *keys[:n]), number)
    return numbers
