"""`masonry sensitivity`: one scene run in several ways that should not matter, side by side in one table and picture.

Exit codes: 0 the table is there; 2 something wrong with the words or the scene, and nothing was run; 3 the scene as it
is did not come to its end; 130 interrupted, 143 terminated: what is done stays, and the same command goes on.
"""

from typing import TYPE_CHECKING

from masonry.cli.study_words import add_folder, add_scene, require_workers, unless_interrupted
from masonry.errors import visible
from masonry.runtime.shell import OK, STOPPED, Parser, tell
from masonry.runtime.tables import columns

if TYPE_CHECKING:
    from masonry.scene import Scene

EPILOG = "What is varied and what the table says: docs/sensitivity.md."


def parser() -> Parser:
    """The words that the command knows."""
    words = Parser(
        prog="masonry sensitivity",
        description="Run a scene again with other damping, pace, coupling, kinematics, unloading, softening variable, "
        "plates, cells and seeds: what does the answer rest on?",
        epilog=EPILOG,
    )
    add_scene(words)
    words.add_argument("--only", metavar="KINDS", help="kinds of variants, with commas: pace,plates (default: all)")
    words.add_argument("--quick", action="store_true", help="one variant of each kind, and none of the slow kinds")
    words.add_argument("--list", action="store_true", help="say what each run would set, and run nothing")
    add_folder(words, "sensitivity")
    return words


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code. Raises SceneError with one message before anything is written."""
    words = parser().parse_args(arguments)
    require_workers(words)
    only = [kind.strip() for kind in words.only.split(",")] if words.only is not None else []

    from masonry import scene
    from masonry.sweeps.sensitivity.sensitivity import CSV, PICTURE, sensitivity
    from masonry.sweeps.sensitivity.study import TABLE

    loaded = scene.load(words.scene, words.overrides)
    if words.list:
        print(_listing(loaded, only, words.quick))
        return OK
    heard = None if words.quiet else tell
    study, code = unless_interrupted(
        lambda: sensitivity(loaded, words.out, only, words.quick, words.workers, heard, words.overwrite, words.format)
    )
    if study is None:
        return code
    if not words.quiet:
        print(f"{study}\n")
        names = (CSV, TABLE, f"{PICTURE}.{words.format}")
        print("\n".join(visible(f"{study.folder / name}") for name in names))
    if study.rows[0]["status"] != "OK":
        tell(f"masonry: the scene as it is: {study.rows[0]['trust_sentence']}")
        return STOPPED
    return OK


def _listing(loaded: "Scene", only: list[str], quick: bool) -> str:
    from masonry.assembly.assemble import assemble
    from masonry.sweeps.sensitivity.variants import variants

    rows = [
        (variant.kind, variant.name, ", ".join(f"{key} = {value!r}" for key, value in variant.settings.items()))
        for variant in variants(assemble(loaded), only, quick)
    ]
    return "\n".join(map(visible, columns(rows)))
