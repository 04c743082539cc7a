"""One run of many: a scene and what is set in it, and the key by which its result is found again."""

import hashlib
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from geometry.block_file import LARGEST
from geometry.blocks import GeometryError
from geometry.whole_files import require_file
from masonry.kernels.sources import ALL, source_hash

SHOWING = tuple(
    f"masonry/{name}"
    for name in (
        *("__main__.py", "cli.py", "commands.py", "shell.py", "doctor.py", "printout.py", "import*.py"),
        *("plot.py", "curve_axes.py", "picture.py", "crack_drawing.py", "picture_frame.py", "geometry_picture.py"),
        *("solid_view.py", "condition_marks.py", "mark_drawing.py", "fields.py"),
        *("progress.py", "tally.py", "crew.py", "sweep/*"),
    )
)
"""Sources that a result does not depend on: an edit of these runs nothing again."""


@dataclass(frozen=True)
class Job:
    """One run.

    scene     a packaged scene's name or a path
    settings  dotted key -> value, as `masonry.load(scene, settings)` takes them
    label     what progress calls it; where none is given, what is set in it and not in all others
    """

    scene: str | Path
    settings: Mapping[str, Any] = field(default_factory=dict)
    label: str = ""

    @cached_property
    def resolved(self) -> str:
        """The resolved scene as TOML: all that its run needs. Raises SceneError."""
        from masonry.scene import load, to_toml

        return to_toml(load(self.scene, self.settings))

    @cached_property
    def _key(self) -> str:
        digest = hashlib.sha256(self.resolved.encode())
        digest.update(source_hash(ALL, SHOWING).encode())
        digest.update(_file_of_blocks(self.resolved))
        return digest.hexdigest()[:20]

    def key(self) -> str:
        """Hash (hex) of the resolved scene, of a file that its blocks come from and of the sources that compute:
        the same key means the same result. Raises SceneError.
        """
        return self._key


def _file_of_blocks(toml: str) -> bytes:
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
