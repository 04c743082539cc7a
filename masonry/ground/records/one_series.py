"""Numbers of one record that go on from line to line, below a head that says how many they are, or from the next."""

import numpy as np

from masonry.errors import SceneError, visible
from masonry.ground.records.number_cells import number_of, numbers_of, parted
from masonry.ground.records.record_file import RecordFile

MARKS = "*#%"
"""What a line begins with behind the numbers, besides letters."""


def begins_at(lines: list[str], after: int = 0) -> int:
    """The number of the first line of numbers behind the head's last words; how many lines there are if none is one. In
    a line of numbers one may be damaged, but not the first."""
    for k, line in enumerate(lines[after:], after):
        numbers = [number_of(cell) is not None for cell in parted([line])[0]]
        if numbers and numbers[0] and 2 * sum(numbers) > len(numbers):
            return k
    return len(lines)


def series_of(name: str, what: str, lines: list[str], count: int | None, step: float | None) -> np.ndarray:
    """(n,) the numbers of lines, as many as a head says: zeros that fill the last line are left out.

    what  the format, in a message. Raises SceneError with the cell that is no number, and where some are missing.
    """
    if step is not None and step <= 0.0:
        raise SceneError(f"{name}: a step of {step:g} s is none of {what}")
    rows = parted(_before_marks(lines))
    cells = [cell for row in rows for cell in row]
    values = numbers_of(cells)
    if values is None:
        wrong = next((cell for cell in cells if number_of(cell) is None), "")
        raise SceneError(f"{name}: '{visible(wrong[:40])}' is no number of {what}")
    return as_many_as(name, values, count, len(rows[-1]) if rows else 0)


def as_many_as(name: str, values: np.ndarray, count: int | None, width: int) -> np.ndarray:
    """The samples (count,) that a head says there are, without zeros that fill a line of `width` numbers. Raises
    SceneError where they are others."""
    if count is None or count == len(values):
        return values
    if 0 < len(values) - count < width and not values[count:].any():
        return values[:count]
    raise SceneError(
        f"{name} says that it has {count} samples, and {len(values)} numbers follow: it is cut off, or a row is damaged"
    )


def series_file(name: str, values: np.ndarray, unit: str | None, step: float | None) -> RecordFile:
    """A record of one column."""
    column = "column 1" if unit is None else f"column 1 ({unit})"
    return RecordFile(name, (column,), values[:, None], step)


def _before_marks(lines: list[str]) -> list[str]:
    """Lines that are not empty, without what ends a record: words behind the last numbers."""
    lines = [line for line in lines if line.strip()]
    while lines and _is_mark(lines[-1]):
        lines.pop()
    return lines


def _is_mark(line: str) -> bool:
    text = line.strip()
    return (text[0].isalpha() or text[0] in MARKS) and any(letter.isalpha() for letter in text)
