"""Masonry on the computer: discrete elements with elastic-softening contacts, tested and told how far to trust.

>>> import masonry
>>> scene = masonry.load("couplet", {"law": "linear", "confinement": "0.1 MPa"})
>>> result = masonry.run(scene)
>>> result.summary["peak_stress_pa"]
>>> result.save("results/couplet-linear")
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from masonry.results import Result
    from masonry.scene import Scene

__version__ = "0.1.0"


def load(scene: "str | Path", overrides: Any = ()) -> "Scene":
    """The scene of a file or of a packaged name; overrides by dotted key. Raises SceneError."""
    from masonry.scene import load as load_scene

    return load_scene(scene, overrides)


def run(scene: "Scene", threads: int = 1, progress: "Callable[[int, int, str], None] | None" = None) -> "Result":
    """Run a scene to its end. Raises SceneError or GeometryError before it starts, Stopped if it runs away."""
    from masonry.laboratory import run as run_scene

    return run_scene(scene, threads, progress)
