"""One scene on top of another, `base = "couplet"` and the keys that differ; and keys that exclude each other."""

import re
from collections.abc import Container, Iterator
from copy import deepcopy
from typing import Any

Keys = tuple[str | int, ...]
CHANGED = re.compile(r" \(before a change of ([^()]*)\)$")
"""How an assumption about a table ends of which keys were changed."""
RIVALS = (
    {"accuracy", "rate", "steps"},
    {"displacement", "history"},
    {"tilt", "history"},
    {"friction_angle", "tan_friction_angle"},
    {"residual_friction_angle", "tan_residual_friction_angle"},
    {"points_per_edge", "points_per_face", "contact_spacing"},
    {"divisions", "cells"},
    {"total", "per_unit", "size"},
    {"scale", "peak"},
    {"rows", "sampling"},
    {"record", "made"},
    {"radius", "span"},
    {"angle", "rise"},
    {"position", "between"},
)

LIMITS = ("rotation_limit", "slip_limit")
"""Keys of [solver] at which a run of small displacements stops."""
ENDS: dict[Keys, tuple[str, ...]] = {("displacements", "large"): LIMITS}
"""Keys of [solver] that end with a value of a key."""


def overlay(below: dict[str, Any], above: dict[str, Any]) -> dict[str, Any]:
    """Raw values of a scene with those of another on top: tables are merged, lists and values replaced.

    A key takes the place of its rivals, a specimen of another kind that of the whole specimen. An assumption about what
    was replaced goes with it, one about a table around it says what was changed.
    """
    merged = deepcopy(below)
    if _kind(above) not in (None, _kind(below)):
        merged.pop("specimen", None)
        forget(merged, ("specimen",), ())
    paths = list(leaves(above))
    _put(merged, above)
    keys = {path[:n] for path in paths for n in range(1, len(path) + 1)}
    for path in paths:
        if path[0] != "assumptions":
            drop_rivals(merged, path, keys)
            forget(merged, path, keys)
            mark_change(merged, path, keys)
    return merged


def _kind(raw: dict[str, Any]) -> Any:
    """Which specimen a scene names, if it names one."""
    specimen = raw.get("specimen")
    return specimen.get("kind") if isinstance(specimen, dict) else None


def drop_rivals(raw: dict[str, Any], path: Keys, keys: Container[Keys]) -> None:
    """Removal of the rivals of the keys that stand at `path`, and of what was assumed of them.

    The duration of an expression goes with it, and with large displacement go the limits of small ones.
    """
    table: Any = raw
    part: Any
    for n, part in enumerate(path):
        for rival in {key for rivals in RIVALS if part in rivals for key in rivals - {part}}:
            at = (*path[:n], rival)
            _drop(raw, table, at, keys)
        listed = part == "history" and isinstance(table, dict) and _is_list(table.get(part))
        if isinstance(table, dict) and isinstance(value := table.get(part), str):
            for key in ENDS.get((*path[: n + 1], value), ()):
                _drop(raw, raw.get("solver"), ("solver", key), keys)
        if part in ("displacement", "tilt") or listed:
            _drop(raw, table, (*path[:n], "duration"), keys)
        try:
            table = table[part] if isinstance(table, dict | list) else {}
        except (KeyError, IndexError, TypeError):  # what stands above it was set as well, later
            return


def _drop(raw: dict[str, Any], table: Any, at: Keys, keys: Container[Keys]) -> None:
    """Take the key at the end of `at` out of its table, unless it is among the new keys."""
    if isinstance(table, dict) and at[-1] in table and at not in keys:
        del table[at[-1]]
        forget(raw, at, keys)


def _is_list(value: Any) -> bool:
    """Whether a history has times of its own, or none: a `duration` belongs to an expression."""
    return isinstance(value, list | tuple)


def _put(table: dict[str, Any], above: dict[str, Any]) -> None:
    for key, value in above.items():
        if isinstance(value, dict) and isinstance(table.get(key), dict):
            _put(table[key], value)
        else:
            table[key] = deepcopy(value)


def leaves(table: dict[str, Any], path: Keys = ()) -> Iterator[Keys]:
    """The path of every value that is not a table."""
    for key, value in table.items():
        if isinstance(value, dict) and value:
            yield from leaves(value, (*path, key))
        else:
            yield (*path, key)


def forget(raw: dict[str, Any], path: Keys, keys: Container[Keys]) -> None:
    """Drop assumptions about a key, or about parts of it, that are not among the new keys."""
    assumptions, dotted = raw.get("assumptions"), ".".join(map(str, path))
    if isinstance(assumptions, dict):
        for key in list(assumptions):
            if (key == dotted or key.startswith(f"{dotted}.")) and ("assumptions", key) not in keys:
                del assumptions[key]


def mark_change(raw: dict[str, Any], path: Keys, keys: Container[Keys]) -> None:
    """Say of assumptions about tables around a new key, unless they are new as well, that they are older than it."""
    assumptions, dotted = raw.get("assumptions"), ".".join(map(str, path))
    if not isinstance(assumptions, dict):
        return
    for table, text in assumptions.items():
        if dotted.startswith(f"{table}.") and ("assumptions", table) not in keys and isinstance(text, str):
            before = CHANGED.search(text)
            names = dict.fromkeys([*(before[1].split(", ") if before else []), dotted.removeprefix(f"{table}.")])
            assumptions[table] = f"{CHANGED.sub('', text)} (before a change of {', '.join(names)})"
