"""Where a scene's raw values come from: a file or a packaged scene, and the line of every key in it."""

import re
from dataclasses import dataclass, field
from functools import cached_property
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

from masonry.errors import SceneError, closest
from masonry.runtime.text_files import decoded, toml_of
from masonry.scene.lines import line_numbers
from masonry.scene.variant import Keys, overlay

LARGEST = 5_000_000
DEEPEST = 8
"""Scenes that may stand one on top of the other."""


@dataclass
class Source:
    """Raw values of a scene before they are checked, and where each one stands.

    overridden  path: how its new value was given, "--set law" or "law"
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
                return self.overridden[path[:n]]
        for n in range(len(path), 0, -1):
            if line := self._line(path[:n]):
                return line
        return self.file

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
    _anchor(source.raw, file)
    base = source.raw.pop("base", None)
    if base is not None:
        source.base = _below(source, base, file, (*above, name))
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
            table[key] = str(file.absolute().parent / path)


def _below(source: Source, base: Any, file: Traversable, above: tuple[str, ...]) -> Source:
    """The scene that `base` names: a packaged one, or a file beside this one."""
    where = f"{source.place(('base',))}: base"
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
        raise SceneError(f"{shown} is larger than {LARGEST // 1_000_000} MB; a scene file holds a few kB of text")
    return decoded(data, name)


def _nearest(file: Traversable, name: str, known: dict[str, Traversable], typed: str) -> str | None:
    """The file of this name that lacks only its ending, or the packaged scene whose name is closest."""
    if isinstance(file, Path) and file.name and file.with_name(f"{file.name}.toml").is_file():
        return f"{typed}.toml"
    stem = re.split(r"[/\\]", name[-200:])[-1].removesuffix(".toml")
    return closest(stem, known, 0.5)
