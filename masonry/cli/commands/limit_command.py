"""`masonry limit`: the largest factor of a load that a scene bears, by limit analysis; pictures of how it fails.

Exit codes: 0 found, 2 something wrong with the words or the scene, or it has no limit, 130 ended by Ctrl-C; nothing is
written then.
"""

from masonry.cli.analysis_words import analysis_parser, tell_and_save
from masonry.errors import SceneError
from masonry.runtime.shell import OK, Parser

VIEWS = ("front", "iso")


def parser() -> Parser:
    """The words that the command knows."""
    words = analysis_parser(
        "limit",
        "Find the largest factor of a load that forces in the joints can balance, by limit analysis.",
        "What it can say and what not, and the table [limit] of a scene: docs/limit-analysis.md.",
        VIEWS,
    )
    words.add_argument("--no-dilation", action="store_true", help="friction without dilation, which gives no bound")
    words.add_argument("--no-strength", action="store_true", help="leave out cohesion and tension")
    words.add_argument("--crushing", metavar="STRESS", help="compressive strength of the joints, such as '5 MPa'")
    words.add_argument("--safety", action="store_true", help="the factor of safety on friction and cohesion instead")
    words.add_argument("--at", type=float, default=0.0, metavar="FACTOR", help="load factor for --safety (default 0)")
    words.add_argument("--linear", type=int, metavar="N", help="in space: friction pyramids of N sides, not cones")
    words.add_argument("--points", choices=("corners", "scene"), default="corners", help="default corners of joints")
    return words


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code. Raises SceneError with one message before anything is written."""
    words = parser().parse_args(arguments)
    if not -1e9 <= words.at <= 1e9:
        raise SceneError(f"--at {words.at}: a number from -1e9 to 1e9")
    if words.linear is not None and not 3 <= words.linear <= 1000:
        raise SceneError(f"--linear {words.linear}: a number of sides from 3 to 1000")
    from masonry import scene
    from masonry.limit_analysis.analysis import LimitSettings, analyse
    from masonry.limit_analysis.expected import LimitProgress
    from masonry.quantity import parse

    crushing = None if words.crushing is None else parse(words.crushing, "stress", "--crushing", "(0, 1e15]")
    wishes = LimitSettings(
        dilation=not words.no_dilation, strength=not words.no_strength, safety=words.safety, at=words.at,
        crushing=crushing, points=words.points, sides=words.linear or 0,
    )  # fmt: skip
    loaded = scene.load(words.scene, words.overrides)
    with LimitProgress() as progress:
        result = analyse(loaded, wishes, progress)
    tell_and_save("limit", words, result)
    return OK
