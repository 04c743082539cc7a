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
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from masonry.comparison.sensitivity import Sensitivity
    from masonry.laboratory.text import Report
    from masonry.results.data import Result
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


def check(scene: "Scene | str | Path") -> "Report":
    """What a scene would run, without running it: sizes, time step, expected seconds, what is not compiled, warnings.

    scene  a scene, a file of one, or the name of a packaged one
    A dictionary that prints as `masonry check` does. Raises SceneError or GeometryError.
    """
    from masonry.laboratory.laboratory import check as check_scene

    return check_scene(_scene(scene))


def run(
    scene: "Scene | str | Path", threads: int = 1, progress: "Callable[[int, int, str], None] | bool | None" = None
) -> "Result":
    """Run a scene to its end. Raises SceneError or GeometryError before it starts, Stopped if it runs away.

    scene     a scene, a file of one, or the name of a packaged one
    progress  True: say how far it is; False: say nothing; None: say it in a notebook only, where the line goes when
              the run ends; or a function of step, steps and a note
    """
    from masonry.laboratory.laboratory import run as run_scene
    from masonry.laboratory.notebook import telling

    scene = _scene(scene)
    with telling(progress, scene.name) as tell:
        return run_scene(scene, threads, tell)


def sensitivity(
    scene: "Scene | str | Path",
    out: "str | Path | None" = None,
    only: "Sequence[str]" = (),
    quick: bool = False,
    workers: int | None = None,
    tell: "Callable[[str], None] | None" = None,
) -> "Sensitivity":
    """Run a scene with other damping, pace, coupling, kinematics, unloading, plates, cells and seeds, side by side.

    scene    a scene, a file of one, or the name of a packaged one
    out      folder of results; without it the next free results/SCENE-sensitivity-N
    only     kinds of variants; all that make sense for the scene where none is named
    quick    one variant of each kind, and none of the slow kinds
    workers  processes (default: all processors); tell is called with a line for each run that ends
    What comes back prints as `masonry sensitivity` does; `.rows` are dictionaries. Processes are started afresh, so a
    script needs `if __name__ == "__main__":`. Raises SceneError or GeometryError before anything runs.
    """
    from masonry.comparison.sensitivity import sensitivity as compare

    return compare(_scene(scene), out, only, quick, workers, tell)


def load_result(folder: "str | Path") -> "Result":
    """Read the result of an earlier run from its folder. Raises SceneError if the folder is not one of results."""
    from masonry.results.data import load_history

    return load_history(folder)


def _scene(scene: "Scene | str | Path") -> "Scene":
    """A scene as it is, else the one of that file or packaged name. Raises SceneError."""
    from masonry.scene import Scene

    return scene if isinstance(scene, Scene) else load(scene)
