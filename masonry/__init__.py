"""Masonry on the computer: discrete elements with elastic-softening contacts, tested and told how far to trust.

>>> import masonry
>>> scene = masonry.load("couplet").with_(law="linear", confinement="0.1 MPa")
>>> result = masonry.run(scene)
>>> result.peak.stress
>>> result.curve
>>> result.plot()
>>> result.save("results/couplet-linear")
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from masonry.printout import Report
    from masonry.results import Result
    from masonry.scene import Scene

__version__ = "0.1.0"


def scenes() -> dict[str, str]:
    """The scenes that come with the program: name -> title."""
    from masonry.scene.source import titles

    return titles()


def load(scene: "str | Path", overrides: Any = ()) -> "Scene":
    """The scene of a file or of a packaged name; overrides by dotted key, see `Scene.with_`. Raises SceneError."""
    from masonry.scene import load as load_scene

    return load_scene(scene, overrides)


def check(scene: "Scene") -> "Report":
    """What a scene would run, without running it: sizes, time step, expected seconds, what is left out, warnings.

    A dictionary that prints as `masonry check` does. Raises SceneError or GeometryError.
    """
    from masonry.laboratory import check as check_scene

    return check_scene(scene)


def run(scene: "Scene", threads: int = 1, progress: "Callable[[int, int, str], None] | bool | None" = None) -> "Result":
    """Run a scene to its end. Raises SceneError or GeometryError before it starts, Stopped if it runs away.

    progress  True: say how far it is; False: say nothing; None: say it in a notebook only, where the line goes when
              the run ends; or a function of step, steps and a note
    """
    from masonry.laboratory import run as run_scene
    from masonry.notebook import telling

    with telling(progress, scene.name) as tell:
        return run_scene(scene, threads, tell)


def load_result(folder: "str | Path") -> "Result":
    """Read the result of an earlier run from its folder. Raises SceneError if the folder is not one of results."""
    from masonry.results import load_history

    return load_history(folder)
