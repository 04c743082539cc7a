"""`masonry picture`: the cracks of a folder of results at a moment, or (--geometry) the specimen of a scene.

Exit codes: 0 drawn, 2 something wrong with the words, the folder or the scene; nothing is written then.
"""

import argparse
import re
from pathlib import Path

from masonry.errors import SceneError, visible
from masonry.runtime.named_file import require_free
from masonry.runtime.shell import OK, Parser, add_format

VIEWS = ("front", "back", "side", "iso")


def parser() -> Parser:
    """The words that the command knows."""
    words = Parser(
        prog="masonry picture",
        description="Draw the cracks of a folder of results at a moment, or with --geometry the specimen of a scene.",
    )
    words.add_argument("source", metavar="DIR|SCENE", help="a folder of results; with --geometry a scene")
    words.add_argument("--out", type=Path, metavar="FILE", help=".png, .pdf or .svg (default DIR/STEP-VIEW.png)")
    words.add_argument("--overwrite", action="store_true", help="replace FILE, even if masonry did not draw it")
    words.add_argument(
        "--view",
        choices=VIEWS,
        help="front: its two largest extents, a wall along y; back: the same from behind; side: along the other level "
        "axis, a wall along x; iso: from the front, the right and above. Default: front, or side where it falls that "
        "way. Of a scene front and iso alone, by default the one that shows its drive",
    )
    add_format(words)
    results = words.add_argument_group("of a folder of results")
    results.add_argument(
        "--step",
        metavar="STEP",
        help="peak (default), lowest stress: lowest, last, first, number of a step, displacement: '0.05 mm', or time "
        "of a run in real time: '1.2 s'; a negative displacement with an equals sign: --step=-0.05mm",
    )
    results.add_argument("--scale", type=scale, metavar="N", help="displacements drawn N times (default: so they show)")
    scenes = words.add_argument_group("of a scene")
    scenes.add_argument("--geometry", action="store_true", help="units, cells, groups, supports, loads and sets")
    scenes.add_argument(
        "--set", action="append", default=[], metavar="KEY=VALUE", dest="overrides", help="change a key of the scene"
    )
    return words


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code. Raises SceneError with one message before anything is written."""
    words = parser().parse_args(arguments)
    _require_fitting(words)
    path, note = _of_scene(words) if words.geometry else _of_results(words)
    print(visible(f"{path}") + (f"\n{note}" if note else ""))
    return OK


def scale(text: str) -> float:
    """How many times displacements are drawn."""
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0.0 <= value <= 1e9:
        raise argparse.ArgumentTypeError(f"'{text}' is not a number from 0 to 1e9")
    return value


def _require_fitting(words: argparse.Namespace) -> None:
    """Options of one form of the command have no place in the other."""
    source, is_folder = words.source, Path(words.source).is_dir()
    if words.geometry:
        if is_folder:
            raise SceneError(
                f"'{source}' is a folder; --geometry draws a scene: `masonry picture {source}/scene.toml --geometry`"
            )
        for name, option in (("--step", words.step), ("--scale", words.scale)):
            if option is not None:
                raise SceneError(f"{name} is for a folder of results; --geometry draws a scene before it is run")
        if words.view in ("back", "side"):
            raise SceneError(f"--view {words.view} is for a folder of results; --geometry draws front or iso")
        return
    if not is_folder:
        raise SceneError(
            f"'{source}' is not a folder of results; `masonry run` writes one. "
            "To draw the specimen of a scene add --geometry"
        )
    if words.overrides:
        raise SceneError("--set changes a scene; results are as they were run. Add --geometry to draw a scene")


def _of_scene(words: argparse.Namespace) -> tuple[Path, str]:
    from masonry import scene
    from masonry.drawings.geometry_picture import draw_geometry
    from masonry.runtime.folder import scene_name

    out = words.out or Path(f"{scene_name(words.source)}-geometry.{words.format}")
    require_free(out, words.overwrite)
    loaded = scene.load(words.source, words.overrides)
    return draw_geometry(loaded, out, words.view), ""


def _of_results(words: argparse.Namespace) -> tuple[Path, str]:
    from masonry.laboratory.result import load_result
    from masonry.pictures.camera import usual_view
    from masonry.pictures.frame_picture import draw_frame

    result, step = load_result(words.source), words.step or "peak"
    view = words.view or usual_view(result)
    name = re.sub(r"[^\w.+]+", "-", re.sub(r"^\s*-", "minus ", step)).strip("-")
    out = words.out or Path(words.source) / f"{name}-{view}.{words.format}"
    require_free(out, words.overwrite)
    return out, draw_frame(result, out, step, view, words.scale)
