"""The command `masonry`: words from a shell to calls of the laboratory.

Exit codes: 0 done, 2 something wrong with the scene or the words, 3 stopped because the numbers could no longer be
trusted, 130 interrupted. Nothing that computes is imported before it is needed.

`masonry verify` and `masonry paper` stand on a floor above this one, `masonry sweep` in a room of its own. Their
modules are known here by name alone, and looked up when the command is called: an entry point would do the same, but be
found only after reinstalling, and cost each other command a search through all that is installed.
"""

import argparse
import importlib
import os
import re
import sys
import tomllib
from pathlib import Path
from typing import Any, NoReturn

from masonry import __version__
from masonry.errors import SceneError, Stopped

OK, USAGE, STOPPED, INTERRUPTED = 0, 2, 3, 130
LONGEST_WORD = 1000
"""Letters of a word that a message repeats."""
APART = {
    "sweep": ("masonry.sweep.command", "run a scene many times over: grid, list or Latin hypercube"),
    "verify": ("verification.command", "run cases with known answers: are the numbers right?"),
    "paper": ("verification.paper.command", "run the reference paper again: every figure and every claim"),
}
"""Commands of other rooms and floors: module with a `main` that takes the words after the command, and help."""


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one line, as every other error of masonry."""

    def error(self, message: str) -> NoReturn:
        self.exit(USAGE, f"masonry: {message}; see `{self.prog} --help`\n")


def parser() -> Parser:
    """All commands and their options."""
    main = Parser(prog="masonry", description="A laboratory for masonry by the discrete element method.")
    main.add_argument("--version", action="version", version=f"masonry {__version__}")
    commands = main.add_subparsers(dest="command", required=True, metavar="COMMAND")
    scene = Parser(add_help=False)
    scene.add_argument("scene", metavar="SCENE", help="a scene file, or the name of a packaged scene")
    scene.add_argument(
        "--set", action="append", default=[], metavar="KEY=VALUE", dest="overrides", help="change a key of the scene"
    )
    run = commands.add_parser("run", parents=[scene], help="run a scene and write its results")
    run.add_argument("--out", type=Path, metavar="DIR", help="folder for the results (default results/SCENE-N)")
    run.add_argument("--overwrite", action="store_true", help="replace results that are in DIR already")
    run.add_argument("--threads", type=_threads, default=1, metavar="N", help=f"threads, 1 (default) to {processors()}")
    run.add_argument("--quiet", action="store_true", help="say nothing unless something goes wrong")
    run.set_defaults(action=run_scene)
    check = commands.add_parser("check", parents=[scene], help="say what a scene will cost and what it leaves out")
    check.set_defaults(action=check_scene)
    export = commands.add_parser("export", parents=[scene], help="write the blocks of a scene for other programs")
    export.add_argument("--to", type=Path, required=True, metavar="FILE", help="a .step, .msh or .vtu file")
    export.set_defaults(action=export_scene)
    _add_import(commands)
    commands.add_parser("list", help="list the packaged scenes").set_defaults(action=list_scenes)
    picture = commands.add_parser("picture", parents=[scene], help="draw the specimen of a scene")
    picture.add_argument(
        "--geometry", action="store_true", required=True, help="units, cells, groups, supports, loads and sets"
    )
    picture.add_argument("--out", type=Path, metavar="FILE.png", help="the picture (default SCENE-geometry.png)")
    picture.add_argument("--view", choices=("front", "iso"), help="default: iso where the drive moves across the front")
    picture.set_defaults(action=picture_scene)
    plot = commands.add_parser("plot", help="draw the pictures of a folder of results again")
    plot.add_argument("folder", type=Path, metavar="DIR")
    plot.set_defaults(action=plot_results)
    for name, (_, words) in APART.items():
        commands.add_parser(name, help=words, add_help=False)
    commands.add_parser("doctor", help="look whether this machine has what a run needs").set_defaults(action=doctor)
    return main


def _add_import(commands: Any) -> None:
    """`masonry import` and its options."""
    words = commands.add_parser("import", help="make blocks and a scene of a CAD file, a Neper file or a mesh")
    words.add_argument("file", type=Path, metavar="FILE", help=".step .stp .iges .igs .brep .tess .msh .vtu")
    words.add_argument("--out", type=Path, required=True, metavar="SCENE.toml", help="the scene to write")
    words.add_argument("--unit", metavar="UNIT", help="what 1 in the file stands for, such as mm; STEP says so itself")
    words.add_argument("--tolerance", default="0.1 mm", metavar="LENGTH", help="gaps and overlaps up to it are mended")
    words.add_argument("--thickness", metavar="LENGTH", help="of a plane .tess file, along y")
    words.add_argument("--facet", metavar="LENGTH", help="how far flat facets may be off curved faces")
    words.add_argument("--group", action="append", default=[], metavar="PATTERN=GROUP", help="'brick*=units', by name")
    words.add_argument("--section", metavar="AREA", help="force over this area is the reported stress")
    words.add_argument("--open-gaps", action="store_true", help="leave gaps larger than the tolerance as they are")
    words.add_argument("--overwrite", action="store_true", help="replace SCENE.toml and its blocks")
    words.set_defaults(action=import_blocks)


def main(arguments: list[str] | None = None) -> int:
    """Run one command; returns the exit code."""
    from geometry.blocks import GeometryError

    try:
        code = _act(arguments)
        sys.stdout.flush()
        return code
    except (SceneError, GeometryError) as error:
        return _complain(str(error), USAGE)
    except Stopped as error:
        return _complain(str(error), STOPPED)
    except MemoryError as error:
        return _complain(f"not enough memory: {error}; look at the sizes of the scene", STOPPED)
    except KeyboardInterrupt:
        return _complain("interrupted before there were results", INTERRUPTED)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return OK


def _act(arguments: list[str] | None) -> int:
    given = sys.argv[1:] if arguments is None else arguments
    try:
        if given and given[0] in APART:
            return int(_apart(given[0]).main(given[1:]))
        words = parser().parse_args(given)
        return int(words.action(words))
    except SystemExit as leaving:
        return leaving.code if isinstance(leaving.code, int) else USAGE


def _apart(command: str) -> Any:
    """The module of a command that is not made here."""
    module = APART[command][0]
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name not in (module, module.partition(".")[0]):
            raise
        raise SceneError(f"'{command}' needs the package {module.partition('.')[0]}, which is not installed") from None


def run_scene(words: argparse.Namespace) -> int:
    """`masonry run`: everything that the run got to is written, whatever ended it."""
    from masonry import laboratory, scene
    from masonry.folder import claim, scene_name
    from masonry.progress import Progress

    loaded = scene.load(words.scene, words.overrides)
    existed = words.out is not None and words.out.exists()
    out = claim(words.scene, words.out, overwrite=words.overwrite)
    try:
        if words.quiet:
            result = laboratory.run(loaded, threads=words.threads, progress=None)
        else:
            with Progress(label=scene_name(words.scene)) as progress:
                result = laboratory.run(loaded, threads=words.threads, progress=progress)
    except BaseException as error:
        part = error.result if isinstance(error, Stopped) else None
        if part is None:
            if not existed and not any(out.iterdir()):
                out.rmdir()
            raise
        _save(part, out)
        return _complain(f"{error}\nmasonry: the results up to there are in '{out}'", STOPPED)
    paths = _save(result, out)
    if not words.quiet:
        from masonry.printout import paths_text, summary_text

        print(f"{paths_text(paths)}\n\n{summary_text(result.summary)}")
    if result.summary.get("interrupted"):
        return _complain(f"interrupted; the results up to there are in '{out}'", INTERRUPTED)
    return OK


def check_scene(words: argparse.Namespace) -> int:
    """`masonry check`."""
    from masonry import laboratory, scene
    from masonry.printout import check_text

    print(check_text(laboratory.check(scene.load(words.scene, words.overrides))))
    return OK


def export_scene(words: argparse.Namespace) -> int:
    """`masonry export`: with tets where the scene has them."""
    from geometry.export import export, require_suffix
    from masonry import scene
    from masonry.assembly import joined, meshed

    require_suffix(words.to)
    loaded = scene.load(words.scene, words.overrides)
    specimen, joints = joined(loaded)
    export(words.to, specimen, meshed(loaded, specimen.blocks, joints)[0])
    print(f"{words.to}: {specimen.blocks.count} blocks")
    return OK


def import_blocks(words: argparse.Namespace) -> int:
    """`masonry import`: a scene and a file of blocks, and a table of what was found."""
    from masonry import importing
    from masonry.import_report import report_text
    from masonry.printout import aligned
    from masonry.quantity import parse

    wishes = importing.Wishes(
        unit=None if words.unit is None else parse(_one(words.unit), "length", "--unit", "[1e-9, 1e5]"),
        tolerance=parse(words.tolerance, "length", "--tolerance", "[1e-9, 1]"),
        thickness=None if words.thickness is None else parse(words.thickness, "length", "--thickness", "[1e-9, 1e5]"),
        facet=None if words.facet is None else parse(words.facet, "length", "--facet", "[1e-9, 1e5]"),
        groups=[_group(text) for text in words.group],
        section=None if words.section is None else parse(words.section, "area", "--section", "[1e-12, 1e8]"),
        open_gaps=words.open_gaps,
    )
    report = importing.import_file(words.file, words.out, wishes, words.overwrite)
    print(aligned(report_text(report)))
    return OK


def picture_scene(words: argparse.Namespace) -> int:
    """`masonry picture --geometry`: what stands there, how it is held and what moves."""
    from masonry import scene
    from masonry.folder import scene_name
    from masonry.geometry_picture import draw_geometry

    loaded = scene.load(words.scene, words.overrides)
    out = words.out or Path(f"{scene_name(words.scene)}-geometry.png")
    print(draw_geometry(loaded, out, words.view))
    return OK


def list_scenes(words: argparse.Namespace) -> int:
    """`masonry list`: name and title of every packaged scene."""
    from masonry.scene.source import packaged

    titles = {name: tomllib.loads(file.read_text(encoding="utf-8")) for name, file in packaged().items()}
    margin = max(map(len, titles), default=0) + 2
    for name, content in titles.items():
        print(f"{name:<{margin}}{content.get('title', '')}".rstrip())
    return OK


def plot_results(words: argparse.Namespace) -> int:
    """`masonry plot`: curve.png and cracks.png again, from summary.json and history.h5."""
    from masonry.printout import paths_text
    from masonry.results import load_history

    result = load_history(words.folder)
    try:
        paths = result.save_pictures(words.folder)
    except OSError as error:
        raise SceneError(f"cannot write pictures to '{words.folder}': {error.strerror or error}") from None
    print(paths_text(paths))
    return OK


def doctor(words: argparse.Namespace) -> int:
    """`masonry doctor`: 0 if all is fine, 1 if something is missing."""
    from masonry.doctor import examine

    fine, text = examine()
    print(text)
    return OK if fine else 1


def processors() -> int:
    """How many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _one(unit: str) -> str:
    """A unit by itself means one of it."""
    return unit if unit[:1].isdigit() else f"1 {unit}"


def _group(text: str) -> tuple[str, str]:
    pattern, equals, group = text.rpartition("=")
    if not equals or not pattern or not group or "." in group or not group.isprintable():
        raise SceneError(f"--group '{text}': write PATTERN=GROUP, for example 'brick*=units'; no dot in a group")
    return pattern, group


def _threads(text: str) -> int:
    most = processors()
    if not text.isdecimal() or not 1 <= int(text) <= most:
        raise argparse.ArgumentTypeError(f"'{text}' is not a number of threads from 1 to {most}, the processors here")
    return int(text)


def _save(result: Any, out: Path) -> dict[str, Path]:
    try:
        paths: dict[str, Path] = result.save(out)
        return paths
    except OSError as error:
        raise SceneError(f"cannot write results to '{out}': {error.strerror or error}") from None


def _complain(message: str, code: int) -> int:
    """Say it so that no letter of a file can steer the terminal, and no word of it fills the screen."""
    short = re.sub(rf"(\S{{{LONGEST_WORD}}})\S+", r"\1...", message)
    plain = (c if c.isprintable() or c == "\n" else c.encode("unicode_escape").decode("ascii") for c in short)
    print(f"masonry: {''.join(plain)}", file=sys.stderr)
    return code
