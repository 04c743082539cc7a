"""The first page of the report, verdict by verdict, and the whole as one HTML file."""

import os
import platform
from datetime import UTC, datetime
from importlib import metadata, resources
from pathlib import Path
from string import Template

from masonry import __version__
from masonry.kernels.compiler import source_hash
from verification.report.page import WORDS, Chapter, Verdict, badge, escape, paragraph, table

AREAS = ("Closed forms", "Loading rate", "Stability", "Energy balance", "Assumptions")
PACKAGES = ("numpy", "scipy", "numba", "gmsh", "matplotlib")


def html_of(chapters: list[Chapter], seconds: float) -> str:
    """The whole page: cover, contents, chapters. `seconds` is what the report took."""
    template = Template(resources.files("verification.report").joinpath("template.html").read_text(encoding="utf-8"))
    titles = [escape(c.title) for c in chapters]
    contents = "".join(f'<li><a href="#c{k}">{title}</a></li>' for k, title in enumerate(titles))
    body = "".join(
        f'<section id="c{k}"><h2>{k + 1}. {title}</h2>{"".join(chapter.parts)}</section>'
        for k, (title, chapter) in enumerate(zip(titles, chapters, strict=True))
    )
    return template.substitute(cover=cover(chapters, seconds), contents=contents, body=body)


def cover(chapters: list[Chapter], seconds: float) -> str:
    """Verdict per area, what they mean, and where the numbers come from."""
    said = {v.area: v for c in chapters for v in c.verdicts}
    areas = [*AREAS, *(area for area in said if area not in AREAS)]
    verdicts = [said.get(area, Verdict(area, "none", "Not part of this report.")) for area in areas]
    rows = [[v.area, badge(v.kind), v.sentence] for v in verdicts]
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
        "machine": f"{processor()}, {os.cpu_count()} logical cores, {platform.system()} {platform.machine()}",
        "this report": f"{seconds:.0f} s, one thread, compiling included",
    }
    return table(["", "where these numbers come from"], facts.items())


def processor() -> str:
    """The model of the CPU, where the system tells."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    named = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return named[0] if named else platform.processor() or "unknown processor"


__all__ = ["WORDS", "cover", "html_of", "origin", "processor"]
