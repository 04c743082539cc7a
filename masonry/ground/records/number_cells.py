"""Numbers as text files have them: plain decimals, with the exponents of Fortran, and those that touch each other."""

import re
from collections.abc import Iterable
from math import isfinite

import numpy as np

LONGEST = 60
"""Letters of a number."""
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[EeDd][-+]?\d{1,3})?", re.ASCII)
_LETTERS = re.compile(r"[-+.\dEeDd\n]*", re.ASCII)
_OF_FORTRAN = str.maketrans("Dd", "EE")


def number_of(cell: str) -> float | None:
    """A finite number; None where the cell is none."""
    if len(cell) > LONGEST or not _NUMBER.fullmatch(cell):
        return None
    number = float(cell.translate(_OF_FORTRAN))
    return number if isfinite(number) else None


def numbers_of(cells: list[str]) -> np.ndarray | None:
    """(n,) finite numbers; None where a cell is none."""
    text = "\n".join(cells)
    if len(max(cells, key=len, default="")) > LONGEST or not _LETTERS.fullmatch(text):
        return None
    try:
        values = np.array(text.translate(_OF_FORTRAN).split("\n"), dtype=float) if cells else np.empty(0)
    except ValueError:
        return None
    return values if np.isfinite(values).all() else None


def parted(lines: list[str]) -> list[list[str]]:
    """Cells of lines, where numbers with as many decimals all over, such as 8F10.7, may touch the next one."""
    rows = [line.replace(",", " ").split() for line in lines]
    if all(_NUMBER.fullmatch(cell) for cells in rows for cell in cells):
        return rows
    decimals = {_decimals(cells[-1]) for cells in rows if cells}
    if len(decimals) != 1 or None in decimals:
        return rows
    number = rf"[-+]?\d*\.\d{{{decimals.pop()}}}(?:[EeDd][-+]?\d\d)?"
    whole, single = re.compile(f"(?:{number})+", re.ASCII), re.compile(number, re.ASCII)
    return [list(_single(cells, whole, single)) for cells in rows]


def _decimals(cell: str) -> int | None:
    """Digits behind the last point of a cell, its exponent apart."""
    match = re.search(r"\.(\d+)(?:[EeDd][-+]?\d\d)?$", cell[-LONGEST:], re.ASCII)
    return None if match is None else len(match[1])


def _single(cells: list[str], whole: re.Pattern[str], single: re.Pattern[str]) -> Iterable[str]:
    for cell in cells:
        if whole.fullmatch(cell):
            yield from single.findall(cell)
        else:
            yield cell
