"""The folder of a sweep: a new one, or the one that holds what is done of this sweep already."""

import re
from pathlib import Path
from typing import Any

from masonry.errors import SceneError
from masonry.runtime.folder import RESULTS, claim, scene_name
from masonry.runtime.lock import LOCK
from masonry.sweep.read import Sweep, read_toml
from masonry.sweep.table import TABLE

COPY = "sweep.toml"
DOING = "runs a sweep into it"
"""What a second one is told."""
MOST = 3


def folder_for(path: Path, sweep: Sweep, out: Path | None, overwrite: bool) -> Path:
    """`out`, or the last `results/SWEEP-N` if it holds the beginning of this very sweep, else the next free one.

    Raises SceneError if `out` holds another sweep or anything else (without `overwrite`), or cannot be written to.
    """
    if out is None:
        return _begun(scene_name(str(path)), sweep) or claim(str(path))
    there = out / COPY
    differs = differences(read_toml(there), sweep.raw) if there.is_file() and not overwrite else []
    if differs:
        more = f" and {len(differs) - MOST} more" if len(differs) > MOST else ""
        raise SceneError(
            f"--out '{out}' holds another sweep: {'; '.join(differs[:MOST])}{more}; name another folder, or add"
            " --overwrite to replace its table"
        )
    ours = there.is_file() or (out.is_dir() and {entry.name for entry in out.iterdir()} <= {LOCK, "runs"})
    return claim(str(path), out, overwrite=overwrite, ours=ours)


def _begun(name: str, sweep: Sweep) -> Path | None:
    """The folder with the greatest number, if it holds this sweep and no table yet."""
    if not RESULTS.is_dir():
        return None
    numbers = {
        int(m[1]): entry for entry in RESULTS.iterdir() if (m := re.fullmatch(rf"{re.escape(name)}-(\d+)", entry.name))
    }
    last = numbers[max(numbers)] if numbers else None
    if last is None or (last / TABLE).exists() or not (last / COPY).is_file():
        return None
    return last if not differences(read_toml(last / COPY), sweep.raw) else None


def differences(there: dict[str, Any], here: dict[str, Any]) -> list[str]:
    """What two sweep files say differently, a few words each; remarks and order are no difference."""
    a, b = dict(_leaves(there)), dict(_leaves(here))
    return [
        f"{'.'.join(key)} is {_short(a.get(key))} there, {_short(b.get(key))} here"
        for key in dict.fromkeys([*a, *b])
        if a.get(key) != b.get(key)
    ]


def _leaves(table: dict[str, Any], above: tuple[str, ...] = ()) -> list[tuple[tuple[str, ...], Any]]:
    found: list[tuple[tuple[str, ...], Any]] = []
    for key, value in table.items():
        found += _leaves(value, (*above, key)) if isinstance(value, dict) else [((*above, key), value)]
    return found


def _short(value: Any) -> str:
    text = "not given" if value is None else f"{value!r}"
    return text if len(text) <= 60 else f"{text[:60]}..."
