"""`masonry view`: the model of a scene, or a folder of results, in space: a page of HTML that needs nothing beside it.

Exit codes: 0 written, 2 something wrong with the words, the scene or the folder; nothing is written then.
"""

from pathlib import Path
from typing import TYPE_CHECKING

from masonry.errors import SceneError, visible
from masonry.runtime.named_file import require_free
from masonry.runtime.shell import OK, Parser

if TYPE_CHECKING:
    from masonry.viewing.view import PageView


def parser() -> Parser:
    """The words that the command knows."""
    words = Parser(
        prog="masonry view",
        description="Write a page of HTML that shows a model before it is run, or a result frame by frame: turn it, "
        "click a block or a joint. It opens in any browser, without a network.",
    )
    words.add_argument("source", metavar="SCENE|DIR", help="a scene, or a folder of results")
    words.add_argument(
        "--set", action="append", default=[], metavar="KEY=VALUE", dest="overrides", help="change a key of the scene"
    )
    words.add_argument("--out", type=Path, metavar="FILE.html", help="default DIR/view.html, or SCENE-view.html")
    words.add_argument("--overwrite", action="store_true", help="replace FILE.html, even if masonry did not write it")
    words.add_argument("--frames", type=int, metavar="N", help="at most so many frames of a result (default 60)")
    words.add_argument("--open", action="store_true", help="open it in the browser of this machine")
    return words


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code. Raises SceneError with one message before anything is written."""
    words = parser().parse_args(arguments)
    from masonry.viewing.page import require_page

    is_folder = Path(words.source).is_dir()
    if is_folder and words.overrides:
        raise SceneError("--set changes a scene; results are as they were run")
    if words.frames is not None and not is_folder:
        raise SceneError("--frames is for a folder of results; a scene that was not run has none")
    out = words.out or default_path(words.source)
    require_page(out)
    require_free(out, words.overwrite)
    view = _of_results(words.source, words.frames) if is_folder else _of_scene(words.source, words.overrides)
    path = view.save(out, words.overwrite)
    print(visible(f"{path}"))
    if words.open:
        import webbrowser

        webbrowser.open(path.resolve().as_uri())
    return OK


def default_path(source: str) -> Path:
    """The file of a page where none is named: in the folder of results, or beside the scene's name here."""
    from masonry.runtime.folder import scene_name

    return Path(source) / "view.html" if Path(source).is_dir() else Path(f"{scene_name(source)}-view.html")


def _of_scene(source: str, overrides: list[str]) -> "PageView":
    from masonry import scene
    from masonry.viewing.view import view_of_scene

    return view_of_scene(scene.load(source, overrides))


def _of_results(folder: str, frames: int | None) -> "PageView":
    from masonry.laboratory.result import load_result
    from masonry.viewing.view import MOST, view_of_result

    return view_of_result(load_result(folder), MOST if frames is None else frames)
