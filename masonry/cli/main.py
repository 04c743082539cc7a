"""The command `masonry`: words from a shell to calls of the laboratory.

Exit codes: 0 done, 2 something wrong with the scene or the words, 3 stopped because the numbers could no longer be
trusted, 130 interrupted, 143 terminated, 129 hung up. Nothing that computes is imported before it is needed.

Most commands with words of their own stand in `masonry/cli/commands`, `masonry verify` and `masonry paper` on a floor
above this one. Their modules are known here by name alone, and looked up when the command is called: an entry point
would do the same, but be found only after reinstalling, and cost each other command a search through all that is
installed.
"""

import argparse
import errno
import importlib
import io
import os
import sys
from pathlib import Path
from typing import Any

from geometry.errors import GeometryError
from geometry.operating_system import SYSTEM
from masonry import __version__
from masonry.cli.commands import scene_commands
from masonry.errors import SceneError, Stopped
from masonry.runtime.ending import Ended, code_of, ended_by_signals, word_of
from masonry.runtime.processors import AUTO, processors
from masonry.runtime.shell import (
    OK,
    STOPPED,
    USAGE,
    Parser,
    add_format,
    complain,
    flush_errors,
    have_streams,
    let_go_of_output,
)

APART = {
    "new": "write a first scene of a task, with your numbers: a bridge, a wall, an earthquake ...",
    "view": "a model before it is run, or a result, in space: one page of HTML to turn and click",
    "picture": "draw the cracks of results at a moment, or the specimen of a scene",
    "movie": "make a movie of a folder of results: cracks beside the curve",
    "report": "write a folder of results as one page, for others to read",
    "spectrum": "response spectra of the ground and of gauges of a folder of results",
    "limit": "the largest factor of a load that a scene bears, by limit analysis",
    "modes": "frequencies, shapes and effective masses of a scene",
    "law": "which laws there are, and what one of them does",
    "contact": "the contact table of a scene from moduli, tests or Eurocode 6",
    "record": "make a record of the ground by seed, of a stated spectrum, as CSV",
    "sweep": "run a scene many times over: grid, list or Latin hypercube",
    "sensitivity": "run a scene in several ways: what does the answer depend on?",
    "converge": "refine a scene: how far are its numbers from those without end?",
    "verify": "run cases with known answers, and compare",
    "paper": "run the reference paper again: every figure and every claim",
}
"""Commands with words of their own, and their help: `main` of a module takes the words after the command."""
OF_VERIFICATION = {"verify": "verification.command", "paper": "verification.paper.command"}
"""The modules of those of a floor above."""
BESIDE = {"new": "masonry.cli.new_command"}
"""The modules of those that are in no room of commands."""


def parser() -> Parser:
    """All commands and their options."""
    main = Parser(prog="masonry", description="A laboratory for masonry by the discrete element method.")
    main.add_argument("--version", action="version", version=f"masonry {__version__}")
    added = main.add_subparsers(dest="command", required=True, metavar="COMMAND")
    scene = Parser(add_help=False)
    scene.add_argument("scene", metavar="SCENE", help="a scene file, or the name of a packaged scene")
    scene.add_argument(
        "--set", action="append", default=[], metavar="KEY=VALUE", dest="overrides", help="change a key of the scene"
    )
    _add_run(added, scene)
    _add_resume(added)
    check = added.add_parser(
        "check", parents=[scene], help="say how long a scene will take, and which parts of the program it does not use"
    )
    check.set_defaults(action=scene_commands.check_scene)
    export = added.add_parser("export", parents=[scene], help="write the blocks of a scene for other programs")
    export.add_argument("--to", type=Path, required=True, metavar="FILE", help="a .step, .obj, .stl, .msh or .vtu file")
    export.add_argument("--overwrite", action="store_true", help="replace FILE, if it is there already")
    export.set_defaults(action=scene_commands.export_scene)
    _add_import(added)
    added.add_parser("list", help="list the packaged scenes").set_defaults(action=scene_commands.list_scenes)
    show = added.add_parser("show", help="print a packaged scene, or a scene file, to read and to copy")
    show.add_argument("scene", metavar="NAME|FILE", help="the name of a packaged scene, or a scene file")
    show.set_defaults(action=scene_commands.show_scene)
    plot = added.add_parser("plot", help="draw the pictures of a folder of results again")
    plot.add_argument("folder", type=Path, metavar="DIR")
    add_format(plot)
    plot.set_defaults(action=scene_commands.plot_results)
    for name, words in APART.items():
        added.add_parser(name, help=words, add_help=False)
    doctor = added.add_parser("doctor", help="check whether this machine has what a run needs, and computes correctly")
    doctor.add_argument("--quick", action="store_true", help="leave out the self-test, which takes ten seconds")
    doctor.add_argument(
        "--warm",
        action="store_true",
        help="compile what usual scenes need, so that no run waits for it",
    )
    doctor.set_defaults(action=scene_commands.doctor)
    return main


def _add_run(added: Any, scene: Parser) -> None:
    """`masonry run` and its options."""
    run = added.add_parser("run", parents=[scene], help="run a scene and write its results")
    run.add_argument("--out", type=Path, metavar="DIR", help="folder for the results (default results/SCENE-N)")
    run.add_argument("--overwrite", action="store_true", help="replace results that are in DIR already")
    how_many = f"threads, 1 (default) to {processors()}, or auto: as many as the scene is worth"
    run.add_argument("--threads", type=_threads, default=1, metavar="N", help=how_many)
    run.add_argument("--checkpoint-every", metavar="TIME", help="such as 10min, or never (default 5min; first after 1)")
    run.add_argument(
        "--error-bar", action="store_true", help="refine it too: how far are its numbers from those without end?"
    )
    run.add_argument("--workers", type=int, metavar="N", help="processes of --error-bar (default: processors)")
    run.add_argument("--quiet", action="store_true", help="say nothing unless something goes wrong")
    run.set_defaults(action=scene_commands.run_scene)


def _add_resume(added: Any) -> None:
    """`masonry resume` and its options."""
    words = added.add_parser("resume", help="continue a run that was interrupted or killed")
    words.add_argument("folder", type=Path, metavar="DIR", help="the folder of its results")
    words.add_argument("--threads", type=_threads, metavar="N", help="threads; default: as the run was begun")
    words.add_argument("--checkpoint-every", metavar="TIME", help="such as 10min; default: as the run was begun")
    words.add_argument("--quiet", action="store_true", help="say nothing unless something goes wrong")
    words.set_defaults(action=scene_commands.resume_run)


def _add_import(added: Any) -> None:
    """`masonry import` and its options."""
    words = added.add_parser("import", help="make blocks and a scene from CAD, surfaces, a Neper file or a mesh")
    words.add_argument(
        "file",
        type=Path,
        metavar="FILE",
        help=".step .stp .iges .igs .brep .obj .ply .stl .json .tess .msh .vtu, or a folder of .obj .ply .stl; "
        "wall.obj, dome.obj, crossvault.obj and stones come with the program",
    )
    words.add_argument("--out", type=Path, required=True, metavar="SCENE.toml", help="the scene to write")
    words.add_argument(
        "--unit",
        metavar="UNIT",
        help="what 1 in the file stands for, such as mm or inch. OBJ, PLY, STL and COMPAS hold no unit: m",
    )
    words.add_argument("--tolerance", default="0.1 mm", metavar="LENGTH", help="gaps and overlaps up to it are mended")
    words.add_argument("--thickness", metavar="LENGTH", help="of a plane .tess file, along y")
    words.add_argument("--facet", metavar="LENGTH", help="how far flat facets may be off curved faces")
    words.add_argument(
        "--group", action="append", default=[], metavar="PATTERN=GROUP", dest="groups", help="'brick*=units', by name"
    )
    words.add_argument("--section", metavar="AREA", help="force over this area is the reported stress")
    words.add_argument("--open-gaps", action="store_true", help="leave gaps larger than the tolerance as they are")
    words.add_argument("--up", default="z", metavar="AXIS", help="x, y or z: the axis of the file that points up")
    words.add_argument("--holes", metavar="LENGTH", help="holes of surfaces up to so wide are closed")
    words.add_argument("--gap", metavar="LENGTH", help="faces up to so far apart make joints; blocks stay as they are")
    words.add_argument(
        "--angle", default="20 deg", metavar="ANGLE", help="with --gap: faces look at each other within it"
    )
    words.add_argument("--overwrite", action="store_true", help="replace SCENE.toml and its blocks")
    words.set_defaults(action=scene_commands.import_blocks)


def main(arguments: list[str] | None = None) -> int:
    """Run one command; returns the exit code."""
    have_streams()
    os.environ["MPLBACKEND"] = "agg"  # a command draws files; what is set for a notebook may not exist here
    if isinstance(sys.stdout, io.TextIOWrapper):  # a letter that the terminal does not know is shown as its code
        sys.stdout.reconfigure(errors="backslashreplace")
    try:
        code = _act(arguments)
        sys.stdout.flush()
        return code
    except SceneError as error:
        return complain(error.lines, USAGE)
    except GeometryError as error:
        return complain(str(error), USAGE)
    except Stopped as error:
        return complain(str(error), STOPPED)
    except MemoryError as error:
        return complain(f"not enough memory: {error}; look at the sizes of the scene", STOPPED)
    except KeyboardInterrupt as ended:
        return complain(f"{word_of(ended)} before there were results", code_of(ended))
    except OSError as error:
        if SYSTEM.is_reader_gone(error):
            let_go_of_output()
            return OK
        if error.filename is None and error.errno in (errno.ENOSPC, errno.EIO, errno.EBADF):
            let_go_of_output()
            return complain(f"cannot write, to standard output or to a file: {error.strerror}", USAGE)
        if error.errno != errno.ENAMETOOLONG:
            raise
        return complain(f"'{error.filename}': no file can have a name as long as this; give a shorter one", USAGE)
    finally:
        _tell_where_nothing_is_kept()
        flush_errors()


def _tell_where_nothing_is_kept() -> None:
    """Where code was compiled, or would have been, and the next command has to do it again."""
    cache = sys.modules.get("geometry.jit_cache")
    for why in getattr(cache, "NOWHERE", ()):
        complain(
            f"compiled code is not kept, so each command compiles it again: {why}; set MASONRY_CACHE to another folder",
            OK,
        )


def _act(arguments: list[str] | None) -> int:
    argv = sys.argv[1:] if arguments is None else arguments
    with ended_by_signals() as command:
        try:
            if argv and argv[0] in APART:
                return int(module_of(argv[0]).main(argv[1:]))
            words = parser().parse_args(argv)
            return int(words.action(words))
        except BaseException as error:
            if command.number:  # whatever native code made of it
                raise Ended(command.number) from None
            if isinstance(error, SystemExit):
                return error.code if isinstance(error.code, int) else USAGE
            raise


def module_of(command: str) -> Any:
    """The module of a command that is not made here."""
    module = {**OF_VERIFICATION, **BESIDE}.get(command, f"masonry.cli.commands.{command}_command")
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name is None or not f"{module}.".startswith(f"{error.name}."):
            raise
        raise SceneError(
            f"'{command}' is a part of the clone of masonry-dem, and not of what pip installs from it: run it there"
        ) from None


def _threads(text: str) -> int | str:
    most = processors()
    if text == AUTO:
        return AUTO
    if not text.isdecimal() or not 1 <= int(text) <= most:
        raise argparse.ArgumentTypeError(
            f"'{text}' is not a number of threads from 1 to {most}, the processors here, nor {AUTO}"
        )
    return int(text)
