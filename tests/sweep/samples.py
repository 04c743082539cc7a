"""A small sweep of a couplet, and functions that stand in for a run."""

import os
from pathlib import Path
from typing import Any

from masonry.sweeps.job import Job
from masonry.sweeps.work import RunEnd, compute

SHORT: dict[str, Any] = {"settle.steps": 100, "drive.steps": 600, "solver.rows": 20}


def jobs(*confinements: str, **more: Any) -> list[Job]:
    return [Job("couplet", SHORT | {"confinement": value} | more) for value in confinements]


def text(body: str, steps: int = 600, scene: str = "couplet") -> str:
    """A sweep file with the short settings."""
    settings = "".join(f'"{key}" = {value}\n' for key, value in (SHORT | {"drive.steps": steps}).items())
    return f'scene = "{scene}"\n[settings]\n{settings}{body}'


def untimed(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Rows without what depends on when and where they were run."""
    return [{name: value for name, value in row.items() if not name.startswith("seconds")} for row in rows]


def marks(folder: Path) -> dict[str, tuple[int, int]]:
    """Which file each finished run is, and when it was written: not the same after it was run again."""
    files = {path.parent.name: path.stat() for path in sorted((folder / "runs").glob("[!.]*/summary.json"))}
    return {key: (stat.st_ino, stat.st_mtime_ns) for key, stat in files.items()}


def dying(toml: str) -> RunEnd:
    """A run whose process dies at one of the confinements."""
    if 'confinement = "200000.0 Pa"' in toml:
        os._exit(7)
    return compute(toml)


def mistaken(toml: str) -> RunEnd:
    raise AssertionError("this run was done already")
