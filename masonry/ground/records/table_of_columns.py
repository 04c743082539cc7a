"""Records as tables: times and a column a component, under a line of names, or numbers alone.

Columns are separated by commas, or by semicolons, tabs or blanks; a comma in a number is its decimal point then. Cells
may stand in quotes, and separators behind the last of them.
"""

import csv
import re
from itertools import pairwise

import numpy as np

from masonry.errors import SceneError, visible
from masonry.ground.records.line_order import goes_on_from_line_to_line
from masonry.ground.records.motion_units import is_unit
from masonry.ground.records.number_cells import number_of, numbers_of
from masonry.ground.records.one_series import as_many_as, series_file
from masonry.ground.records.record_file import SECONDS, RecordFile
from masonry.ground.records.record_head import head_of

LOOKED_AT = 1000
"""Lines that are looked at to find out what separates columns."""
SEPARATORS = (";", "\t", None, ",")
"""Of columns, in the order in which they are looked for; None stands for blanks."""
_NAMED = re.compile(r"\"[^\"]*\"|\S+(?:\s+[(\[][^()\[\]]*[)\]])?")
_WHOLE = re.compile(r"[-+]?\d+", re.ASCII)
_BRACKETED = re.compile(r"[(\[][^()\[\]]*[)\]]")
NO_THOUSANDS = "write nothing between thousands, and the decimal point alike in all numbers"


def table_of_columns(name: str, lines: list[str]) -> RecordFile:
    """Columns as they stand. Raises SceneError: one message with the file and the row."""
    separator, first = _first_numbers(name, lines)
    rows = _rows(lines[first:], separator)
    columns, rows = _columns(name, lines[:first], rows, separator)
    return RecordFile(name, tuple(columns), _numbers(name, rows, len(columns)))


def table_of_motions(name: str, lines: list[str]) -> RecordFile:
    """Columns of motions, or one record that goes on from line to line, with what the head says of it.

    Raises SceneError besides where it may be both, and where the head says another number of samples.
    """
    separator, first = _first_numbers(name, lines)
    head = head_of(name, lines[:first][-LOOKED_AT:])
    unit = head.unit if head.unit and is_unit(head.unit) else None
    columns, rows = _columns(name, lines[:first], _rows(lines[first:], separator), separator)
    if len(columns) > 1 and not any(map(_is_name, columns)):
        short = len(rows[-1]) < len(columns)
        values = _numbers(name, rows[:-1] if short else rows, len(columns))
        goes_on = goes_on_from_line_to_line(values)
        without = columns == _numbered(len(columns))
        if without and (goes_on or (goes_on is None and short)):
            more = _numbers(name, rows[-1:], len(rows[-1])).ravel() if short else np.empty(0)
            values = as_many_as(name, np.concatenate([values.ravel(), more]), head.samples, len(rows[-1]))
            return series_file(name, values, unit, head.step)
        if goes_on or (goes_on is None and without):
            have = "without names" if without else "below what may be a title or names"
            name_them = "a line of names" if without else "units in brackets behind the names"
            raise SceneError(
                f"{name} has {len(columns)} columns {have}: is it one record that goes on from line to line? Then put "
                f"'NPTS= {values.size}, DT= 0.005 SEC' above it, with its own step; else {name_them}, 'East (g)'"
            )
    values = as_many_as(name, _numbers(name, rows, len(columns)), head.samples, 0)
    return RecordFile(name, tuple(columns), values, head.step, unit)


def _columns(
    name: str, heads: list[str], rows: list[list[str]], separator: str | None
) -> tuple[list[str], list[list[str]]]:
    """Names of the columns, from the lines above the numbers, and the rows, with one that was taken for a head as it is
    damaged."""
    above = _rows([line.strip().lstrip("#%") for line in heads], separator)
    remark = bool(heads) and heads[-1].lstrip().startswith(("#", "%"))
    if above and _is_damaged(above[-1], len(rows[0])):
        rows = [above.pop(), *rows]
    width = len(rows[0])
    header = _names_and_units([cells for cells in above[-2:] if len(cells) == width])
    if header is not None:
        return header, rows
    if separator == "," and _are_halves(rows):
        raise SceneError(
            f"{name}: '{visible(','.join(rows[0])[:40])}' may be {'one number' if width == 2 else 'numbers'} with a "
            "decimal comma: write the decimal point as '.', or separate columns by ';'; name columns of whole numbers"
        )
    if above and width > 1 and separator and not remark:
        raise SceneError(f"{name}: the line above the numbers names {len(above[-1])} columns, the numbers have {width}")
    return _numbered(width), rows


def _numbered(width: int) -> list[str]:
    return [f"column {k + 1}" for k in range(width)]


def _is_name(cell: str) -> bool:
    """Whether this names a column for sure, and is no word of a title."""
    return cell.lower() in ("t", "time") or bool(_BRACKETED.search(cell)) or cell.lower().startswith("acc")


def _is_damaged(cells: list[str], width: int) -> bool:
    """Whether these are numbers, of which one is none, and no names."""
    return len(cells) == width and (_is_number(cells[0]) or any(map(_is_star, cells)))


def _are_halves(rows: list[list[str]]) -> bool:
    """Whether these may be what stands before and behind decimal commas: whole numbers, an even number of them in each
    row, of which the first are no times."""
    whole = all(len(cells) % 2 == 0 and all(map(_WHOLE.fullmatch, cells)) for cells in rows)
    return whole and not all(float(a[0]) < float(b[0]) for a, b in pairwise(rows))


def _first_numbers(name: str, lines: list[str]) -> tuple[str | None, int]:
    """Separator of the columns, the one of most of the first lines, and the number of the first line of numbers: of two
    or more, if there is one."""
    for fewest in (2, 1):
        separator = max(SEPARATORS, key=lambda candidate: _lines_of_numbers(lines[:LOOKED_AT], candidate, fewest))
        for k, line in enumerate(lines):
            cells = _cells(line, separator)
            if len(cells) >= fewest and all(map(_is_number, cells if separator is None else cells[:1])):
                return separator, k
    raise SceneError(f"{name} has no line of numbers")


def _lines_of_numbers(lines: list[str], separator: str | None, fewest: int) -> tuple[int, int]:
    """How many lines have nothing but numbers in so many columns or more, and how many begin with one."""
    rows = [cells for line in lines if len(cells := _cells(line, separator)) >= fewest]
    return sum(all(map(_is_number, cells)) for cells in rows), sum(_is_number(cells[0]) for cells in rows)


def _rows(lines: list[str], separator: str | None) -> list[list[str]]:
    """Cells of lines in which there is something, without empty ones behind the last, where all lines have them."""
    rows = [cells for line in lines if any(cells := _cells(line, separator))]
    while rows and all(len(cells) > 1 and not cells[-1] for cells in rows):
        rows = [cells[:-1] for cells in rows]
    return rows


def _cells(line: str, separator: str | None) -> list[str]:
    """Of a line, without quotes; among blanks a unit in brackets belongs to the name before it."""
    if separator is None:
        cells = _NAMED.findall(line)
    elif '"' in line:
        try:
            cells = next(csv.reader([line], delimiter=separator, skipinitialspace=True, strict=True))
        except csv.Error:  # a quote that does not end, or a cell that is too long: a message shows it as it stands
            cells = line.split(separator)
    else:
        cells = line.split(separator)
    return [_unquoted(cell.strip()) for cell in cells]


def _unquoted(cell: str) -> str:
    return cell[1:-1].strip() if len(cell) > 1 and cell[0] == cell[-1] and cell[0] in "\"'" else cell


def _point(cell: str) -> str:
    """A number with a decimal point; a comma at its end stands between two of them."""
    return cell if cell.endswith(",") else cell.replace(",", ".")


def _is_number(cell: str) -> bool:
    return number_of(_point(cell)) is not None


def _is_star(cell: str) -> bool:
    """Whether a number was too long for its place."""
    return bool(cell) and not cell.strip("*")


def _names_and_units(above: list[list[str]]) -> list[str] | None:
    """The names above the numbers; where units have a line of their own below them, both as one."""
    if len(above) < 2:
        return above[0] if above else None
    names, units = above
    if not all(not unit or _BRACKETED.fullmatch(unit) or unit in SECONDS or is_unit(unit) for unit in units):
        return units
    plain = [unit.strip("()[]").strip() for unit in units]
    return [f"{name} ({unit})" if unit else name for name, unit in zip(names, plain, strict=True)]


def _numbers(name: str, rows: list[list[str]], width: int) -> np.ndarray:
    """(n, width) finite numbers."""
    if all(len(cells) == width for cells in rows):
        values = numbers_of([_point(cell) for cells in rows for cell in cells])
        if values is not None:
            _require_one_point(name, rows)
            return values.reshape(len(rows), width)
    for k, cells in enumerate(rows):
        where = f"{name}, row {k + 1} of the numbers"
        if len(cells) != width:
            raise SceneError(f"{where}: {len(cells)} columns, where the first has {width}")
        for cell in cells:
            shown = visible(repr(cell[:40]))
            if "." in cell and "," in cell and number_of(re.sub("[.,]", "", cell)) is not None:
                raise SceneError(f"{where}: {shown} has a point and a comma: {NO_THOUSANDS}")
            if not _is_number(cell):
                raise SceneError(
                    f"{where}: {shown} is not a finite number; fill the gap, or leave out the rows before or after it"
                )
    raise SceneError(f"{name}: its numbers cannot be read")


def _require_one_point(name: str, rows: list[list[str]]) -> None:
    """SceneError where some numbers have a point and others a comma: one of them may stand between thousands."""
    comma = next((cell for cells in rows for cell in cells if "," in cell), None)
    point = None if comma is None else next((cell for cells in rows for cell in cells if "." in cell), None)
    if point is not None:
        raise SceneError(
            f"{name} has '{visible(point[:40])}' with a point and '{visible(str(comma)[:40])}' with a comma: "
            f"{NO_THOUSANDS}"
        )
