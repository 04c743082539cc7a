"""The text of a Neper .tess file, read once from front to back: its sections as flat arrays of numbers, lines known.

Only what blocks are made of is kept; seeds, orientations, the domain and periodicity are passed over.
"""

from array import array
from pathlib import Path

import numpy as np

from geometry.blocks import GeometryError
from geometry.files.atomic import require_file

LARGEST = 2**28
"""Bytes of a file that is read: about 100,000 cells."""
LONGEST_LINE = 2**20
WORDS = ("format", "general")
NUMBERS = ("cell", "cell.id", "cell.group", "vertex", "edge", "face", "polyhedron")


class TessSection:
    """The numbers of one section, taken from front to back; complaints name the line."""

    def __init__(self, path: Path, name: str, line: int) -> None:
        self.path, self.name, self.line = path, name, line
        self.words: list[str] = []
        self._numbers = array("d")
        self._ends, self._lines = array("q"), array("q")
        self.place = 0

    def add(self, line: int, text: str) -> None:
        """Take in one line of the file."""
        if self.name in WORDS:
            self.words += text.split()[: 16 - len(self.words)]
            return
        try:
            self._numbers.extend([float(word) for word in text.split()])
        except ValueError:
            word = next(w for w in text.split() if not _is_number(w))
            raise GeometryError(f"'{self.path}', line {line}: {word[:20]!r} is no number (**{self.name})") from None
        self._ends.append(len(self._numbers))
        self._lines.append(line)

    @property
    def left(self) -> int:
        """Numbers that have not been taken yet."""
        return len(self._numbers) - self.place

    def count(self) -> int:
        """The next number as a number of things, no more than the section can hold."""
        value = self.whole(1)[0]
        if not 0 <= value <= self.left:
            raise self.error(f"{value} entries are announced, the section has only {self.left} more numbers", back=1)
        return int(value)

    def whole(self, count: int) -> np.ndarray:
        """The next whole numbers (count,)."""
        values = self.real(count)
        whole = (values == np.floor(values)) & (np.abs(values) < 2**53)
        if not whole.all():
            first = int(np.argmin(whole))
            raise self.error(f"{values[first]:g} must be a whole number", back=count - first)
        return values.astype(np.int64)

    def real(self, count: int) -> np.ndarray:
        """The next numbers (count,), all finite."""
        if count > self.left:
            raise self.error(f"{count} numbers are expected here, {self.left} are left")
        if count == 0:
            return np.zeros(0)
        values = np.frombuffer(self._numbers)[self.place : self.place + count]
        self.place += count
        if not np.isfinite(values).all():
            raise self.error("a number is not finite", back=count - int(np.argmin(np.isfinite(values))))
        return values

    def error(self, what: str, back: int = 0) -> GeometryError:
        """A complaint about the number that was taken `back` numbers ago."""
        at = int(np.searchsorted(self._ends, self.place - back, side="right"))
        line = self._lines[min(at, len(self._lines) - 1)] if self._lines else self.line
        return GeometryError(f"'{self.path}', line {line}: {what} (**{self.name})")


def read_sections(path: Path) -> dict[str, TessSection]:
    """Sections that blocks are made of, by name ("cell.id" is *id within **cell); GeometryError for another file."""
    require_file(path, LARGEST)
    sections: dict[str, TessSection] = {}
    section: TessSection | None = None
    top, number, ended = "", 0, False
    with open(path, encoding="ascii", errors="replace") as file:
        while text := file.readline(LONGEST_LINE):
            number += 1
            if len(text) == LONGEST_LINE:
                raise GeometryError(f"'{path}', line {number}: the line is longer than {LONGEST_LINE} letters")
            word = text.strip()
            if number == 1 and word != "***tess":
                raise GeometryError(f"'{path}' is no tessellation: line 1 must be '***tess'")
            if word == "***end":
                ended = True
                break
            if word.startswith("*"):
                top, section = _open(path, number, word, top, sections)
            elif section is not None and word:
                section.add(number, word)
    if not ended:
        raise GeometryError(
            f"'{path}', line {number}: the file ends without '***end'; it is damaged, or still being written"
        )
    return sections


def _open(
    path: Path, number: int, word: str, top: str, sections: dict[str, TessSection]
) -> tuple[str, TessSection | None]:
    """The section that a line with stars begins, or None if it is passed over."""
    if word.startswith("***"):
        return "", None
    name = word.lstrip("*")
    if word.startswith("**"):
        top = name
    else:
        name = f"{top}.{name}"
    if name not in WORDS + NUMBERS:
        return top, None
    if name in sections:
        raise GeometryError(f"'{path}', line {number}: a second section {word!r}")
    sections[name] = TessSection(path, name, number)
    return top, sections[name]


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True
