"""Parts of a chapter: verdicts, records and pieces of HTML, every text escaped."""

import base64
import html
import io
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

WORDS = {"ok": "holds", "warn": "with\u00a0care", "bad": "fails", "none": "not\u00a0looked\u00a0at"}
PIXELS_AN_INCH, PALETTE = 110, 256
"""Of pictures in pixels. With a palette of its own a gallery of cells is a third of what all colours or an SVG take."""


@dataclass(frozen=True)
class Verdict:
    """One line of the first page: area, one of WORDS, and a sentence with the figures."""

    area: str
    kind: str
    sentence: str


@dataclass
class Chapter:
    """Chapter of a study: its verdicts, its records (one dict each) and its page as pieces of HTML.

    group   the heading in the contents under which it stands
    anchor  its name within the page, for links; its number where none is given
    """

    title: str
    verdicts: list[Verdict] = field(default_factory=list)
    records: list[dict[str, Any]] = field(default_factory=list)
    parts: list[str] = field(default_factory=list)
    group: str = "Studies"
    anchor: str = ""

    def add(self, *parts: str) -> None:
        """Pieces of HTML, in their order; text that is no HTML becomes a paragraph."""
        self.parts += [part if part.startswith("<") else paragraph(part) for part in parts if part]

    def judge(self, area: str, kind: bool | str, sentence: str) -> None:
        """A verdict: one of WORDS, or whether it holds."""
        self.verdicts.append(Verdict(area, _kind(kind), sentence))


@dataclass(frozen=True)
class TableCell:
    """A coloured table cell; `note` is the small print under it."""

    text: str
    kind: str = ""
    note: str = ""


def judged(text: Any, kind: bool | str, note: str = "") -> TableCell:
    """A cell in the colour of a word of WORDS, or of whether it holds."""
    return TableCell(str(text), _kind(kind), note)


def _kind(kind: bool | str) -> str:
    return kind if isinstance(kind, str) else "ok" if kind else "bad"


@dataclass(frozen=True)
class Link:
    """A table cell that leads to an anchor of the page."""

    text: str
    anchor: str


def escape(text: Any) -> str:
    """Text as HTML."""
    return html.escape(str(text))


def prose(text: Any) -> str:
    """Text as HTML, in which what stands between backticks is code."""
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", escape(text))


def heading(text: str, anchor: str = "") -> str:
    """A heading within a chapter; `anchor` is its name for links."""
    return f'<h3 id="{escape(anchor)}">{escape(text)}</h3>' if anchor else f"<h3>{escape(text)}</h3>"


def paragraph(text: str, kind: str = "") -> str:
    """A paragraph; kind "lead" is larger, "note" smaller."""
    return f'<p class="{kind}">{prose(text)}</p>' if kind else f"<p>{prose(text)}</p>"


def preformatted(text: str) -> str:
    """Text whose lines and columns stay as they are: formulas, sketches, scenes."""
    return f"<pre>{escape(text)}</pre>" if text else ""


def bullets(items: Iterable[str]) -> str:
    """A plain list."""
    return "<ul>" + "".join(f"<li>{prose(item)}</li>" for item in items) + "</ul>"


def link_line(text: str, anchor: str) -> str:
    """A paragraph that is a link to an anchor of the page."""
    return f"<p>{_link(Link(text, anchor))}</p>"


def table(header: Sequence[str], rows: Iterable[Sequence[Any]], caption: str = "") -> str:
    """A table; cells are text, numbers, `Cell`, `Link` or a list of links. The first column is left-aligned.

    On a narrow screen a row with a `Cell` of kind "claim" becomes a card, with its verdict at the top.
    """
    rows = list(rows)
    top = "".join(f"<th>{escape(name)}</th>" for name in header)
    names = (
        list(header)
        if any(isinstance(cell, TableCell) and cell.kind == "claim" for row in rows for cell in row)
        else []
    )
    body = "".join("<tr>" + "".join(map(_named, row, names) if names else map(_cell, row)) + "</tr>" for row in rows)
    head = f"<thead><tr>{top}</tr></thead>" if header else ""
    title = f"<caption>{escape(caption)}</caption>" if caption else ""
    cards = ' class="cards"' if names else ""
    return f'<div class="wide"><table{cards}>{title}{head}<tbody>{body}</tbody></table></div>'


def _named(value: Any, name: str) -> str:
    """A cell that carries the name of its column."""
    return _cell(value).replace("<td", f'<td data-name="{escape(name)}"', 1)


def _cell(value: Any) -> str:
    if isinstance(value, Link):
        return f"<td>{_link(value)}</td>"
    if isinstance(value, list):
        return f'<td class="text">{"; ".join(map(_link, value))}</td>'
    if not isinstance(value, TableCell):
        return f"<td>{prose(value)}</td>"
    small = f"<small>{prose(value.note)}</small>" if value.note else ""
    return f'<td class="{value.kind}">{prose(value.text)}{small}</td>'


def _link(link: Link) -> str:
    return f'<a href="#{escape(link.anchor)}">{escape(link.text)}</a>'


def without_dead_links(content: str) -> str:
    """HTML in which a link to an anchor that is not there is text: a report of some chapters leads to no others."""
    anchors = set(re.findall(r' id="([^"]*)"', content))
    return re.sub(
        r'<a href="#([^"]*)">(.*?)</a>', lambda m: m.group(0) if m.group(1) in anchors else m.group(2), content
    )


def badge(kind: str) -> TableCell:
    """The word of a verdict, in its colour."""
    return TableCell(WORDS[kind], kind)


def percent(value: float | None, digits: int = 2) -> str:
    """A share as percent; very small ones as a power of ten."""
    if value is None or value != value:
        return "-"
    shown = 100.0 * value
    if abs(shown) >= 10.0**digits:
        return f"{shown:.0f} %"
    return f"{shown:.{digits}g} %" if abs(shown) >= 1e-3 or shown == 0.0 else f"{shown:.0e} %"


def short(text: str, length: int = 150) -> str:
    """The first sentence of a message, or its beginning."""
    first = text.split(". ")[0]
    return first if len(first) <= length else first[: length - 1] + "…"


def picture(figure: Any, caption: str, kind: str = "", pixels: bool = False) -> str:
    """A matplotlib figure inside the page, so that no other file is needed.

    kind    "half" for one that is not to fill the width
    pixels  a PNG in place of an SVG, which is sharp in print but large where thousands of lines are drawn
    """
    import matplotlib

    stream = io.BytesIO()
    if pixels:
        _write_pixels(figure, stream)
    else:
        with matplotlib.rc_context({"svg.fonttype": "path", "svg.hashsalt": "masonry"}):
            figure.savefig(stream, format="svg", metadata={"Date": None})
    data = base64.b64encode(stream.getvalue()).decode()
    text = escape(caption)
    image = f'<img alt="{text}" src="data:image/{"png" if pixels else "svg+xml"};base64,{data}">'
    return f'<figure class="{kind}">{image}<figcaption>{text}</figcaption></figure>'


def _write_pixels(figure: Any, stream: io.BytesIO) -> None:
    from PIL import Image

    drawn = io.BytesIO()
    figure.savefig(drawn, format="png", dpi=PIXELS_AN_INCH)
    few = Image.open(drawn).convert("RGB").quantize(PALETTE, dither=Image.Dither.NONE)
    few.save(stream, "png", optimize=True)


def folded(title: str, content: str) -> str:
    """HTML that is folded away on a screen, and stays folded in print."""
    return f"<details><summary>{escape(title)}</summary>{content}</details>"
