"""Dataclasses that are also read by name: what a run leaves behind in numbers and words, as a table of a JSON file."""

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import Field, asdict, field, fields
from types import NoneType, UnionType
from typing import Any, ClassVar, Self, get_args, get_origin, get_type_hints

from masonry.errors import SceneError, nearest, visible

WORDS = {bool: "true or false", int: "a whole number", float: "a number", str: "text", list: "a list", dict: "a table"}
"""The types of values in a JSON file, for messages."""
LONGEST = 40
"""Letters of a wrong value in a message."""


class Record(Mapping[str, Any]):
    """Base of frozen dataclasses with a default for each field: `record.steps` is `record["steps"]`, `dict(record)` a
    table of all fields, `record.copy()` one that JSON can hold and that may be changed, and `record | {"steps": 3}`
    another record. None is what was not measured.
    """

    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]

    def __getitem__(self, name: str) -> Any:
        if name not in self.__dataclass_fields__:
            raise KeyError(name)
        return getattr(self, name)

    def __iter__(self) -> Iterator[str]:
        return iter(self.__dataclass_fields__)

    def __len__(self) -> int:
        return len(self.__dataclass_fields__)

    def __or__(self, changes: Mapping[str, Any]) -> Self:
        if unknown := [name for name in changes if name not in self.__dataclass_fields__]:
            known = nearest(str(unknown[0]), self.__dataclass_fields__)
            raise SceneError(f"{type(self).__name__} has no key '{unknown[0]}'; {known}")
        return self.read({**self, **changes})

    def __ror__(self, table: Mapping[str, Any]) -> dict[str, Any]:
        return {**table, **self}

    def copy(self) -> dict[str, Any]:
        """A table of all fields, and of those of the records in them."""
        return asdict(self)

    @classmethod
    def read(cls, table: Mapping[str, Any]) -> Self:
        """The record of a table: what is missing there, or no record, is None; other keys are left out."""
        read = {entry.name: entry.metadata.get("read", _as_it_is) for entry in fields(cls)}
        return cls(**{name: read[name](table[name]) for name in read if name in table})

    @classmethod
    def require(cls, table: Any, name: str) -> None:
        """Raise SceneError where a value in the table has another type than its field: its key, what it is, and what is
        allowed. Whole numbers are numbers; keys of no field are not looked at. `name` is that of the file."""
        if wrong := _wrong(table, cls, ""):
            raise SceneError(f"{name} is damaged: {wrong}; run the scene again")


def one_of(kind: type[Record]) -> Any:
    """A field that holds a record or None."""
    return field(default=None, metadata={"read": _reader(kind)})


def table_of(kind: type[Record]) -> Any:
    """A field that holds a table of records by name, or None."""
    read = _reader(kind)
    return field(default=None, metadata={"read": lambda table: _each(read, table)})


def list_of(kind: type[Record]) -> Any:
    """A field that holds a list of records, or None."""
    read = _reader(kind)
    return field(default=None, metadata={"read": lambda rows: _rows(read, rows)})


def _reader(kind: type[Record]) -> Callable[[Any], Any]:
    return lambda value: kind.read(value) if isinstance(value, Mapping) else None


def _each(read: Callable[[Any], Any], table: Any) -> Any:
    if not isinstance(table, Mapping):
        return None
    return {name: read(value) for name, value in table.items() if isinstance(value, Mapping)}


def _rows(read: Callable[[Any], Any], rows: Any) -> Any:
    return [read(row) for row in rows if isinstance(row, Mapping)] if isinstance(rows, list) else None


def _as_it_is(value: Any) -> Any:
    return value


def _wrong(value: Any, kind: Any, key: str) -> str:
    """Part of a value that is not of its type, in words; "" where all of it is."""
    kinds = get_args(kind) if isinstance(kind, UnionType) else (kind,)
    if Any in kinds or (value is None and NoneType in kinds):
        return ""
    kinds = tuple(option for option in kinds if option is not NoneType)
    for option in kinds:
        if _is(value, _base(option)):
            return next(filter(None, (_wrong(*part) for part in _parts(value, option, key))), "")
    what = visible(json.dumps(value))
    short = what if len(what) <= LONGEST else f"{what[:LONGEST]}..."
    allowed = " or ".join(WORDS[_base(option)] for option in kinds)
    return f"{key} is {short}, allowed: {allowed}" if key else f"it is {short}, allowed: {allowed}"


def _base(kind: Any) -> type:
    """The type of JSON of a type: a record is a table."""
    return kind if kind in WORDS else list if get_origin(kind) is list else dict


def _is(value: Any, base: type) -> bool:
    """Whether a value is of a type of JSON; true and false are no numbers."""
    if isinstance(value, bool):
        return base is bool
    return isinstance(value, (int, float) if base is float else base)


def _parts(value: Any, kind: Any, key: str) -> Iterator[tuple[Any, Any, str]]:
    """Elements of a list or a table, each with its type and its key."""
    inner = get_args(kind)
    if isinstance(value, list):
        yield from ((element, inner[0], f"{key}.{number}") for number, element in enumerate(value))
    elif isinstance(value, dict):
        hints = {} if inner else get_type_hints(kind)
        for name, element in value.items():
            yield element, inner[1] if inner else hints.get(name, Any), f"{key}.{name}".lstrip(".")
