"""A sweep file -> what it asks for, with every word of it checked that needs no scene."""

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from masonry.errors import SceneError, nearest
from masonry.runtime.text_files import text_of, toml_of

if TYPE_CHECKING:
    from masonry.scene import Scene

PARTS = ("list", "grid", "latin_hypercube")
FRAGILITY, REFINED_RUNS, SCENE = "fragility", "error_bars", "scene.toml"
OF_RESULTS = (FRAGILITY, REFINED_RUNS)
"""Words that ask something of the results, and change no run."""
WORDS = ("scene", "settings", *PARTS, *OF_RESULTS)
LARGEST = 10_000_000
"""Bytes of a sweep file."""


@dataclass(frozen=True)
class Times:
    """A value told relative to another: `factor` times what the scene has there, or times the value of the key `of`."""

    factor: float
    of: str | None = None


@dataclass(frozen=True)
class Sweep:
    """Content of a sweep file.

    name      of the file, for messages
    scene     a packaged scene's name, the path of a file beside the sweep's, or a scene
    settings  dotted key -> value, the same in all runs
    parts     list, grid and latin_hypercube as they stand in the file; each key once
    folder    of the file, beside which records are looked for
    raw       the whole file, to tell whether two are the same
    """

    name: str
    scene: "Scene | str | Path"
    settings: dict[str, Any]
    parts: dict[str, Any]
    raw: dict[str, Any]
    folder: Path = Path()

    @property
    def error_bars(self) -> int:
        """How many of its runs are refined; 0 where it asks for no bars."""
        return int(self.raw.get(REFINED_RUNS, 0))

    @property
    def keys_by_part(self) -> dict[str, list[str]]:
        """The dotted keys that each part sets."""
        rows = self.parts.get("list", [])
        return {
            "[settings]": list(self.settings),
            "[[list]]": list(dict.fromkeys(key for row in rows for key in row)),
            "[grid]": list(self.parts.get("grid", {})),
            "[latin_hypercube]": [k for k in self.parts.get("latin_hypercube", {}) if k not in ("samples", "seed")],
        }


def read(path: Path) -> Sweep:
    """The sweep of a file. Raises SceneError: one message with what is wrong, where, and what is allowed."""
    from masonry.scene import packaged

    raw, folder = read_toml(path), path.absolute().parent
    scene = raw.get("scene")
    if not isinstance(scene, str) or not scene:
        _require_words(raw, str(path))
        raise SceneError(f"{path}: scene: missing; the name of a packaged scene, or a file beside this one")
    return sweep_of(raw, str(path), scene if scene in packaged() else folder / scene, folder)


def sweep_of(raw: dict[str, Any], name: str, scene: "Scene | str | Path", folder: Path) -> Sweep:
    """The sweep of a scene that tables ask for; `name` for messages, `folder` for the files that they name. Raises
    SceneError."""
    _require_words(raw, name)
    parts = {part: raw[part] for part in PARTS if part in raw}
    if not parts:
        raise SceneError(f"{name}: nothing to vary; give a table [grid] or [latin_hypercube], or rows [[list]]")
    settings = values(raw.get("settings", {}), f"{name}: settings")
    if "list" in parts:
        if not isinstance(parts["list"], list) or not parts["list"]:
            raise SceneError(f"{name}: list: rows stand in double brackets, [[list]], each with keys and values")
        parts["list"] = [values(row, f"{name}: list, row {n + 1}") for n, row in enumerate(parts["list"])]
    for part in ("grid", "latin_hypercube"):
        if part in parts and not isinstance(parts[part], dict):
            raise SceneError(f"{name}: {part}: must be a table [{part}] of dotted keys")
    number = raw.get(REFINED_RUNS, 1)
    if not isinstance(number, int) or isinstance(number, bool) or number < 1:
        raise SceneError(f"{name}: {REFINED_RUNS}: how many of the runs are refined, 1 or more, not {number!r:.60}")
    sweep = Sweep(name, scene, settings, parts, raw, folder)
    _each_key_once(sweep)
    return sweep


def sweep_of_tables(scene: "Scene", tables: Any) -> Sweep:
    """Sweep of a scene as a Python user asks for it: tables as in a sweep file, or keys and values of a grid alone.
    Raises SceneError."""
    from masonry.scene.source import plain

    if not isinstance(tables, Mapping) or not tables:
        raise SceneError(
            f"{tables!r:.60}: say what varies: {{'confinement': ['0.1 MPa', '0.5 MPa']}}, or tables 'grid', 'list', "
            "'latin_hypercube' and 'settings'"
        )
    raw = plain(tables)
    if not any(word in WORDS or (isinstance(value, dict) and "times" not in value) for word, value in raw.items()):
        raw = {"grid": raw}
    return sweep_of(raw | {"scene": SCENE}, "sweep", scene, Path().absolute())


def _require_words(raw: dict[str, Any], name: str) -> None:
    if "specimen" in raw:
        raise SceneError(
            f"{name}: this is a scene, and no sweep; one beside it names it, scene = '{Path(name).name}', and says "
            "what varies: docs/sweep.md"
        )
    for word in raw:
        if word not in WORDS:
            raise SceneError(f"{name}: {word}: unknown key; {nearest(word, WORDS)}")


def read_toml(path: Path) -> dict[str, Any]:
    """The raw tables of a TOML file. Raises SceneError."""
    try:
        there = path.is_file()
    except OSError:  # a name that is too long, a folder that may not be looked into
        there = False
    if not there:
        raise SceneError(f"no sweep {f'{path}'[:200]!r}: no such file; give a sweep file (.toml), see docs/sweep.md")
    return toml_of(text_of(path, LARGEST), str(path), "a sweep")


def values(table: Any, where: str) -> dict[str, Any]:
    """Dotted keys and one value each, `{times = 2}` among them."""
    if not isinstance(table, dict):
        raise SceneError(f"{where}: must be a table of dotted keys and values")
    return {key: value_of(value, f"{where}: {key}") for key, value in table.items()}


def value_of(value: Any, where: str) -> Any:
    """One value: as it stands, or Times where it is `{times = 2}` or `{times = 2, of = "key"}`."""
    if isinstance(value, Mapping) and "times" in value:
        if set(value) - {"times", "of"} or not is_number(value["times"]) or not isinstance(value.get("of", ""), str):
            raise SceneError(f"{where}: write {{times = 2}}, or {{times = 1.5, of = 'a.dotted.key'}}")
        return Times(float(value["times"]), value.get("of"))
    if isinstance(value, Mapping):
        raise SceneError(f"{where}: is a table; write dotted keys in quotes: 'contact.unit_unit.cohesion' = '0.6 MPa'")
    return value


def is_number(value: Any) -> bool:
    """Whether it is a number that a float can hold."""
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= sys.float_info.max


def _each_key_once(sweep: Sweep) -> None:
    owner: dict[str, str] = {}
    for part, keys in sweep.keys_by_part.items():
        for key in keys:
            if key in owner:
                raise SceneError(f"{sweep.name}: {key} is given in {owner[key]} and in {part}; once is enough")
            owner[key] = part
    if len(owner) == len(sweep.settings):
        raise SceneError(f"{sweep.name}: nothing to vary; name dotted keys in [grid], [latin_hypercube] or [[list]]")
