"""Tasks of `masonry new`, and the scene of each from the numbers of a user."""

import tomllib
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from masonry.errors import SceneError, nearest
from masonry.runtime.named_file import require_free
from masonry.starting.task import StartTask

if TYPE_CHECKING:
    from masonry.scene import Scene

NAMES = ("arch", "bridge", "wall", "facade", "house", "earthquake", "couplet")
"""Tasks, each with a module of this room."""
IMPORT = "import"
IMPORT_SAYS = "blocks of your own, from CAD, scans or meshes"


def task_of(name: str) -> StartTask:
    """The task of this name. Raises SceneError."""
    if name not in NAMES:
        raise SceneError(f"no task {name[:60]!r}; {nearest(name, (*NAMES, IMPORT))}")
    task: StartTask = import_module(f"masonry.starting.{name}_task").TASK
    return task


def scene_of(task: str, values: Mapping[str, Any], file: str, dashes: str = "") -> tuple["Scene", str, list[str]]:
    """The checked scene of a task, its text, and the commands that come next. Raises SceneError or GeometryError for
    numbers of which no scene, or no specimen, can be made."""
    from masonry.scene import load

    text, steps = task_of(task).filled(values, file, dashes)
    scene = load({**tomllib.loads(text), "name": Path(file).stem})
    scene.specimen.build()
    return scene, text, steps


def write_scene(path: Path, text: str, overwrite: bool) -> None:
    """Write a scene, whole or not at all; a file that is there is replaced only on request. Raises SceneError."""
    from geometry.files.atomic import whole_file
    from masonry.runtime.folder import writing

    require_free(path, overwrite)
    with writing(path), whole_file(path) as beside:
        beside.write_text(text, encoding="utf-8", newline="\n")
