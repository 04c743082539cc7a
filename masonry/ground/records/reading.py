"""A record of the ground from a file, in any of the formats that are known."""

from pathlib import Path

from masonry.errors import SceneError
from masonry.ground.records.dyna import dyna
from masonry.ground.records.foreign_formats import native_format, require_own
from masonry.ground.records.knet import knet
from masonry.ground.records.peer import peer
from masonry.ground.records.record_file import RecordFile
from masonry.ground.records.table_of_columns import table_of_columns, table_of_motions
from masonry.runtime.text_files import text_of

LARGEST = 200_000_000
"""Bytes of a file."""
LONGEST_LINE = 200_000
"""Letters of a line."""
FORMATS = (knet, dyna, peer)
"""Each returns None where a file is not its own."""


def read_record(path: Path) -> RecordFile:
    """The motions that a file holds. Raises SceneError: one message with the file and the row."""
    name, lines = _lines_of(path)
    require_own(name, lines)
    for read in FORMATS:
        if (record := read(name, lines)) is not None:
            return record
    return table_of_motions(name, lines)


def read_columns(path: Path) -> RecordFile:
    """The columns of a table of any quantities. Raises SceneError: one message with the file and the row."""
    return table_of_columns(*_lines_of(path))


def _lines_of(path: Path) -> tuple[str, list[str]]:
    """The name of a file, in quotes, and its lines."""
    name = f"'{path.name}'"
    try:
        lines = text_of(path, LARGEST).splitlines()
    except SceneError:
        if path.is_file() and (says := native_format(path)) is not None:
            raise SceneError(f"{name} {says}") from None
        raise
    long = next((k for k, line in enumerate(lines) if len(line) > LONGEST_LINE), None)
    if long is not None:
        raise SceneError(f"{name}, line {long + 1}: {len(lines[long])} letters; at most {LONGEST_LINE} are allowed")
    return name, lines
