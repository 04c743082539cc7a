"""A page of HTML that needs nothing beside it: pictures are in it, and it prints on A4."""

from base64 import b64encode
from html import escape
from typing import NamedTuple

from masonry.judgement.doubt import SOUND, STOPPED, WITH_CARE
from masonry.runtime.named_file import MARK
from masonry.runtime.tables import Rows

KINDS = {"svg": "image/svg+xml", "png": "image/png"}
COLOURS = {SOUND: "#2f7d5b", WITH_CARE: "#b36b00", STOPPED: "#b2182b"}
NOTE = "The verdict is on the numbers of the computation. It does not judge the safety of a structure."
STYLE = """
:root { color: #222; font: 15px/1.45 "Helvetica Neue", Arial, sans-serif; }
body { margin: 0 auto; max-width: 1000px; padding: 1rem; background: white; }
h1 { font-size: 1.5rem; margin: 0; overflow-wrap: anywhere; } h2 { font-size: 1.05rem; margin: 0 0 .3rem; }
.made, footer { color: #666; font-size: .85rem; margin: .2rem 0; overflow-wrap: anywhere; }
.verdict { border-left: 6px solid; padding: .3rem .8rem; margin: .8rem 0; background: #f6f6f4; }
.pictures { columns: 2 430px; column-gap: 1.6rem; margin-bottom: 1rem; }
figure { margin: 0 0 .8rem; break-inside: avoid; } figure img { width: 100%; max-height: 640px; object-fit: contain; }
figcaption { font-size: .85rem; color: #444; }
.tables { columns: 2 400px; column-gap: 1.6rem; } section { margin-bottom: 1.2rem; }
p, li { font-size: .9rem; }
table { border-collapse: collapse; width: 100%; font-size: .85rem; }
th, td { text-align: left; vertical-align: top; padding: .15rem .5rem .15rem 0; border-bottom: 1px solid #e2e2de; }
th { font-weight: 600; width: 32%; } td { overflow-wrap: anywhere; } th { overflow-wrap: anywhere; }
ul { padding-left: 1.2rem; margin: .3rem 0; }
pre { font-size: .75rem; white-space: pre-wrap; overflow-wrap: anywhere; }
@media print {
  @page { size: A4; margin: 9mm; } :root { font-size: 8.5px; line-height: 1.3; } body { padding: 0; max-width: none; }
  .pictures, .tables { columns: 2; } figure img { max-height: 80mm; } details { display: none; }
  section { margin-bottom: .6rem; } th, td { padding: .05rem .5rem .05rem 0; } figure { margin-bottom: .3rem; }
  .verdict { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
"""


class Picture(NamedTuple):
    """A caption, the kind of a file ("svg" or "png"), and its bytes."""

    caption: str
    form: str
    content: bytes


class ReportPage(NamedTuple):
    """Content of the page of a run.

    doubts   a sentence and an advice each;  criteria  how many were asked
    put_in   the numbers of joints and materials;  scene  the text that runs it again
    """

    title: str
    made: str
    verdict: str
    trust: str
    pictures: list[Picture]
    results: Rows
    doubts: list[tuple[str, str]]
    criteria: int
    assumptions: Rows
    put_in: Rows
    scene: str


def page_text(page: ReportPage) -> str:
    """The page, everything in it escaped."""
    tables = [
        _section("Results", _table(page.results)),
        _section("Doubts", _doubts(page)),
        _section("Assumptions", _table(page.assumptions) if page.assumptions else "<p>The scene states none.</p>"),
        _section("Joints and materials", _table(page.put_in)) if page.put_in else "",
    ]
    pictures = "".join(map(_figure, page.pictures))
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="generator" content="{MARK}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{escape(page.title)}</title>
<style>{STYLE}</style>
</head>
<body>
<header><h1>{escape(page.title)}</h1><p class="made">{escape(page.made)}</p></header>
<div class="verdict" style="border-color: {COLOURS.get(page.verdict, "#666")}">
<strong>Verdict:</strong> {escape(page.trust)}<br><small>{NOTE}</small></div>
<div class="pictures">{pictures}</div>
<div class="tables">{"".join(tables)}</div>
<details><summary>The scene that was run</summary><pre>{escape(page.scene)}</pre></details>
</body>
</html>
"""


def _figure(picture: Picture) -> str:
    data = b64encode(picture.content).decode()
    caption = escape(picture.caption)
    image = f'<img alt="{caption}" src="data:{KINDS[picture.form]};base64,{data}">'
    return f"<figure>{image}<figcaption>{caption}</figcaption></figure>"


def _section(title: str, content: str) -> str:
    return f"<section><h2>{escape(title)}</h2>{content}</section>"


def _doubts(page: ReportPage) -> str:
    if not page.doubts:
        return f"<p>None: nothing that is asked of a run speaks against its numbers ({page.criteria} criteria).</p>"
    items = [
        f"<li>{escape(sentence)}{f'<br><em>{escape(advice)}</em>' if advice else ''}</li>"
        for sentence, advice in page.doubts
    ]
    return f"<ul>{''.join(items)}</ul>"


def _table(rows: Rows) -> str:
    body = [f"<tr><th>{escape(word)}</th><td>{'<br>'.join(map(escape, lines))}</td></tr>" for word, lines in rows]
    return f"<table>{''.join(body)}</table>"
