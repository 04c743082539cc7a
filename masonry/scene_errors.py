"""Pydantic's findings -> one message for the user: file and line, key, what is wrong, the nearest valid choice."""

import difflib
import re
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from masonry.errors import SceneError
from masonry.scene_schema import Scene
from masonry.scene_source import Keys, Source, split_key
from masonry.scene_types import KeyedError

MOST = 5
HIDDEN = {"exponent_shear_table"}


def explain(error: ValidationError, source: Source) -> SceneError:
    """One error for all findings, the first few in full."""
    lines = list(dict.fromkeys(_line(found, source) for found in error.errors(include_url=False)))
    more = [f"... and {len(lines) - MOST} more"] if len(lines) > MOST else []
    return SceneError("\n".join(lines[:MOST] + more))


def _line(found: ErrorDetails, source: Source) -> str:
    loc: Keys = tuple(found["loc"])
    cause = found.get("ctx", {}).get("error")
    if isinstance(cause, KeyedError):
        loc += tuple(split_key(cause.key))
    path = _in_file(loc, source.raw)
    place = source.place(path)
    key = ".".join(str(part)[:80] for part in path)
    text = _text(found, loc, str(path[-1]) if path else "")
    return f"{place}: {key}: {text}" if key else f"{place}: {text}"


def _in_file(loc: Keys, raw: Any) -> Keys:
    """The path as the file has it: without pydantic's own steps, and ending where the file ends."""
    path: Keys = ()
    if len(loc) > 1 and loc[0] == "specimen" and loc[1] in ("couplet", "wallette", "boxes"):
        loc = (loc[0], *loc[2:])
    for part in loc:
        if not isinstance(raw, (dict, list)) or part == "[key]":
            break
        path += (part,)
        below = raw.get(part) if isinstance(raw, dict) else None
        raw = raw[part] if isinstance(raw, list) and isinstance(part, int) and part < len(raw) else below
        raw = {} if raw is None else raw
    return path


def _text(found: ErrorDetails, loc: Keys, name: str) -> str:
    kind, value = found["type"], found["input"]
    if kind == "value_error":
        return str(found["ctx"]["error"])
    if kind in ("extra_forbidden", "unexpected_keyword_argument"):
        return f"unknown key; {_choice(name, _fields(loc))}"
    if kind == "union_tag_not_found":
        return "missing kind; allowed: couplet, wallette, boxes"
    if kind in ("missing", "missing_argument"):
        return _missing(name)
    if kind in ("literal_error", "union_tag_invalid"):
        expected = re.findall(r"'([^']+)'", found["ctx"].get("expected") or found["ctx"].get("expected_tags", ""))
        return f"{str(value)[:60]!r} is not allowed; {_choice(_tag(value), expected)}"
    if kind in ("model_type", "model_attributes_type", "dict_type", "arguments_type"):
        return f"must be a table, not {str(value)[:60]!r}"
    if kind == "string_type":
        return f"must be a text in quotes, not {str(value)[:60]!r}"
    if kind == "string_too_short":
        return "must not be empty"
    if kind == "tuple_type":
        return f"must be a list, or tables with double brackets [[{name}]], not {str(value)[:60]!r}"
    return found["msg"][:200]


def _tag(value: Any) -> str:
    return str(value.get("kind")) if isinstance(value, dict) else str(value)


def _missing(name: str) -> str:
    hints = {
        "law": "missing; name the law here or once at the top of the file: law = 'exponential'",
        "specimen": "missing table; give [specimen] with kind = 'couplet', 'wallette' or 'boxes'",
        "material": "missing table; give [material.units] with a density",
        "contact": "missing table; give [contact.unit_unit] with stiffnesses and strengths",
    }
    return hints.get(name, "missing")


def _choice(name: str, allowed: list[str]) -> str:
    nearest = difflib.get_close_matches(name[:80], allowed, 1, 0.5)
    return (f"did you mean '{nearest[0]}'? " if nearest else "") + f"allowed: {', '.join(allowed)}"


def _fields(loc: Keys) -> list[str]:
    """The keys that the table around the last part of `loc` may hold."""
    model: Any = Scene
    choices: list[Any] = []
    for part in loc[:-1]:
        if part in _keys(model):
            choices = _tables(model.model_fields[part].annotation)
            model = choices[0] if choices else model
        else:
            model = next((m for m in choices if part in _kinds(m)), model)
    return [key for key in _keys(model) if key not in HIDDEN]


def _keys(model: Any) -> list[str]:
    return list(model.model_fields if hasattr(model, "model_fields") else model._fields)


def _kinds(model: Any) -> tuple[str, ...]:
    """("couplet",) for a specimen, nothing for any other table."""
    kind = getattr(model, "model_fields", {}).get("kind")
    return get_args(kind.annotation) if kind else ()


def _tables(annotation: Any) -> list[Any]:
    """Every table inside a type such as dict[str, Contact] | None: a model, or a named tuple of directions."""
    if isinstance(annotation, type) and (issubclass(annotation, BaseModel) or hasattr(annotation, "_fields")):
        return [annotation]
    return [table for inner in get_args(annotation) for table in _tables(inner)]
