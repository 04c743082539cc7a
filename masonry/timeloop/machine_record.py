"""Measurements on this machine, kept in the cache folder: tables of numbers, each in a file of its own."""

import contextlib
import json

from geometry.files.atomic import WholeFiles
from masonry.jit.cache_folder import MARKER, OURS, cache_root, made_root, require_own
from masonry.runtime.processors import compiled_for

FOLDER = "machine"


def read_record(name: str) -> dict[str, float]:
    """The table of this name; empty where there is none, or where it is of another processor."""
    try:
        require_own(cache_root())
        record = json.loads((cache_root() / FOLDER / f"{name}.json").read_text(encoding="utf-8"))
        numbers = {str(key): float(value) for key, value in record["numbers"].items()}
        return numbers if record["processor"] == compiled_for() else {}
    except (OSError, ValueError, TypeError, KeyError, AttributeError):
        return {}


def write_record(name: str, numbers: dict[str, float]) -> None:
    """Keep a table; nothing where it cannot be written."""
    record = {"processor": compiled_for(), "numbers": numbers}
    with contextlib.suppress(OSError), WholeFiles(folder := made_root() / FOLDER) as files:
        (folder / MARKER).write_bytes(OURS)
        files.text(f"{name}.json", json.dumps(record, indent=1))
