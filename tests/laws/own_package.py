"""The package of docs/own-laws.md, as a reader makes it: the page is the single source of law and scenes."""

import re
import sys
import tomllib
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import invalidate_caches
from pathlib import Path

from masonry.laws.building import entry_points
from masonry.laws.building import plugins as outside
from masonry.scene.tables import law_keys

PAGE = Path(__file__).resolve().parents[2] / "docs" / "own-laws.md"
BLOCK = re.compile(r"^```\{code-block\} \w+\n:caption: ([\w.]+)[^\n]*\n(.*?)^```$", re.MULTILINE | re.DOTALL)
CACHES = (entry_points.plugins, outside.plugin_law, law_keys.keys_of, law_keys._with_keys)


def files_of_page() -> dict[str, str]:
    """Name -> content; blocks of one file one after the other."""
    files: dict[str, str] = {}
    for name, content in BLOCK.findall(PAGE.read_text(encoding="utf-8")):
        files[name] = files.get(name, "") + content
    return files


def install(folder: Path, files: dict[str, str] | None = None, name: str = "my-masonry") -> Path:
    """Write a package and what pip would note of it, so that it counts as installed where the folder is on the path."""
    files = files_of_page() if files is None else files
    folder.mkdir(parents=True, exist_ok=True)
    for file, content in files.items():
        (folder / file).write_text(content, encoding="utf-8")
    points = tomllib.loads(files["pyproject.toml"])["project"]["entry-points"]
    lines = [f"[{group}]\n" + "".join(f"{k} = {v}\n" for k, v in table.items()) for group, table in points.items()]
    note = folder / f"{name.replace('-', '_')}-0.1.dist-info"
    note.mkdir()
    (note / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 0.1\n", encoding="utf-8")
    (note / "entry_points.txt").write_text("\n".join(lines), encoding="utf-8")
    return folder


def law_with_if() -> str:
    """The law of the page with `if` in its functions."""
    files = files_of_page()
    return files["bilinear.py"] + "\n" + files["with_if.py"]


def law_in_lanes() -> str:
    """The law of the page, eight contacts at a time."""
    files = files_of_page()
    return files["bilinear.py"] + "\n" + files["lanes.py"]


def law_by_slip() -> str:
    """The law of the page that knows its curve over the slip alone."""
    files = files_of_page()
    return files["bilinear.py"] + "\n" + files["by_slip.py"]


@contextmanager
def on_the_path(*folders: Path) -> Iterator[None]:
    """As if the packages in some folders were installed; those that come first hide others of the same name."""
    modules = {file.stem for folder in folders for file in folder.glob("*.py")}
    sys.path[:0] = map(str, folders)
    try:
        _forget(modules)
        yield
    finally:
        del sys.path[: len(folders)]
        _forget(modules)


def _forget(modules: set[str]) -> None:
    for name in modules:
        sys.modules.pop(name, None)
    invalidate_caches()
    for cache in CACHES:
        cache.cache_clear()
