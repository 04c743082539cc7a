"""The first page of the report, verdict by verdict, and the whole as one HTML file."""

import os
import platform
from datetime import UTC, datetime
from importlib import metadata, resources
from pathlib import Path
from string import Template

from geometry.operating_system import SYSTEM
from masonry import __version__
from masonry.errors import SceneError
from masonry.jit.sources import source_hash
from verification.html.page import WORDS, Chapter, badge, escape, paragraph, table, without_dead_links

AREAS = (
    *("Closed forms", "Loading rate", "Shipped settings", "Threads", "Stability", "Leaving out"),
    *("Energy balance", "Assumptions"),
)
PACKAGES = ("numpy", "scipy", "numba", "gmsh", "matplotlib")


TITLE = "Verification report"
TITLED = 2000
"""Bytes at the beginning of a page that hold its title."""


def html_of(chapters: list[Chapter], seconds: float) -> str:
    """The whole report: cover, contents, chapters. `seconds` is what it took."""
    return bound(TITLE, cover(chapters, seconds), chapters)


def bound(title: str, cover: str, chapters: list[Chapter]) -> str:
    """One HTML file: the title, the cover as HTML, the contents by group, the chapters."""
    template = Template(_template())
    numbered = [(k + 1, c.anchor or f"c{k}", c) for k, c in enumerate(chapters)]
    groups = dict.fromkeys(c.group for c in chapters)
    contents = "".join(
        f'<h3>{escape(group)}</h3><ol start="{next(n for n, _, c in numbered if c.group == group)}">'
        + "".join(
            f'<li value="{n}"><a href="#{anchor}">{escape(c.title)}</a></li>'
            for n, anchor, c in numbered
            if c.group == group
        )
        + "</ol>"
        for group in groups
    )
    body = "".join(
        f'<section id="{anchor}"><h2>{n}. {escape(c.title)}</h2>{"".join(c.parts)}</section>'
        for n, anchor, c in numbered
    )
    return without_dead_links(template.substitute(title=escape(title), cover=cover, contents=contents, body=body))


def _template() -> str:
    return resources.files("verification.report").joinpath("template.html").read_text(encoding="utf-8")


def require_ours(page: Path) -> None:
    """Raise SceneError where a file is to be replaced that is no page of ours, by its title."""
    ours = _template().partition("$title")[2].partition("\n")[0].encode()
    try:
        if page.is_symlink() or (page.exists() and ours not in page.read_bytes()[:TITLED]):
            raise SceneError(f"'{page}' is no page of masonry, and would be replaced: move it, or name another folder")
    except OSError as error:
        raise SceneError(f"'{page}' cannot be replaced: {error.strerror or error}; name another folder") from None


def cover(chapters: list[Chapter], seconds: float) -> str:
    """Verdict per area, what they mean, and where the numbers come from."""
    said = {v.area: v for c in chapters for v in c.verdicts}
    missing = [area for area in AREAS if area not in said]
    verdicts = [*(v for area, v in said.items() if area not in AREAS), *(said[area] for area in AREAS if area in said)]
    rows = [[v.area, badge(v.kind), v.sentence] for v in verdicts]
    rows += [["Other areas", badge("none"), f"Not part of this report: {', '.join(missing)}."]] if missing else []
    lead = (
        "How far the results of this program can be trusted: the error of solving the model, set beside the run time "
        "that it costs, and how far the answer moves with what has to be assumed."
    )
    return "".join([paragraph(lead, "lead"), table(["area", "verdict", "in figures"], rows), origin(seconds)])


def origin(seconds: float) -> str:
    """Versions, machine, date."""
    packages = ", ".join(f"{name} {metadata.version(name)}" for name in PACKAGES)
    facts = {
        "date": datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC"),
        "program": f"masonry-dem {__version__}, sources {source_hash()}",
        "packages": f"Python {platform.python_version()}, {packages}",
        "machine": ", ".join(
            (SYSTEM.processor_name(), f"{os.cpu_count()} logical cores", f"{platform.system()} {platform.machine()}")
        ),
        "this report": f"{seconds:.0f} s, one thread a run, compiling included",
    }
    return table(["", "where these numbers come from"], facts.items())


__all__ = ["WORDS", "cover", "html_of", "origin"]
