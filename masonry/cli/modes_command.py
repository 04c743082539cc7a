"""`masonry modes`: frequencies, shapes and effective masses of a scene, from the tangent stiffness of its joints.

Exit codes: 0 found, 2 something wrong with the words or the scene; nothing is written then. 130 ended by Ctrl-C.
"""

import json
from pathlib import Path

from masonry.errors import visible
from masonry.runtime.shell import OK, Parser, add_format

VIEWS = ("front", "back", "side", "iso")


def parser() -> Parser:
    """The words that the command knows."""
    words = Parser(
        prog="masonry modes",
        description="Find the slowest modes of a scene: frequencies, shapes and effective masses.",
        epilog="What they say and what not: docs/modes.md.",
    )
    words.add_argument("scene", metavar="SCENE", help="a scene file, or the name of a packaged scene")
    words.add_argument(
        "--set", action="append", default=[], metavar="KEY=VALUE", dest="overrides", help="change a key of the scene"
    )
    words.add_argument("--out", type=Path, metavar="DIR", help="folder for the results (default results/SCENE-modes-N)")
    words.add_argument("--overwrite", action="store_true", help="replace results that are in DIR already")
    words.add_argument("--json", action="store_true", help="print modes.json, and write no files unless DIR is given")
    words.add_argument("--view", choices=VIEWS, help="of the picture; default: the one that shows what moves")
    words.add_argument("--modes", type=int, default=6, metavar="N", help="how many (default 6)")
    words.add_argument("--pressed", action="store_true", help="only joints that press under the dead loads are closed")
    words.add_argument("--ratio", default="0.05", metavar="RATIO", help="of Rayleigh damping (default 0.05)")
    words.add_argument(
        "--between", type=int, nargs=2, metavar=("I", "J"), help="the modes that have the ratio (default 1 and 3)"
    )
    add_format(words)
    return words


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code. Raises SceneError with one message before anything is written."""
    from masonry import scene
    from masonry.modal_analysis.vibration import ModesSettings, analyse
    from masonry.quantity import parse
    from masonry.runtime.folder import claimed, scene_name, writing

    words = parser().parse_args(arguments)
    between = None if words.between is None else (words.between[0], words.between[1])
    wishes = ModesSettings(words.modes, words.pressed, parse(words.ratio, "number", "--ratio"), between)
    wishes.require_sense()
    result = analyse(scene.load(words.scene, words.overrides), wishes)
    print(json.dumps(result.as_data(), indent=1) if words.json else result)
    if words.json and words.out is None:
        return OK
    name = f"{scene_name(words.scene)}-modes"
    with claimed(name, words.out, overwrite=words.overwrite) as folder, writing(folder):
        paths = result.save(folder, words.view, words.format)
    if not words.json:
        print("\n".join(visible(f"{path}") for path in paths))
    return OK
