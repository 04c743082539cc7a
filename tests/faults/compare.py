"""Are the results of two runs the same bits? Histories, ledger, frames, and summary; not the seconds they took."""

import json
from pathlib import Path
from typing import Any

TIMELESS = ("curve.csv", "fields.vtkhdf", "scene.toml")
"""Files that hold no time of day and no seconds."""


def differences(one: Path, other: Path) -> list[str]:
    """What two folders of results hold differently, by name of file and of what is in it; empty where nothing."""
    names = [name for name in TIMELESS if (one / name).read_bytes() != (other / name).read_bytes()]
    for name, read in (("history.h5", _history), ("summary.json", _summary)):
        a, b = read(one / name), read(other / name)
        names += [f"{name}: {key}" for key in a.keys() | b.keys() if a.get(key) != b.get(key)]
    return sorted(names)


def _history(path: Path) -> dict[str, Any]:
    """Type, shape and bytes of every array."""
    import h5py

    arrays: dict[str, Any] = {}

    def keep(name: str, entry: Any) -> None:
        if isinstance(entry, h5py.Dataset) and name not in ("log", "scene"):
            arrays[name] = (entry.dtype.str, entry.shape, entry[()].tobytes())

    with h5py.File(path) as file:
        file.visititems(keep)
    return arrays


def _summary(path: Path) -> dict[str, Any]:
    """By dotted name, all but seconds."""
    return dict(_leaves(json.loads(path.read_text(encoding="utf-8")), ""))


def _leaves(value: Any, name: str) -> list[tuple[str, Any]]:
    if isinstance(value, dict | list):
        entries = value.items() if isinstance(value, dict) else enumerate(value)
        return [leaf for key, entry in entries for leaf in _leaves(entry, f"{name}.{key}".lstrip("."))]
    return [] if name.rsplit(".", 1)[-1].startswith("seconds") else [(name, value)]
