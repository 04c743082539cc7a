"""The gallery: every packaged scene with its picture and its text, made as the site is built."""

import contextlib
import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import masonry
from masonry.cli.main import main
from masonry.drawings.geometry_picture import draw_geometry
from masonry.importing.data_sets import DATA_SETS, DataSet
from masonry.scene import load, packaged

PAGE, MARK, IMPORTED, PICTURES = "gallery", "<!-- scenes -->", "<!-- imported -->", "_generated"
CHEAP = ("couplet", "arch-spread")
"""Scenes that run in a second: their curve and cracks are shown as well."""
PACKAGE = Path(masonry.__file__).parent


def page(folder: Path) -> str:
    """Markdown: a section a scene; its pictures are drawn into the folder."""
    folder.mkdir(exist_ok=True)
    newest = max(path.stat().st_mtime for path in PACKAGE.rglob("*.*") if path.suffix in (".py", ".toml"))
    return "\n\n".join("\n".join(_section(name, folder, newest)) for name in packaged())


def _section(name: str, folder: Path, newest: float) -> Iterator[str]:
    scene = load(name)
    yield from (f"## {name}", f"{scene.title}." if scene.title else "", "")
    picture = folder / f"{name}.png"
    if _is_due(picture, newest):
        draw_geometry(scene, picture)
    yield from (_image(f"The specimen of {name}", picture), "")
    if name in CHEAP:
        drawn = [folder / f"{name}-{what}.png" for what in ("curve", "cracks")]
        if any(_is_due(path, newest) for path in drawn):
            result = masonry.run(scene)
            result.plot(drawn[0])
            result.picture(drawn[1])
        yield from (_image(f"Curve and energies of {name}", drawn[0]), "")
        yield from (_image(f"Cracks of {name}", drawn[1]), "")
    text = (PACKAGE / "scenes" / f"{name}.toml").read_text(encoding="utf-8")
    yield from (f"<details><summary>{name}.toml</summary>", "", "```toml", text.rstrip(), "```", "", "</details>")


def imported(folder: Path) -> str:
    """Markdown: a section for each set of surfaces that comes with the program, with the commands that make it."""
    folder.mkdir(exist_ok=True)
    newest = max(path.stat().st_mtime for path in PACKAGE.rglob("*.py"))
    return "\n\n".join("\n".join(_data_section(data, folder, newest)) for data in DATA_SETS)


def _data_section(data: DataSet, folder: Path, newest: float) -> Iterator[str]:
    stem = data.name.removesuffix(".obj")
    picture, scene = folder / f"imported-{stem}.png", folder / f"imported-{stem}.toml"
    if _is_due(picture, newest):
        with contextlib.redirect_stdout(io.StringIO()):
            assert main(["import", data.name, *data.options, "--out", str(scene), "--overwrite"]) == 0
        draw_geometry(load(scene), picture, data.view)
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
        source[0] = source[0].replace(IMPORTED, imported(folder)).replace(MARK, page(folder))


def setup(app: Any) -> dict[str, bool]:
    """Fill the page as it is read, each time the site is built."""
    app.connect("source-read", _read)
    app.connect("env-get-outdated", lambda app, env, added, changed, removed: [PAGE])
    return {"parallel_read_safe": True, "parallel_write_safe": True}
