"""The gallery: every packaged scene with its picture and its text, made as the site is built."""

import contextlib
import io
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

from sphinx.errors import ExtensionError

import masonry
from masonry.cli.main import main
from masonry.drawings.geometry_picture import draw_geometry
from masonry.importing.data_sets import DATA_SETS, DataSet
from masonry.runtime.processes import Lost, work
from masonry.runtime.processors import processors
from masonry.scene import load, packaged

PAGE, MARK, IMPORTED, PICTURES = "gallery", "<!-- scenes -->", "<!-- imported -->", "_generated"
CHEAP = ("couplet", "arch-spread")
"""Scenes that run in a second: their curve and cracks are shown as well."""
PACKAGE = Path(masonry.__file__).parent


def draw(folder: Path) -> None:
    """Draw what is missing or older than the program, on all processors."""
    folder.mkdir(exist_ok=True)
    newest = max(path.stat().st_mtime for path in PACKAGE.rglob("*.*") if path.suffix in (".py", ".toml"))
    scenes = [name for name in packaged() if any(_is_due(path, newest) for path in _pictures(name, folder))]
    imports = [data for data in DATA_SETS if _is_due(_imported_files(data, folder)[0], newest)]
    drawings = [partial(_draw_import, data, folder) for data in imports]  # the longest first
    drawings += [partial(_draw_scene, name, folder) for name in scenes]
    with contextlib.closing(work(_carry_out, drawings, processors())) as ends:
        for number, end in ends:
            if isinstance(end, Lost):
                raise ExtensionError(f"{drawings[number].args[0]} could not be drawn: {end.reason}")


def _carry_out(drawing: Callable[[], None]) -> None:
    drawing()


def page(folder: Path) -> str:
    """Markdown: a section a scene, with its pictures in the folder."""
    return "\n\n".join("\n".join(_section(name, folder)) for name in packaged())


def _pictures(name: str, folder: Path) -> list[Path]:
    """Of a scene: its specimen, and curve and cracks where it is cheap."""
    return [folder / f"{name}{what}.png" for what in ("", "-curve", "-cracks")[: 3 if name in CHEAP else 1]]


def _draw_scene(name: str, folder: Path) -> None:
    scene, pictures = load(name), _pictures(name, folder)
    draw_geometry(scene, pictures[0])
    if name in CHEAP:
        result = masonry.run(scene)
        result.plot(pictures[1])
        result.picture(pictures[2])


def _section(name: str, folder: Path) -> Iterator[str]:
    scene, pictures = load(name), _pictures(name, folder)
    yield from (f"## {name}", f"{scene.title}." if scene.title else "", "")
    for says, picture in zip(("The specimen", "Curve and energies", "Cracks"), pictures, strict=False):
        yield from (_image(f"{says} of {name}", picture), "")
    text = (PACKAGE / "scenes" / f"{name}.toml").read_text(encoding="utf-8")
    yield from (f"<details><summary>{name}.toml</summary>", "", "```toml", text.rstrip(), "```", "", "</details>")


def imported(folder: Path) -> str:
    """Markdown: a section for each set of surfaces that comes with the program, with the commands that make it."""
    return "\n\n".join("\n".join(_data_section(data, folder)) for data in DATA_SETS)


def _imported_files(data: DataSet, folder: Path) -> tuple[Path, Path]:
    """Its picture and its scene."""
    stem = data.name.removesuffix(".obj")
    return folder / f"imported-{stem}.png", folder / f"imported-{stem}.toml"


def _draw_import(data: DataSet, folder: Path) -> None:
    picture, scene = _imported_files(data, folder)
    with contextlib.redirect_stdout(io.StringIO()):
        assert main(["import", data.name, *data.options, "--out", str(scene), "--overwrite"]) == 0
    draw_geometry(load(scene), picture, data.view)


def _data_section(data: DataSet, folder: Path) -> Iterator[str]:
    stem, (picture, _) = data.name.removesuffix(".obj"), _imported_files(data, folder)
    words = " ".join(f'"{word}"' if " " in word else word for word in data.options)
    yield from (f"### {data.name}", f"{data.title}. {data.why}", "", f"Source and licence: {data.source}.", "")
    yield from (_image(f"The blocks of {data.name}", picture), "")
    view = "" if data.view == "front" else f" --view {data.view}"
    yield from ("```bash", f"masonry import {data.name} {words} --out {stem}.toml")
    yield from (f"masonry picture {stem}.toml --geometry{view}", f"masonry run {stem}.toml")
    yield from (f"masonry limit {stem}.toml --set limit.pattern=tilt --set limit.about=y", "```")


def _image(says: str, path: Path) -> str:
    return f"![{says}]({PICTURES}/{path.name})"


def _is_due(path: Path, newest: float) -> bool:
    return not path.exists() or path.stat().st_mtime < newest


def _read(app: Any, name: str, source: list[str]) -> None:
    if name == PAGE:
        folder = Path(app.srcdir) / PICTURES
        draw(folder)
        source[0] = source[0].replace(IMPORTED, imported(folder)).replace(MARK, page(folder))


def setup(app: Any) -> dict[str, bool]:
    """Fill the page as it is read, each time the site is built."""
    app.connect("source-read", _read)
    app.connect("env-get-outdated", lambda app, env, added, changed, removed: [PAGE])
    return {"parallel_read_safe": True, "parallel_write_safe": True}
