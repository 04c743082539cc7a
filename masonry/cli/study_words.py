"""Words that commands share which run one scene many times over: its changes, the folder, processes and pictures."""

from argparse import ArgumentParser, Namespace
from collections.abc import Callable
from pathlib import Path
from typing import Any

from masonry.errors import SceneError
from masonry.runtime.ending import code_of, word_of
from masonry.runtime.processors import processors
from masonry.runtime.shell import add_format, tell


def add_scene(words: ArgumentParser) -> None:
    """The scene and what is changed in all its runs."""
    words.add_argument("scene", metavar="SCENE", help="a scene file, or the name of a packaged scene")
    words.add_argument(
        "--set", action="append", default=[], metavar="KEY=VALUE", dest="overrides", help="change a key in all runs"
    )


def add_folder(words: ArgumentParser, study: str) -> None:
    """Where the results go, by how many processes, and how much is said; study is a word in the folder's name."""
    words.add_argument("--out", type=Path, metavar="DIR", help=f"folder (default results/SCENE-{study}-N)")
    words.add_argument("--overwrite", action="store_true", help="replace the table of another scene in DIR")
    words.add_argument("--workers", type=int, default=processors(), metavar="N", help="processes (default: processors)")
    add_format(words)
    words.add_argument("--quiet", action="store_true", help="say nothing unless something goes wrong")


def require_workers(words: Namespace) -> None:
    """Raise SceneError for a number of processes that is none."""
    if words.workers < 0:
        raise SceneError(f"--workers {words.workers}: 0 (all in this process) or more")


def unless_interrupted(study: Callable[[], Any]) -> tuple[Any, int]:
    """The result of a study and 0, or None and the exit code of the interrupt that ended it."""
    try:
        return study(), 0
    except KeyboardInterrupt as ended:
        tell(f"masonry: {word_of(ended)}; what is done stays, and the same command continues from there")
        return None, code_of(ended)
