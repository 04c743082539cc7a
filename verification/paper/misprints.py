"""Lines that the paper prints otherwise than it means them: a list of their own, as they claim nothing."""

from collections.abc import Sequence
from dataclasses import dataclass

from verification.html.page import Cell, table

HEADER = ("where", "as printed", "what that comes to", "as built")


@dataclass(frozen=True)
class Misprint:
    """A line of the paper that cannot be meant as it stands.

    where     "3, eq. (15)"
    printed   what stands there
    comes_to  what it would do, with numbers
    built     what this program has in its place
    """

    where: str
    printed: str
    comes_to: str
    built: str


def misprint_table(found: Sequence[Misprint]) -> str:
    """The list as a table."""
    rows = [(m.where, Cell(m.printed, "claim"), Cell(m.comes_to, "claim"), Cell(m.built, "claim")) for m in found]
    return table(HEADER, rows, f"Misprints: {len(found)}")
