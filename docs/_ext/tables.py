"""Tables for narrow screens: each cell of a wide table carries the name of its column; site.css makes cards of rows."""

import re
from html import escape
from typing import Any

TABLE = re.compile(r"<table class=\"docutils.*?</table>", re.DOTALL)
NAME = re.compile(r"<th[^>]*>(.*?)</th>", re.DOTALL)
ROW = re.compile(r"<tr.*?</tr>", re.DOTALL)
TAG = re.compile(r"<[^>]+>")
WIDE = 4
"""Columns from which on a table does not fit into a narrow screen."""


def with_names(body: str) -> str:
    """A page in which the cells of wide tables have `data-name`, the heading of their column."""
    return TABLE.sub(lambda found: _named(found[0]), body)


def _named(table: str) -> str:
    names = [escape(" ".join(TAG.sub("", name).split())) for name in NAME.findall(table)]
    if len(names) < WIDE:
        return table
    table = table.replace('<table class="docutils', '<table class="wide docutils', 1)
    return ROW.sub(lambda row: _named_row(row[0], names), table)


def _named_row(row: str, names: list[str]) -> str:
    column = iter(names)
    return re.sub(r"<td\b", lambda cell: f'{cell[0]} data-name="{next(column, "")}"', row)


def _write(app: Any, page: str, template: str, context: dict[str, Any], tree: Any) -> None:
    if "body" in context:
        context["body"] = with_names(context["body"])


def setup(app: Any) -> dict[str, bool]:
    """Listen where the body of a page is ready."""
    app.connect("html-page-context", _write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
