"""`masonry new`: a first scene of a task, with the numbers of the user, as a commented file.

Exit codes: 0 written or listed, 2 something wrong with the words or the numbers; nothing is written then.
"""

import argparse
import shlex
from pathlib import Path

from geometry.errors import GeometryError
from masonry.errors import SceneError, visible
from masonry.runtime.shell import OK, Parser
from masonry.runtime.tables import columns
from masonry.starting.starting import IMPORT, IMPORT_SAYS, NAMES, scene_of, task_of, write_scene

ITS_OWN = ("task", "out", "overwrite")
"""Words that are no numbers of a scene."""


def parser() -> Parser:
    """The words that the command knows: a parser for each task, with an option for each of its numbers."""
    words = Parser(
        prog="masonry new",
        description="Write a first scene: a commented file with your numbers, which runs as it is.",
        epilog="A bare number has the unit that the help of a task names; '8 m' and '800 mm' are taken too. Without a "
        "task: what there is. From Python: masonry.new('bridge', spans=[8, 6]).",
    )
    tasks = words.add_subparsers(dest="task", metavar="TASK", help=f"{', '.join((*NAMES, IMPORT))}")
    for name in NAMES:
        task = task_of(name)
        command = tasks.add_parser(name, help=task.says, description=f"Write a scene of {task.says}")
        for option in task.options:
            command.add_argument(
                f"--{option.name.replace('_', '-')}", metavar=option.metavar, help=option.help.replace("%", "%%")
            )
        _add_file(command, f"{name}.toml")
    blocks = tasks.add_parser(IMPORT, help=IMPORT_SAYS, description="How blocks of your own become a scene.")
    blocks.add_argument("file", nargs="?", default="FILE", metavar="FILE", help="CAD, surfaces, a mesh, or a folder")
    return words


def _add_file(words: argparse.ArgumentParser, default: str) -> None:
    words.add_argument("--out", type=Path, default=Path(default), metavar="FILE.toml", help=f"default {default}")
    words.add_argument("--overwrite", action="store_true", help="replace FILE.toml")


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code. Raises SceneError with one message before anything is written."""
    if arguments and not arguments[0].startswith("-") and arguments[0] != IMPORT:
        task_of(arguments[0])
    words = parser().parse_args(arguments)
    if words.task is None:
        print(listed())
    elif words.task == IMPORT:
        print(import_words(words.file))
    else:
        values = {name: value for name, value in vars(words).items() if name not in ITS_OWN}
        steps = _written(words, values)
        print(visible(f"{words.out}"))
        print("\n".join(f"{'next' * (n == 0):<6}{visible(step)}" for n, step in enumerate(steps)))
    return OK


def _written(words: argparse.Namespace, values: dict[str, str | None]) -> list[str]:
    """Write the scene, once it is known that it can be made; the commands that come next."""
    if words.out.suffix != ".toml":
        raise SceneError(f"--out '{words.out}': a scene is a .toml file; nearest: '{words.out.stem or 'my'}.toml'")
    try:
        _, text, steps = scene_of(words.task, values, str(words.out), "--")
    except GeometryError as error:
        raise SceneError(f"masonry new {words.task}: {error}") from None
    write_scene(words.out, text, words.overwrite)
    return steps


def listed() -> str:
    """A line for each task."""
    rows = [(f"masonry new {name}", task_of(name).says) for name in NAMES]
    rows.append((f"masonry new {IMPORT} FILE", IMPORT_SAYS))
    return "\n".join([*columns(rows), "Numbers: `masonry new bridge --help`. A packaged scene: `masonry show NAME`."])


def import_words(file: str) -> str:
    """How `masonry import` is called for a file."""
    stem = Path(file).stem if file != "FILE" else "scene"
    call = f"masonry import {shlex.quote(file)} --out {shlex.quote(f'{stem}.toml')}"
    return visible(f"{call}    (OBJ, PLY and STL hold no unit: add --unit mm; docs/import-a-wall.md)")
