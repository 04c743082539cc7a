"""`--set key=value`, or a dict from Python: values of a scene set anew, by dotted key, before the scene is checked."""

import re
import tomllib
from collections.abc import Mapping, Sequence
from copy import deepcopy
from numbers import Number
from typing import Any

from masonry.errors import SceneError
from masonry.scene.lines import split_key
from masonry.scene.source import Source
from masonry.scene.variant import Keys, drop_rivals, forget, mark_change

Overrides = Mapping[str, Any] | Sequence[str]


def apply(source: Source, overrides: Overrides) -> None:
    """Put the overrides into the raw values of `source`. Raises SceneError for a key that leads nowhere."""
    overrides = [overrides] if isinstance(overrides, str) else overrides
    if not isinstance(overrides, Sequence | Mapping) or not all(isinstance(key, str) for key in overrides):
        raise SceneError(f"{overrides!r:.80}: give {{'key': value}} or ['key=value'], with dotted keys as texts")
    written, settings = (
        ("", dict(overrides)) if isinstance(overrides, Mapping) else ("--set ", dict(map(_split, overrides)))
    )
    keys = {}
    for key, value in settings.items():
        try:
            path = _set(source.raw, key, _value(value))
        except SceneError as error:
            raise SceneError(f"{written}{error}") from None
        keys[path] = key
        source.overridden[path] = f"{written}{key}"
        assumptions = source.raw.get("assumptions")
        if isinstance(assumptions, dict) and key in assumptions:
            assumptions[key] = f"set to {value} by the user"
    set_here = {path[:n] for path in keys for n in range(1, len(path) + 1)}
    mine = {*set_here, *(("assumptions", key) for key in settings)}
    for path in keys:
        drop_rivals(source.raw, path, mine)
        forget(source.raw, path, mine)
        mark_change(source.raw, path, mine)


def _split(text: str) -> tuple[str, str]:
    key, equals, value = text.partition("=")
    if not equals or not key.strip():
        raise SceneError(f"--set {text[:80]}: write key=value, for example --set law=linear")
    return key.strip(), value.strip()


def _value(value: Any) -> Any:
    """A TOML value where the text is one, else the text; a plain number where it is one of numpy's."""
    if not isinstance(value, str):
        of_numpy = hasattr(value, "item") and (isinstance(value, Number) or "bool" in type(value).__name__)
        return value.item() if of_numpy else deepcopy(value)
    try:
        value.encode()
        read_as_toml = tomllib.loads(f"value = {value}")
    except (ValueError, RecursionError):
        return value.encode(errors="replace").decode()
    return read_as_toml["value"] if len(read_as_toml) == 1 else value


def _set(raw: dict[str, Any], key: str, value: Any) -> Keys:
    """Put the value at the dotted key, making tables on the way; the path it took."""
    keys = split_key(key)
    if not keys or ".".join(keys) != re.sub(r"[\"'\s]", "", key):
        raise SceneError(f"{key[:80]}: not a dotted key such as contact.unit_unit.law")
    at: Any = raw
    path: Keys = ()
    for n, part in enumerate(keys):
        last = n == len(keys) - 1
        where: Any = _index(at, part, path, key) if isinstance(at, list) else part
        path += (where,)
        if last:
            at[where] = value
        elif isinstance(at, list):
            at = at[where]
        else:
            if path == ("kinematics",) and isinstance(at.get(part), str):
                at[part] = {"default": at[part]}
            at = at.setdefault(part, {})
        if not last and not isinstance(at, (dict, list)):
            raise SceneError(f"{key}: {'.'.join(map(str, path))} is a value, it has no '{keys[n + 1]}'")
    return path


def _index(items: list[Any], part: str, path: Keys, key: str) -> int:
    if part.isdecimal() and len(part) < 9 and int(part) < len(items):
        return int(part)
    listed = ", ".join(str(n) for n in range(min(len(items), 10))) or "none, the list is empty"
    raise SceneError(f"{key}: no item '{part}' in {'.'.join(map(str, path))}; items are {listed}")
