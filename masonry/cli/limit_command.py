"""`masonry limit`: the largest factor of a load that a scene bears, by limit analysis; pictures of how it fails.

Exit codes: 0 found, 2 something wrong with the words or the scene, or it has no limit, 130 ended by Ctrl-C; nothing is
written then.
"""

import json
from pathlib import Path

from masonry.errors import SceneError, visible
from masonry.runtime.shell import OK, Parser, add_format

VIEWS = ("front", "iso")


def parser() -> Parser:
    """The words that the command knows."""
    words = Parser(
        prog="masonry limit",
        description="Find the largest factor of a load that forces in the joints can balance, by limit analysis.",
        epilog="What it can say and what not, and the table [limit] of a scene: docs/limit-analysis.md.",
    )
    words.add_argument("scene", metavar="SCENE", help="a scene file, or the name of a packaged scene")
    words.add_argument(
        "--set", action="append", default=[], metavar="KEY=VALUE", dest="overrides", help="change a key of the scene"
    )
    words.add_argument("--out", type=Path, metavar="DIR", help="folder for the results (default results/SCENE-limit-N)")
    words.add_argument("--overwrite", action="store_true", help="replace results that are in DIR already")
    words.add_argument("--json", action="store_true", help="print limit.json, and write no files unless DIR is given")
    words.add_argument("--view", choices=VIEWS, help="of the pictures; default: the one that shows what moves")
    words.add_argument("--no-dilation", action="store_true", help="friction without dilation, which gives no bound")
    words.add_argument("--no-strength", action="store_true", help="leave out cohesion and tension")
    words.add_argument("--crushing", metavar="STRESS", help="compressive strength of the joints, such as '5 MPa'")
    words.add_argument("--safety", action="store_true", help="the factor of safety on friction and cohesion instead")
    words.add_argument("--at", type=float, default=0.0, metavar="FACTOR", help="load factor for --safety (default 0)")
    words.add_argument("--linear", type=int, metavar="N", help="in space: friction pyramids of N sides, not cones")
    words.add_argument("--points", choices=("corners", "scene"), default="corners", help="default corners of joints")
    add_format(words)
    return words


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code. Raises SceneError with one message before anything is written."""
    from masonry import scene
    from masonry.limit_analysis.analysis import LimitSettings, analyse
    from masonry.limit_analysis.expected import LimitProgress
    from masonry.quantity import parse
    from masonry.runtime.folder import claimed, scene_name, writing

    words = parser().parse_args(arguments)
    if not -1e9 <= words.at <= 1e9:
        raise SceneError(f"--at {words.at}: a number from -1e9 to 1e9")
    if words.linear is not None and not 3 <= words.linear <= 1000:
        raise SceneError(f"--linear {words.linear}: a number of sides from 3 to 1000")
    crushing = None if words.crushing is None else parse(words.crushing, "stress", "--crushing", "(0, 1e15]")
    wishes = LimitSettings(
        dilation=not words.no_dilation, strength=not words.no_strength, safety=words.safety, at=words.at,
        crushing=crushing, points=words.points, sides=words.linear or 0,
    )  # fmt: skip
    loaded = scene.load(words.scene, words.overrides)
    with LimitProgress() as progress:
        result = analyse(loaded, wishes, progress)
    print(json.dumps(result.as_data(), indent=1) if words.json else result)
    if words.json and words.out is None:
        return OK
    name = f"{scene_name(words.scene)}-limit"
    with claimed(name, words.out, overwrite=words.overwrite) as folder, writing(folder):
        paths = result.save(folder, words.view, words.format)
    if not words.json:
        print("\n".join(visible(f"{path}") for path in paths))
    return OK
