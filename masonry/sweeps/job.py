"""One run of many: a scene and what is set in it, the key by which its result is found again, and its name."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from masonry.jit.sources import ALL, source_hash
from masonry.laboratory.summary.provenance import SHOWING, file_of_blocks, files_of_records, other_sources


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
        digest.update(other_sources(self.resolved).encode())
        digest.update(file_of_blocks(self.resolved))
        digest.update(files_of_records(self.resolved))
        return digest.hexdigest()[:20]

    def key(self) -> str:
        """Hash (hex) of the resolved scene, of files that its blocks and its motion come from and of the sources that
        compute, those of laws of other packages too: the same key means the same result. Raises SceneError.
        """
        return self._key


def names(jobs: Sequence[Job]) -> list[str]:
    """What to call each of many jobs in the lines that say how far they are: its label, else the settings in which it
    differs from the others, or the scene.
    """
    keys = dict.fromkeys(key for job in jobs for key in job.settings)
    varied = [key for key in keys if len({repr(job.settings.get(key)) for job in jobs}) > 1]
    scenes = len({str(job.scene) for job in jobs}) > 1 or not varied
    return [job.label or " ".join([str(job.scene)] * scenes + _settings(job, varied)) for job in jobs]


def _settings(job: Job, keys: Sequence[str]) -> list[str]:
    return [f"{key.rsplit('.', 1)[-1]}={_short(job.settings[key])}" for key in keys if key in job.settings]


def _short(value: Any) -> str:
    """A value with four digits: a name is no place for more."""
    if isinstance(value, float):
        return f"{value:.4g}"
    number, _, unit = f"{value}".partition(" ")
    try:
        return f"{float(number):.4g} {unit}" if unit else f"{value}"
    except ValueError:
        return f"{value}"
