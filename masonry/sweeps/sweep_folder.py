"""The folder of a sweep: a new one, or the one that holds what is done of this sweep already."""

from pathlib import Path
from typing import Any

from masonry.errors import SceneError
from masonry.runtime.folder import claim_for_many, scene_name
from masonry.runtime.folders.own_files import LIST, RUNS, is_folder_of_runs
from masonry.runtime.lock import LOCK
from masonry.runtime.text_files import text_of
from masonry.sweeps.read import LARGEST, OF_RESULTS, SCENE, Sweep, read_toml
from masonry.sweeps.sweep_table import TABLE

COPY = "sweep.toml"
DOING = "runs a sweep into it"
"""What a second one is told."""
MOST = 3


def folder_for(name: str, sweep: Sweep, out: Path | None, overwrite: bool) -> Path:
    """`out`, or the last `results/NAME-N` if it holds the beginning of this very sweep, else the next free one.

    name  of the sweep, or the path of its file
    Raises SceneError if `out` holds another sweep or anything else (without `overwrite`), or cannot be written to.
    """

    def difference(folder: Path) -> str | None:
        if not (folder / COPY).is_file():
            there = {entry.name for entry in folder.iterdir()} if folder.is_dir() else set()
            return "" if there <= {LOCK, LIST, RUNS} and is_folder_of_runs(folder / RUNS) else None
        if overwrite:
            return ""
        differs = differences(read_toml(folder / COPY), sweep.raw)
        if (text := scene_text(sweep)) and not _holds(folder / SCENE, text):
            return "a sweep of another scene"
        more = f" and {len(differs) - MOST} more" if len(differs) > MOST else ""
        return f"another sweep: {'; '.join(differs[:MOST])}{more}" if differs else ""

    return claim_for_many(scene_name(name), out, overwrite, difference, TABLE)


def scene_text(sweep: Sweep) -> str:
    """The scene of a sweep that was handed over as an object, as text; "" where it is one that a file names."""
    from masonry.scene import Scene, to_toml

    return to_toml(sweep.scene) if isinstance(sweep.scene, Scene) else ""


def _holds(path: Path, text: str) -> bool:
    try:
        return path.is_file() and text_of(path, LARGEST) == text
    except SceneError:
        return False


def differences(there: dict[str, Any], here: dict[str, Any]) -> list[str]:
    """Differences of the runs in two sweep files, a few words each; remarks and order are no difference."""
    a, b = (dict(_leaves({key: value for key, value in raw.items() if key not in OF_RESULTS})) for raw in (there, here))
    return [
        f"{'.'.join(key)} is {_short(a.get(key))} there, {_short(b.get(key))} here"
        for key in dict.fromkeys([*a, *b])
        if a.get(key) != b.get(key)
    ]


def _leaves(table: dict[str, Any], above: tuple[str, ...] = ()) -> list[tuple[tuple[str, ...], Any]]:
    leaves: list[tuple[tuple[str, ...], Any]] = []
    for key, value in table.items():
        leaves += _leaves(value, (*above, key)) if isinstance(value, dict) else [((*above, key), value)]
    return leaves


def _short(value: Any) -> str:
    text = "not given" if value is None else f"{value!r}"
    return text if len(text) <= 60 else f"{text[:60]}..."
