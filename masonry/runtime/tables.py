"""Tables of words: aligned for a terminal, or as HTML for a notebook."""

import textwrap
from collections.abc import Collection, Sequence
from html import escape

from masonry.errors import visible

WIDTH = 110

Rows = list[tuple[str, list[str]]]
"""A word and its lines, row by row."""


def columns(rows: Sequence[Sequence[str]], right: Collection[int] = ()) -> list[str]:
    """A line for each row, its cells in columns that are two spaces apart; `right` has the numbers of those columns
    whose cells end at one edge."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        "  ".join(f"{cell:{'>' if k in right else '<'}{widths[k]}}" for k, cell in enumerate(row)).rstrip()
        for row in rows
    ]


def aligned(rows: Rows, wrap: bool = True) -> str:
    """Two columns: a word, and lines that are wrapped under each other."""
    rows = [(visible(word), list(map(visible, entries))) for word, entries in rows]
    margin = max(len(word) for word, _ in rows) + 2
    lines = []
    for word, entries in rows:
        for number, entry in enumerate(entries):
            head = f"{word if number == 0 else '':<{margin}}"
            pieces = (textwrap.wrap(entry, WIDTH - margin) if wrap and len(entry) > WIDTH - margin else [entry]) or [""]
            lines.append(head + pieces[0])
            lines += [" " * margin + piece for piece in pieces[1:]]
    return "\n".join(lines)


def html_table(title: str, rows: Rows) -> str:
    """A title, and a word with its lines in each row; everything escaped."""
    body = "".join(
        f'<tr><th style="text-align:left">{escape(word)}</th>'
        f'<td style="text-align:left">{"<br>".join(map(escape, lines))}</td></tr>'
        for word, lines in rows
    )
    return f"<table><caption>{escape(title)}</caption><tbody>{body}</tbody></table>"


def html_columns(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table with a head over its columns, numbers to the right; everything escaped."""
    cells = ["".join(f'<td style="text-align:right">{escape(cell)}</td>' for cell in row) for row in rows]
    top = "".join(f'<th style="text-align:right">{escape(cell)}</th>' for cell in head)
    return f"<table><thead><tr>{top}</tr></thead><tbody>{''.join(f'<tr>{row}</tr>' for row in cells)}</tbody></table>"
