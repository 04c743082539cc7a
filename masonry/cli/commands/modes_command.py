"""`masonry modes`: frequencies, shapes and effective masses of a scene, from the tangent stiffness of its joints.

Exit codes: 0 found, 2 something wrong with the words or the scene; nothing is written then. 130 ended by Ctrl-C.
"""

from masonry.cli.analysis_words import analysis_parser, tell_and_save
from masonry.runtime.shell import OK, Parser

VIEWS = ("front", "back", "side", "iso")


def parser() -> Parser:
    """The words that the command knows."""
    words = analysis_parser(
        "modes",
        "Find the slowest modes of a scene: frequencies, shapes and effective masses.",
        "What they say and what not: docs/modes.md.",
        VIEWS,
    )
    words.add_argument("--modes", type=int, default=6, metavar="N", help="how many (default 6)")
    words.add_argument("--pressed", action="store_true", help="only joints that press under the dead loads are closed")
    words.add_argument("--ratio", default="0.05", metavar="RATIO", help="of Rayleigh damping (default 0.05)")
    words.add_argument(
        "--between", type=int, nargs=2, metavar=("I", "J"), help="the modes that have the ratio (default 1 and 3)"
    )
    return words


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code. Raises SceneError with one message before anything is written."""
    words = parser().parse_args(arguments)
    from masonry import scene
    from masonry.modal_analysis.vibration import ModesSettings, analyse
    from masonry.quantity import parse

    between = None if words.between is None else (words.between[0], words.between[1])
    wishes = ModesSettings(words.modes, words.pressed, parse(words.ratio, "number", "--ratio"), between)
    wishes.require_sense()
    tell_and_save("modes", words, analyse(scene.load(words.scene, words.overrides), wishes))
    return OK
