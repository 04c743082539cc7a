"""Where the bits of a run come from besides its model: its scene, its file of blocks, the sources, the packages."""

import hashlib
import os
import tomllib
from collections.abc import Iterable
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from geometry.blocks import GeometryError
from geometry.files.atomic import require_file
from geometry.files.blocks_h5 import LARGEST
from masonry import __version__
from masonry.errors import SceneError
from masonry.jit.sources import ALL, package_hash, source_hash
from masonry.laws import law_names
from masonry.laws.building.plugins import plugin_law
from masonry.runtime.processors import compiled_for

SHOWING = (
    *(
        "masonry/__main__.py",
        "masonry/cli/*",
        "masonry/shell_functions.py",
        "masonry/sweeps/*",
        "masonry/importing/*",
    ),
    *("masonry/pictures/*", "masonry/curves/*", "masonry/drawings/*", "masonry/movies/*", "masonry/reporting/*"),
    *("masonry/statics/*", "masonry/limit_analysis/*"),
)
"""Sources that a result does not depend on: an edit of these runs nothing again."""
PROCESSOR = "the processor"
PACKAGES = ("numpy", "scipy", "numba", "llvmlite", "gmsh")
"""Packages that a number goes through on its way to a result."""


def file_of_blocks(toml: str) -> bytes:
    """Hash of what stands in the file that a scene takes its blocks from; nothing where there is none to read."""
    path = tomllib.loads(toml)["specimen"].get("path")
    if not path:
        return b""
    try:
        require_file(path, LARGEST)
        with open(path, "rb") as file:
            return hashlib.file_digest(file, "sha256").digest()
    except (OSError, GeometryError):
        return b""


def files_of_records(toml: str) -> bytes:
    """Hash of what stands in the records that shake a scene, of waves that come into it, and of the curve measured
    beside it; nothing where there are none to read."""
    scene = tomllib.loads(toml)
    ground = scene.get("ground", ())
    tables = [ground] if isinstance(ground, dict) else [*ground]
    tables += [quiet["wave"] for quiet in scene.get("quiet", ()) if "wave" in quiet]
    paths = [table["record"] for table in tables if table.get("record")]
    paths += [measured] if (measured := scene.get("curve", {}).get("measured")) else []
    hashes = []
    for path in paths:
        try:
            hashes.append(hashlib.sha256(Path(path).read_bytes()).digest())
        except OSError:
            hashes.append(b"")
    return b"".join(hashes)


def other_sources(toml: str) -> str:
    """Hash of the packages that a scene has laws or its specimen from; nothing where all are ours."""
    scene = tomllib.loads(toml)
    laws = scene.get("law"), *(contact.get("law") for contact in scene["contact"].values())
    return own_sources(laws)


def provenance_of(toml: str) -> dict[str, str]:
    """Sources on which a run of a resolved scene depends, by a few words each."""
    records = files_of_records(toml)
    of_records = {"its records": hashlib.sha256(records).hexdigest()[:16]} if records else {}
    return {
        "its scene": hashlib.sha256(toml.encode()).hexdigest()[:16],
        "its file of blocks": file_of_blocks(toml).hex()[:16] or "none",
        **of_records,
        "the program": f"masonry {__version__}, sources {source_hash(ALL, SHOWING)}",
        "the packages of its laws and specimen": other_sources(toml) or "none",
        "the packages": ", ".join(f"{name} {_version(name)}" for name in PACKAGES),
        "MASONRY_LANES": os.environ.get("MASONRY_LANES", "") or "not set",
        PROCESSOR: compiled_for(),
    }


def require_same(begun: dict[str, str], here: dict[str, str], folder: Path) -> list[str]:
    """Raise SceneError where a run was begun with something else than there is here: a mixture would be neither.

    Another processor is let through: machines of a cluster differ, and the last bits at most with them. Returns what is
    to be said of it.
    """
    differs = [
        f"{what} ({begun.get(what)} then, {now} now)"
        for what, now in here.items()
        if begun.get(what) != now and what != PROCESSOR
    ]
    if differs:
        raise SceneError(
            f"the run in '{folder}' was started with another state of {'; and of '.join(differs)}; continue it "
            "with what it was started with, or run it again: "
            f"masonry run {folder / 'checkpoint' / 'scene.toml'} --out ANOTHER"
        )
    if begun.get(PROCESSOR) == here[PROCESSOR]:
        return []
    return [f"begun on another processor ({begun.get(PROCESSOR)}, here {here[PROCESSOR]}): last bits may differ"]


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "none"


def own_sources(laws: Iterable[str | None]) -> str:
    """Hash (hex) of the packages that bring some laws (None is none); "" where all are ours."""
    plugins = [plugin_law(law) for law in sorted({law for law in laws if law is not None and law not in law_names()})]
    hashes = [package_hash(law.parameters_class) for law in plugins if law is not None]
    return hashlib.sha256(" ".join(hashes).encode()).hexdigest()[:16] if hashes else ""
