"""Pydantic's findings -> one message for the user: file and line, key, what is wrong, the nearest valid choice."""

import re
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from masonry.errors import Faults, SceneError, closest
from masonry.quantity import KINDS, written
from masonry.scene.checked import SceneData
from masonry.scene.lines import split_key
from masonry.scene.source import Source
from masonry.scene.tables.law_keys import contact_class
from masonry.scene.tables.specimen import TABLES
from masonry.scene.tables.types import Given, KeyedError
from masonry.scene.variant import Keys

MOST = 5
OWN_BLOCKS = "blocks of another shape: kind = 'file', which masonry.write_blocks writes"
HIDDEN = {"exponent_shear_table"}
UNKNOWN = ("extra_forbidden", "unexpected_keyword_argument")
MISSING = ("missing", "missing_argument")
QUOTED = r"'([^']+)'"
HINTS = {
    "law": "name the law here or once at the top of the file: law = 'exponential'",
    "specimen": f"give a table [specimen] with a kind: {', '.join(TABLES)}",
    "material": "give a table [material.units] with a density",
    "contact": "give a table [contact.unit_unit] with stiffnesses and strengths",
}
_NO_TABLE = "must be a table, not {shown}"
PLAIN = {
    "model_type": _NO_TABLE,
    "model_attributes_type": _NO_TABLE,
    "dict_type": _NO_TABLE,
    "arguments_type": _NO_TABLE,
    "tuple_type": "must be a list or, for tables, stand in double brackets [[{name}]]; not {shown}",
    "too_short": "must have {min_length} or more items, not {actual_length}",
    "string_too_long": "must have no more than {max_length} letters",
    "too_long": "must have no more than {max_length} items",
    "bool_type": "must be true or false, not {shown}",
    "string_type": "must be a text in quotes, not {shown}",
    "string_too_short": "must not be empty",
    "string_pattern_mismatch": "must be a name without a slash, not {shown}",
}


def explain(error: ValidationError, source: Source) -> SceneError:
    """One error for all findings, the first few in full."""
    findings = _without_echoes(error.errors(include_url=False))
    lines = [_line(messages, source) for messages in findings[:MOST]]
    more = [f"... and {len(findings) - MOST} more"] if len(findings) > MOST else []
    messages = lines + more
    return Faults(messages) if len(messages) > 1 else SceneError(*messages)


def _without_echoes(findings: list[ErrorDetails]) -> list[ErrorDetails]:
    """A misspelt key is one mistake, and the key that is missing for it is not told as well; nor is a list short of
    items because some of them are wrong."""
    within = {error["loc"][:n] for error in findings for n in range(1, len(error["loc"]))}
    findings = [error for error in findings if error["type"] != "too_short" or error["loc"] not in within]
    missing = {error["loc"]: error for error in findings if error["type"] in MISSING}
    unknown = [error["loc"] for error in findings if error["type"] in UNKNOWN][:100]
    for *table, name in unknown:
        names = [str(key) for *others, key in missing if others == table]
        if nearest := closest(str(name), names, 0.5):
            del missing[(*table, nearest)]
    return [error for error in findings if error["type"] not in MISSING or error["loc"] in missing]


def _line(error: ErrorDetails, source: Source) -> str:
    loc: Keys = tuple(error["loc"])
    cause = error.get("ctx", {}).get("error")
    if isinstance(cause, KeyedError):
        loc += tuple(split_key(cause.key))
    if error["type"].startswith("union_tag"):
        loc += ("kind",)
    path = _in_file(loc, source.raw)
    place = source.place(path)
    key = ".".join(str(part)[:80] for part in path)
    text = _text(error, loc, str(path[-1]) if path else "", source.raw)
    return f"{place}: {text}" if place in (key, f"--set {key}") else f"{place}: {key}: {text}"


def _in_file(loc: Keys, raw: Any) -> Keys:
    """The path as the file has it: without pydantic's own steps, and ending where the file ends."""
    path: Keys = ()
    if len(loc) > 1 and loc[0] == "specimen" and loc[1] in TABLES:
        loc = (loc[0], *loc[2:])
    for part in loc:
        if not isinstance(raw, (dict, list)) or part == "[key]":
            break
        if isinstance(raw, dict) and isinstance(part, int):  # one table, where there may be several
            continue
        path += (part,)
        below = raw.get(part) if isinstance(raw, dict) else None
        raw = raw[part] if isinstance(raw, list) and isinstance(part, int) and part < len(raw) else below
        raw = {} if raw is None else raw
    return path


def _text(error: ErrorDetails, loc: Keys, name: str, raw: Any) -> str:
    kind, shown, ctx = error["type"], f"{str(error['input'])[:60]!r}", error.get("ctx", {})
    if kind == "value_error":
        return str(ctx["error"])
    if kind in UNKNOWN:
        there = _elsewhere(name, raw) if len(loc) == 1 else []
        if there:
            return f"not a key of the whole scene; did you mean {' or '.join(map(repr, there[:MOST]))}?"
        return f"unknown key; {_choice(name, list(_fields(loc, raw)))}"
    if kind in MISSING:
        return f"missing{_hint(loc, name, raw)}"
    if kind == "union_tag_not_found":
        return f"missing; allowed: {', '.join(TABLES)}"
    if kind == "union_tag_invalid":
        return f"'{ctx['tag'][:60]}' is not allowed; {_choice(ctx['tag'], list(TABLES))}; {OWN_BLOCKS}"
    if kind == "literal_error":
        return f"{shown} is not allowed; {_choice(shown, re.findall(QUOTED, ctx['expected']))}"
    return PLAIN[kind].format(shown=shown, name=name, **ctx) if kind in PLAIN else error["msg"][:200]


def _hint(loc: Keys, name: str, raw: Any) -> str:
    if name in HINTS:
        return f"; {HINTS[name]}"
    field = _fields(loc, raw).get(name)
    quantity = next((mark for mark in getattr(field, "metadata", ()) if isinstance(mark, Given)), None)
    return f"; {name} is {KINDS[quantity.kind].words}, for example {written(quantity.kind)}" if quantity else ""


def _elsewhere(name: str, raw: Any) -> list[str]:
    """The keys of this name that stand in a table, dotted: of tables that are there, if any; of several groups those
    that have it already."""
    places = []
    for table in SceneData.model_fields:
        below = raw.get(table)
        if table in ("contact", "material"):
            groups = (
                [group for group, keys in below.items() if isinstance(keys, dict)] if isinstance(below, dict) else []
            )
            groups = [group for group in groups if name in _fields((table, group, name), raw)]
            places += [f"{table}.{group}.{name}" for group in [g for g in groups if name in below[g]] or groups]
            continue
        kind = below.get("kind") if isinstance(below, dict) else None
        inside = (table, str(kind), name) if table == "specimen" else (table, name)
        number = ("0",) if isinstance(below, list) else ()
        if name in _fields(inside, raw):
            places.append(".".join((table, *number, name)))
    there = [key for key in places if key.partition(".")[0] in raw]
    return there or places


def _choice(name: str, allowed: list[str]) -> str:
    nearest = closest(name, allowed, 0.5)
    return (f"did you mean '{nearest}'? " if nearest else "") + f"allowed: {', '.join(allowed)}"


def _fields(loc: Keys, raw: Any) -> dict[str, Any]:
    """The keys, with pydantic's knowledge of each, that the table around the last part of `loc` may hold."""
    model: Any = SceneData
    choices: list[Any] = []
    for n, part in enumerate(loc[:-1]):
        if part in _keys(model):
            choices = _tables(_keys(model)[part].annotation)
            model = choices[0] if choices else model
        else:
            model = next((m for m in choices if part in _kinds(m)), getattr(model, "ANY", model))
        model = _outside(model, loc[: n + 1], raw)
    return {key: field for key, field in _keys(model).items() if key not in HIDDEN}


def _outside(model: Any, path: Keys, raw: Any) -> Any:
    """The table of a law of another package, where the scene names one there."""
    if len(path) == 2 and path[0] == "contact" and isinstance(table := raw["contact"].get(path[1]), dict):
        return contact_class(table.get("law", raw.get("law")), ())
    return model


def _keys(model: Any) -> dict[Any, Any]:
    return model.model_fields if hasattr(model, "model_fields") else dict.fromkeys(model._fields)


def _kinds(model: Any) -> tuple[str, ...]:
    """("couplet",) for a specimen, nothing for any other table."""
    kind = getattr(model, "model_fields", {}).get("kind")
    return get_args(kind.annotation) if kind else ()


def _tables(annotation: Any) -> list[Any]:
    """Every table inside a type such as dict[str, Contact] | None: a model, or a named tuple of directions."""
    if isinstance(annotation, type) and (issubclass(annotation, BaseModel) or hasattr(annotation, "_fields")):
        return [annotation]
    return [table for inner in get_args(annotation) for table in _tables(inner)]
