"""One run of many: a scene and what is set in it, the key by which its result is found again, and its name."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from masonry.jit.sources import ALL, source_hash
from masonry.laboratory.summary.provenance import SHOWING, file_of_blocks, files_of_records, other_sources
from masonry.sweeps.work import ModesTask

if TYPE_CHECKING:
    from masonry.scene import Scene


class TensileStrength(NamedTuple):
    """Pa: as a scene has it, and as its law takes it."""

    of_scene: float
    of_law: float

    @property
    def is_cut(self) -> bool:
        """Whether the law takes less than it was told."""
        return self.of_law < self.of_scene


def _tensile_strengths(scene: "Scene") -> dict[str, TensileStrength]:
    """The strengths of contacts in tension: cut at the apex of the Coulomb line, 0 where next to nothing."""
    from masonry.laws.building.factory import properties_of, tensile_strength

    strengths = {}
    for group, contact in scene.contact.items():
        properties, strength = contact.properties(), contact.tensile_strength
        reads = "tensile_strength" in properties_of(contact.law)
        if reads and strength is not None and None not in (properties.cohesion, properties.tan_friction):
            strengths[f"contact.{group}.tensile_strength"] = TensileStrength(strength, tensile_strength(properties))
    return strengths


@dataclass(frozen=True)
class Job:
    """One run.

    scene     a scene, a packaged scene's name or a path
    settings  dotted key -> value, as `masonry.load(scene, settings)` takes them
    label     what progress calls it; where none is given, what is set in it and not in all others
    modes     number of its slowest modes that are computed in place of a run; 0: it is run
    """

    scene: "Scene | str | Path"
    settings: Mapping[str, Any] = field(default_factory=dict)
    label: str = ""
    modes: int = 0

    @cached_property
    def _loaded(self) -> tuple[str, dict[str, "TensileStrength"]]:
        from masonry.scene import Scene, changed, load, to_toml

        of, settings = self.scene, self.settings
        scene = changed(of, settings) if isinstance(of, Scene) else load(of, settings)
        return to_toml(scene), _tensile_strengths(scene)

    @property
    def resolved(self) -> str:
        """The resolved scene as TOML: all that its run needs. Raises SceneError."""
        return self._loaded[0]

    @property
    def task(self) -> str | ModesTask:
        """Task of a worker. Raises SceneError."""
        return ModesTask(self.resolved, self.modes) if self.modes else self.resolved

    @property
    def tensile_strengths(self) -> dict[str, "TensileStrength"]:
        """By dotted key, those of its contacts whose law reads them."""
        return self._loaded[1]

    @property
    def scene_name(self) -> str:
        """Name of its scene."""
        return str(self.scene) if isinstance(self.scene, str | Path) else self.scene.name

    @cached_property
    def _key(self) -> str:
        digest = hashlib.sha256(self.resolved.encode())
        digest.update(source_hash(ALL, SHOWING).encode())
        digest.update(other_sources(self.resolved).encode())
        digest.update(file_of_blocks(self.resolved))
        digest.update(files_of_records(self.resolved))
        digest.update(f"{self.modes} modes".encode() if self.modes else b"")
        return digest.hexdigest()[:20]

    def key(self) -> str:
        """Hash (hex) of the resolved scene, of files that its blocks and its motion come from and of the sources that
        compute, those of laws of other packages too: the same key means the same result. Raises SceneError.
        """
        return self._key


def names(jobs: Sequence[Job]) -> list[str]:
    """Names of many jobs in the lines that say how far they are: of each its label, else the settings in which it
    differs from the others, or the scene.
    """
    keys = dict.fromkeys(key for job in jobs for key in job.settings)
    varied = [key for key in keys if len({repr(job.settings.get(key)) for job in jobs}) > 1]
    scenes = len({job.scene_name for job in jobs}) > 1 or not varied
    return [job.label or " ".join([job.scene_name] * scenes + _settings(job, varied)) for job in jobs]


def _settings(job: Job, keys: Sequence[str]) -> list[str]:
    return [f"{key.rsplit('.', 1)[-1]}={short_text(job.settings[key])}" for key in keys if key in job.settings]


def short_text(value: Any) -> str:
    """A value with four digits, and its unit: names and pictures are no place for more."""
    if isinstance(value, float):
        return f"{value:.4g}"
    number, _, unit = f"{value}".partition(" ")
    try:
        return f"{float(number):.4g} {unit}" if unit else f"{value}"
    except ValueError:
        return f"{value}"
