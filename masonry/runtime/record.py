"""Dataclasses that are also read by name: what a run leaves behind in numbers and words, as a table of a JSON file."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import Field, field, fields
from typing import Any, ClassVar, Self


class Record(Mapping[str, Any]):
    """Base of frozen dataclasses with a default for each field: `record.steps` is `record["steps"]`, `dict(record)` a
    table of all fields, and `record | {"steps": 3}` another record. None is what was not measured.
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
        return self.read({**self, **changes})

    @classmethod
    def read(cls, table: Mapping[str, Any]) -> Self:
        """The record of a table: what is missing there, or no record, is None; other keys are left out."""
        read = {entry.name: entry.metadata.get("read", _as_it_is) for entry in fields(cls)}
        return cls(**{name: read[name](table[name]) for name in read if name in table})


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
