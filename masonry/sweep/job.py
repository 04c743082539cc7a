"""One run of many: a scene and what is set in it, and the key by which its result is found again."""

import hashlib
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from masonry.kernels.sources import ALL, source_hash

SHOWING = tuple(
    f"masonry/{name}"
    for name in (
        *("__main__.py", "cli.py", "commands.py", "shell.py", "doctor.py", "installed.py", "printout.py", "import*.py"),
        *("plot.py", "curve_axes.py", "picture.py", "crack_drawing.py", "picture_frame.py", "geometry_picture.py"),
        *("solid_view.py", "condition_marks.py", "mark_drawing.py", "face_drawing.py", "flat_drawing.py"),
        *("solid_drawing.py", "frame_choice.py", "frame_picture.py", "picture_command.py", "movie_command.py"),
        *("film.py", "film_file.py", "show.py", "stage.py", "fields.py", "joint_fields.py", "vtkhdf.py"),
        *("curve_table.py", "notebook.py", "painter.py", "figure.py", "scene/portrait.py"),
        *("law_*.py", "one_contact.py", "progress.py", "tally.py", "crew.py", "sweep/*"),
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
        digest.update(_other_sources(self.resolved))
        digest.update(_file_of_blocks(self.resolved))
        return digest.hexdigest()[:20]

    def key(self) -> str:
        """Hash (hex) of the resolved scene, of a file that its blocks come from and of the sources that compute,
        those of laws and specimens of other packages too: the same key means the same result. Raises SceneError.
        """
        return self._key


def _other_sources(toml: str) -> bytes:
    """Hash of the packages that a scene has laws or its specimen from; nothing where all are ours."""
    from masonry.own_sources import own_sources

    scene = tomllib.loads(toml)
    laws = scene.get("law"), *(contact.get("law") for contact in scene["contact"].values())
    return own_sources(laws, scene["specimen"]["kind"]).encode()


def _file_of_blocks(toml: str) -> bytes:
    """What stands in the file that a scene takes its blocks from; nothing where it has none, or it cannot be read."""
    path = tomllib.loads(toml)["specimen"].get("path")
    try:
        return Path(path).read_bytes() if path else b""
    except OSError:
        return b""
