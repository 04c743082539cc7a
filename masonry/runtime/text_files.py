"""Text files from people and other programs: plain files of a limited size, UTF-8, TOML or JSON of a limited depth.

Whatever is wrong is a SceneError; of what stands in the file no more is repeated than the letter where reading stops.
"""

import json
import math
import os
import re
import tomllib
from pathlib import Path
from typing import Any

from geometry.errors import GeometryError
from geometry.files.atomic import require_file
from masonry.errors import SceneError

NESTED = 32
"""Tables within tables; a scene has five."""
JSON_LARGEST = 100_000_000
"""Bytes of a JSON file; a record or a summary has a thousand."""
MOST_DIGITS = 18
"""Of a whole number in JSON: what fits into 64 bits."""
NO_BACK_SLASH = "a back slash begins an escape in double quotes: write '/' between folders"
_NESTED_KEY = re.compile(rf"(?<![\w\"'-])(?:[\w\"'-]+[ \t]*\.[ \t]*){{{NESTED}}}")
_BARE_QUANTITY = re.compile(r"=\s*([-+]?[\d.]+(?:[eE][-+]?\d+)? ?[A-Za-z][\w/^*]*)\s*(?:#.*)?$")


def text_of(path: Path, largest: int) -> str:
    """The text of a plain file. Raises SceneError where it is none, is empty, has more bytes, or is not UTF-8."""
    try:
        require_file(path, largest)
        with open(path, "rb", opener=_at_once) as file:
            data = file.read(largest + 1)
    except GeometryError as error:
        raise SceneError(str(error)) from None
    except OSError as error:
        raise SceneError(f"'{path}' cannot be read: {error.strerror or error}") from None
    return decoded(data, str(path))


def decoded(data: bytes, name: str) -> str:
    """UTF-8, with or without a mark of the byte order. Raises SceneError with the line that is not."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise SceneError(f"{name}, line {line}: not UTF-8 text; save the file as UTF-8") from None


def _at_once(path: str, flags: int) -> int:
    """A file that would keep its reader waiting says so instead."""
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


def toml_of(text: str, name: str, what: str = "a scene") -> dict[str, Any]:
    """The tables of a TOML text. Raises SceneError with the line; `name` is the file's, `what` it should be."""
    too_deep = SceneError(f"{name}: not {what}: tables nested too deeply")
    if _NESTED_KEY.search(text):  # their reader takes time that grows with the square of the depth
        raise too_deep
    try:
        raw = tomllib.loads(text)
    except RecursionError:
        raise too_deep from None
    except ValueError as error:  # tomllib's own, and Python's limit on the digits of a number
        hint, line = "", re.search(r"at line (\d+)", str(error))
        if line and (bare := _BARE_QUANTITY.search(text.split("\n")[int(line[1]) - 1][:200].rstrip())):
            hint = f"; a quantity stands in quotes: '{bare[1]}'"
        elif line and "\\" in text.split("\n")[int(line[1]) - 1]:
            hint = f"; {NO_BACK_SLASH}"
        raise SceneError(f"{name}: not valid TOML: {f'{error}'[:300]}{hint}") from None
    if _is_deeper(raw, NESTED):
        raise too_deep
    return raw


def json_of(path: Path, largest: int = JSON_LARGEST) -> Any:
    """Content of a JSON file. Raises SceneError."""
    return json_in(text_of(path, largest), f"'{path}'")


def json_in(text: str, name: str) -> Any:
    """Content of a JSON text: numbers are finite and fit into 64 bits. Raises SceneError; `name` is the file's."""
    try:
        return json.loads(text, parse_float=_finite, parse_int=_whole, parse_constant=_finite)
    except RecursionError:
        raise SceneError(f"{name}: lists or tables nested too deeply") from None
    except ValueError as error:
        raise SceneError(f"{name} is not JSON: {f'{error}'[:200]}") from None


def _finite(digits: str) -> float:
    number = float(digits)
    if not math.isfinite(number):
        raise ValueError(f"{digits[:20]} is not a finite number")
    return number


def _whole(digits: str) -> int:
    if len(digits) > MOST_DIGITS:
        raise ValueError(f"{digits[:20]}... is too large a number")
    return int(digits)


def _is_deeper(raw: Any, depth: int) -> bool:
    level: list[Any] = [raw]
    for _ in range(depth):
        level = [part for value in level for part in (value.values() if isinstance(value, dict) else value)]
        level = [part for part in level if isinstance(part, (dict, list))]
        if not level:
            return False
    return True
