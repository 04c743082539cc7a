"""The folder of a study of one scene, which holds the scene and its runs, and is gone on with."""

from pathlib import Path

from masonry.errors import SceneError
from masonry.runtime.folder import claim_for_many, scene_name, writing
from masonry.runtime.folders.own_files import ResultFiles
from masonry.runtime.lock import sole
from masonry.runtime.text_files import text_of
from masonry.scene import Scene, to_toml

SCENE = "scene.toml"
LARGEST = 100_000_000
"""Bytes of a scene."""


def begin(scene: Scene, study: str, table: str, doing: str, out: Path | None, overwrite: bool = False) -> Path:
    """The folder for a study of this scene, with the scene in it: `out`, or the next free `results/NAME-STUDY-N`.

    study  a word for it        table  the file that is there once all runs are done
    doing  what another process is told meanwhile
    A study of the same scene that was not finished is gone on with. Raises SceneError where `out` holds anything else
    (without `overwrite`), or cannot be written to.
    """
    text = to_toml(scene)

    def difference(folder: Path) -> str | None:
        if not (folder / SCENE).is_file():
            return None
        return "" if _holds(folder, text) else "runs of another scene"

    folder = claim_for_many(f"{scene_name(scene.name)}-{study}", out, overwrite, difference, table)
    with writing(folder), sole(folder, doing), ResultFiles(folder) as files:
        files.text(SCENE, text)
    return folder


def _holds(folder: Path, text: str) -> bool:
    """Whether a folder was made for this very scene."""
    try:
        return (folder / SCENE).is_file() and text_of(folder / SCENE, LARGEST) == text
    except SceneError:
        return False
