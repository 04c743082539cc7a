"""Page of a run: specimen, curve, cracks, results, verdict, doubts, assumptions, and input."""

from collections.abc import Callable
from contextlib import suppress
from math import dist
from pathlib import Path
from typing import Any, NamedTuple

from geometry.blocks import GeometryError
from geometry.files.atomic import whole_file
from masonry import __version__
from masonry.errors import SceneError
from masonry.judgement.catalogue import criteria
from masonry.judgement.words import readable
from masonry.laboratory import arguments
from masonry.laboratory.result import Result, load_result
from masonry.laboratory.text import summary_rows
from masonry.pictures.style import write_picture
from masonry.reporting.report_page import Picture, ReportPage, page_text
from masonry.runtime.named_file import require_free
from masonry.runtime.tables import Rows
from masonry.scene.tables.limit import LimitLoad
from masonry.scene.tables.road.vehicle import Vehicle
from masonry.scene.tables.specimens.bar import BarTable

LARGEST = 3_000_000
"""Bytes of a picture of lines and letters; a larger one becomes one of points."""
SAID_APART = ("trust", "advice", "time")
"""Rows of the summary that the page has elsewhere, or not at all."""


def write_report(result: Result, path: Path, overwrite: bool = False) -> Path:
    """Write the page of a result (.html), whole or not at all, with its pictures in it; returns the path.

    The same result gives the same bytes. Raises SceneError for another suffix, and where a file stands there that we
    did not write (unless `overwrite`); GeometryError where it cannot be written.
    """
    path = Path(path)
    if path.suffix != ".html":
        raise SceneError(f"'{path}': a report is a .html file; nearest: '{path.stem or 'report'}.html'")
    require_free(path, overwrite)
    text = page_text(report_page(result))
    with whole_file(path) as beside:
        beside.write_text(text, encoding="utf-8", newline="\n")
    return path


def report_of(result: Result | str | Path, path: str | Path, overwrite: bool) -> Path:
    """The same of what a user hands over: a result, or a folder of results. Raises SceneError."""
    shown = result if isinstance(result, Result) else load_result(arguments.path("folder", result))
    return write_report(shown, arguments.path("path", path), arguments.flag("overwrite", overwrite))


def report_page(result: Result) -> ReportPage:
    """All that the page says."""
    summary, table = result.summary, result.scene_table
    assumptions, load = table.get("assumptions", {}), load_words(table)
    return ReportPage(
        title=result.title,
        made=f"scene {summary.scene or 'without a name'}, {result.specimen.blocks.count} blocks, "
        f"{len(result.joints.area)} contact points; "
        f"{', '.join(filter(None, (f'masonry-dem {summary.version or __version__}', summary.source_hash)))}",
        verdict=result.verdict,
        trust=result.trust,
        pictures=[picture for kind in PICTURES if (picture := kind.of(result)) is not None],
        results=[
            (word, [f"of {load}", *lines] if load and word == "load factor" else lines)
            for word, lines in summary_rows(summary)
            if word not in SAID_APART
        ],
        doubts=[(doubt.sentence, doubt.advice) for doubt in result.doubts],
        criteria=len(criteria()),
        assumptions=[(str(key), [str(value)]) for key, value in assumptions.items()],
        put_in=values_of(result),
        scene=result.scene_toml,
    )


class _Part(NamedTuple):
    """A picture of the page: its caption, and what draws it."""

    caption: str
    figure: Callable[[Result], Any]

    def of(self, result: Result) -> Picture | None:
        """The picture; None where there is nothing to draw it from any more."""
        try:
            figure = self.figure(result)
        except (SceneError, GeometryError):
            return None
        form, content = picture_bytes(figure)
        return Picture(self.caption, form, content)


def _specimen(result: Result) -> Any:
    from masonry.drawings.geometry_picture import geometry_figure
    from masonry.scene import load

    return geometry_figure(load(result.scene_table), result.specimen, result.joints)


PICTURES = (
    _Part("The specimen, its supports and loads", _specimen),
    _Part("The specimen as it deforms, with its cracks", lambda result: result.picture()),
    _Part("What it bore as it moved, and where the energy went", lambda result: result.plot()),
)


def picture_bytes(figure: Any) -> tuple[str, bytes]:
    """The kind of a file, and its bytes: lines and letters, or points where that would be too large."""
    from tempfile import TemporaryDirectory

    with TemporaryDirectory() as folder:
        for form in ("svg", "png"):
            path = Path(folder) / f"picture.{form}"
            write_picture(figure, path)
            if form == "png" or path.stat().st_size <= LARGEST:
                break
        return form, path.read_bytes()


def load_words(table: dict[str, Any]) -> str:
    """Load that a load factor multiplies, in the words of `masonry limit`; empty where the scene names none."""
    try:
        limit = LimitLoad.model_validate(table["limit"])
        return Vehicle.model_validate(table["vehicle"]).words if limit.pattern == "vehicle" else limit.words
    except (KeyError, ValueError):
        return ""


def values_of(result: Result) -> Rows:
    """The numbers of joints and materials, by group; of groups that occur; and of bars."""
    rows: Rows = []
    contacts = {result.joint_groups[g] for g in set(result.joint_group.tolist())}
    for name, occur in (("contact", contacts), ("material", set(result.specimen.blocks.groups))):
        groups = result.scene_table.get(name, {})
        for group, values in groups.items() if isinstance(groups, dict) else ():
            if isinstance(values, dict) and group in {*occur, "default"}:
                words = [f"{key.replace('_', ' ')} {readable(value)}" for key, value in values.items()]
                rows.append((f"{name} {group}", [", ".join(words)]))
    bars = result.scene_table.get("bar", [])
    return [*rows, *(bar_row(k, bar) for k, bar in enumerate(bars) if isinstance(bars, list) and isinstance(bar, dict))]


def bar_row(number: int, table: dict[str, Any]) -> tuple[str, list[str]]:
    """Name and description of a bar: its keys but for its places, in place of which it has a length."""
    keys = ("area", "strength", "young_modulus", "pretension", "slack", "compression")
    words = [f"{key.replace('_', ' ')} {readable(table[key])}" for key in keys if table.get(key) is not None]
    with suppress(ValueError):  # a scene of another version
        words.insert(0, f"length {readable(f'{dist(*BarTable.model_validate(table).ends)} m')}")
    several = [f"{table['repeat']} of them"] if table.get("repeat", 1) != 1 else []
    return f"bar {table.get('name') or number}", [", ".join([*several, *words])]
