"""Our docstrings are plain text: paragraphs, and tables of names with what they mean. This makes them ready for Sphinx.

A row of a table is a name, two blanks or more, and words; lines that are indented deeper go on with it.
"""

import re
from collections import _tuplegetter  # type: ignore[attr-defined]
from collections.abc import Iterator
from typing import Any

ROW = re.compile(r"^ *(?P<name>\S.*?)(?<![.,;:]) {2,}(?P<words>\S.*)$")
SPECIAL = re.compile(r"[\\*|`]|(?<=\w)_(?!\w)|(?<!\w)_(?=\w)")
ARRAY_LIKE = re.compile(r"~numpy\._typing\._array_like\._Buffer \|.*?_NestedSequence\[complex \| bytes \| str\]")
ARRAY = re.compile(r"~numpy\.ndarray\[tuple\[~typing\.Any, \.\.\.\], ~numpy\.dtype\[[^\]]*\]\]")
"""What numpy's ArrayLike and NDArray are spelled out to."""
CODE = re.compile(r"`([^`\n]+)`")


def reworked(lines: list[str]) -> list[str]:
    """Lines of a docstring as reStructuredText that shows what they say, with nothing in them taken for markup."""
    return [line for part in _parts(lines) for line in (*_part(part), "")]


def _parts(lines: list[str]) -> Iterator[list[str]]:
    """What blank lines part."""
    part: list[str] = []
    for line in [*lines, ""]:
        if line.strip():
            part.append(line.expandtabs())
        elif part:
            yield part
            part = []


def _part(lines: list[str]) -> Iterator[str]:
    """A paragraph, a table, a list, or a piece of Python."""
    if lines[0].lstrip().startswith(">>> "):
        yield from lines
        return
    if lines[0].lstrip().startswith("- "):
        yield from _list(lines)
        return
    open_row = 0
    for line in lines:
        indent = len(line) - len(line.lstrip())
        row = ROW.match(line)
        if row and not (open_row and indent >= open_row):
            if not open_row:
                yield ""
            open_row = row.start("words")
            yield f"``{row['name'].replace('`', '')}``"
            yield f"    {_safe(row['words'])}"
        elif open_row and indent > 1:
            yield f"    {_safe(line.strip())}"
        else:
            if open_row:
                yield ""
            open_row = 0
            yield _safe(line.strip())


def _list(lines: list[str]) -> Iterator[str]:
    for line in lines:
        text = line.strip()
        yield f"- {_safe(text[2:])}" if text.startswith("- ") else f"  {_safe(text)}"


def _safe(text: str) -> str:
    """Backticks become literals, and all else that reStructuredText would take for markup is escaped."""
    pieces = CODE.split(text)
    return "".join(
        f"``{piece}``" if i % 2 else SPECIAL.sub(lambda found: "\\" + found[0], piece) for i, piece in enumerate(pieces)
    )


def _process(app: Any, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    lines[:] = reworked(lines)


def _signature(
    app: Any, what: str, name: str, obj: Any, options: Any, given: str | None, back: str | None
) -> tuple[str | None, str | None]:
    """Types of numpy by the names that the source has for them."""
    return _short(given), _short(back)


def _short(types: str | None) -> str | None:
    return types and ARRAY.sub("~numpy.ndarray", ARRAY_LIKE.sub("ArrayLike", types))


def _skip(app: Any, what: str, name: str, obj: Any, skip: bool, options: Any) -> bool | None:
    """Fields of named tuples are told in the docstring of the tuple; what pydantic adds to a model is not ours."""
    return True if isinstance(obj, _tuplegetter) or name.startswith("model_") else None


def setup(app: Any) -> dict[str, bool]:
    """Listen where autodoc hands out docstrings, signatures and members."""
    app.connect("autodoc-process-docstring", _process)
    app.connect("autodoc-process-signature", _signature)
    app.connect("autodoc-skip-member", _skip)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
