"""Where a scene's raw values come from: a file or a packaged scene, and the line of every key in it."""

import os
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

from masonry.errors import SceneError, closest
from masonry.runtime.text_files import NESTED, NO_BACK_SLASH, decoded, toml_of
from masonry.scene.lines import line_numbers
from masonry.scene.variant import Keys, leaves, overlay

LARGEST = 20_000_000
"""Bytes of a scene; most of a large one are its blocks."""
DEEPEST = 8
"""Scenes that may stand one on top of the other."""


@dataclass
class Source:
    """Raw values of a scene before they are checked, and where each one stands.

    file        "" where the values were handed over as a dictionary: a message then names the key alone
    overridden  path: how its new value was given, "--set law" or "law"; "" where the key itself says it
    """

    file: str
    stem: str
    text: str
    raw: dict[str, Any]
    base: "Source | None" = None
    overridden: dict[Keys, str] = field(default_factory=dict)

    @cached_property
    def lines(self) -> dict[Keys, int]:
        return line_numbers(self.text)

    def place(self, path: Keys) -> str:
        """`--set key` (`key` from Python), or file and line of the key or of the nearest table above it."""
        for n in range(len(path), 0, -1):
            if path[:n] in self.overridden:
                return self.overridden[path[:n]] or ".".join(map(str, path))
        for n in range(len(path), 0, -1):
            if line := self._line(path[:n]):
                return line
        return self.file or ".".join(map(str, path)) or "the scene"

    def _line(self, path: Keys) -> str | None:
        """File and line of just this key, here or in the scene below."""
        if path in self.lines:
            return f"{self.file}, line {self.lines[path]}"
        return self.base._line(path) if self.base else None


def packaged() -> dict[str, Traversable]:
    """The scenes that come with the program, by name."""
    scenes = (f for f in files("masonry").joinpath("scenes").iterdir() if f.name.endswith(".toml"))
    return dict(sorted((f.name.removesuffix(".toml"), f) for f in scenes))


def titles() -> dict[str, str]:
    """Name and title of every packaged scene."""
    texts = {name: file.read_text(encoding="utf-8") for name, file in packaged().items()}
    return {name: str(toml_of(text, name).get("title", "")) for name, text in texts.items()}


def read(scene: str | Path, above: tuple[str, ...] = (), typed: str | None = None) -> Source:
    """The raw scene of a path or of a packaged name, on top of its `base` if it names one. Raises SceneError.

    above  the scenes of which this one is the base, the base of the base and so on
    typed  what a message may suggest to add to, where that is not the path itself
    """
    known = packaged()
    file = known[scene] if isinstance(scene, str) and scene in known else Path(scene)
    name = f"{scene}.toml" if isinstance(scene, str) and scene in known else str(scene)
    text = _text(file, name, known, str(scene) if typed is None else typed)
    stem = name.replace("\\", "/").rsplit("/", 1)[-1].removesuffix(".toml")
    source = Source(name, stem, text, toml_of(text, name))
    return _on_its_base(source, file, (*above, name))


def of_tables(tables: Mapping[str, Any]) -> Source:
    """The raw scene of a dictionary, with tables and values as a file has them; files that it names are looked for from
    the folder where one stands. Raises SceneError, with the key, for what no file could hold."""
    if not tables:
        raise SceneError("{} is no scene: give the name of a packaged one, the path of a file, or its tables")
    raw = plain(tables)
    return _on_its_base(Source("", "scene", "", raw, overridden=dict.fromkeys(leaves(raw), "")), Path("scene.toml"), ())


def plain(value: Any, path: str = "", depth: int = 0) -> Any:
    """A value as TOML has it: numbers of numpy become numbers, arrays and tuples lists, paths texts."""
    if depth > NESTED:
        raise SceneError(f"{path[:80]}: tables nested too deeply")
    if isinstance(value, Mapping):
        for key in value:
            if not isinstance(key, str):
                raise SceneError(f"{path or 'the scene'}: {key!r:.60} is no key: keys are texts")
        return {key: plain(below, f"{path}.{key}" if path else key, depth + 1) for key, below in value.items()}
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [plain(below, f"{path}.{n}", depth + 1) for n, below in enumerate(value)]
    if isinstance(value, os.PathLike):
        return str(value)
    if value is None or not isinstance(value, str | bool | int | float):
        hint = "leave the key out" if value is None else "give a number, a text such as '0.5 MPa', a list or a table"
        raise SceneError(f"{path}: {value!r:.60} is no value of a scene; {hint}")
    return value


def _on_its_base(source: Source, file: Traversable, above: tuple[str, ...]) -> Source:
    """A scene on top of the one that its `base` names, if it does."""
    _anchor(source.raw, file)
    base = source.raw.pop("base", None)
    if base is not None:
        source.base = _below(source, base, file, above)
        source.raw = overlay({key: value for key, value in source.base.raw.items() if key != "name"}, source.raw)
    return source


def _anchor(raw: dict[str, Any], file: Traversable) -> None:
    """Files that the specimen and the ground's motion come from are looked for beside the scene that names them."""
    ground = raw.get("ground")
    grounds = ground if isinstance(ground, list) else [ground]
    quiet = raw.get("quiet")
    grounds += [one.get("wave") for one in quiet if isinstance(one, dict)] if isinstance(quiet, list) else []
    named = ((raw.get("specimen"), "path"), (raw.get("curve"), "measured"))
    for table, key in (*named, *((one, "record") for one in grounds)):
        path = table.get(key) if isinstance(table, dict) else None
        if isinstance(table, dict) and isinstance(path, str) and path and isinstance(file, Path):
            table[key] = str(_beside(file, path, key))


def _beside(file: Path, path: str, key: str) -> Path:
    """The file that a key of a scene names. Raises SceneError for the path of another system."""
    if any(letter < " " for letter in path):
        raise SceneError(f"{key}: {path!r:.80} is no path: {NO_BACK_SLASH}")
    there, meant = (file.absolute().parent / name for name in (path, path.replace("\\", "/")))
    if there != meant and not there.exists() and meant.is_file():
        raise SceneError(f"{key}: no file {path!r:.80}, but '{path.replace(chr(92), '/')}': write '/' between folders")
    return there


def _below(source: Source, base: Any, file: Traversable, above: tuple[str, ...]) -> Source:
    """The scene that `base` names: a packaged one, or a file beside this one."""
    where = f"{source.place(('base',))}: base" if source.file else "base"
    if not isinstance(base, str) or not base:
        raise SceneError(f"{where}: must be the name of a packaged scene or a file, not {base!r:.60}")
    if len(above) > DEEPEST:
        raise SceneError(f"{where}: more than {DEEPEST} scenes are based on each other; is one its own base?")
    below = base if base in packaged() else (file.parent if isinstance(file, Path) else Path()) / base
    if str(below) in above:
        raise SceneError(f"{where}: {below} is this scene, or is based on it")
    try:
        return read(below, above, base)
    except SceneError as error:
        raise error.within(where) from None


def _text(file: Traversable, name: str, known: dict[str, Traversable], typed: str) -> str:
    shown = repr(name if len(name) <= 200 else name[:200] + "...")
    try:
        if file.is_dir():
            raise SceneError(f"{shown} is a folder; give a scene file (.toml) or one of {', '.join(known)}")
        if not file.is_file():
            nearest = _nearest(file, name, known, typed)
            hint = f"did you mean '{nearest}'? " if nearest else ""
            raise SceneError(f"no scene {shown}: no such file; {hint}packaged scenes are {', '.join(known)}")
        if isinstance(file, Path) and file.stat().st_size == 0:  # some files of the system say so and never end
            return ""
        with file.open("rb") as stream:
            data = stream.read(LARGEST + 1)
    except (OSError, ValueError) as error:
        if isinstance(error, SceneError):
            raise
        raise SceneError(f"{shown} cannot be read: {getattr(error, 'strerror', None) or error}") from None
    if len(data) > LARGEST:
        raise SceneError(f"{shown} is larger than {LARGEST // 1_000_000} MB; blocks make a scene large")
    return decoded(data, name)


def _nearest(file: Traversable, name: str, known: dict[str, Traversable], typed: str) -> str | None:
    """The file of this name that lacks only its ending, or the packaged scene whose name is closest."""
    if isinstance(file, Path) and "\\" in typed and Path(str(file).replace("\\", "/")).is_file():
        return typed.replace("\\", "/")
    if isinstance(file, Path) and file.name and file.with_name(f"{file.name}.toml").is_file():
        return f"{typed}.toml"
    stem = re.split(r"[/\\]", name[-200:])[-1].removesuffix(".toml")
    return closest(stem, known, 0.5)
