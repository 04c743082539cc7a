"""`masonry movie`: a movie of a folder of results, cracks beside the curve.

Exit codes: 0 written, 2 something wrong with the words or the folder, 130 interrupted; nothing is written then.
"""

from pathlib import Path

from masonry.cli.commands.picture_command import VIEWS, scale
from masonry.errors import visible
from masonry.runtime.named_file import require_free
from masonry.runtime.shell import OK, Parser


def parser() -> Parser:
    """The words that the command knows."""
    words = Parser(
        prog="masonry movie",
        description="Movie a folder of results: the cracks beside the curve, one picture for each frame that was kept.",
        epilog="More frames: `masonry run SCENE --set solver.frames=100`.",
    )
    words.add_argument("folder", type=Path, metavar="DIR", help="a folder of results")
    words.add_argument("--to", type=Path, metavar="FILE", help=".gif or .mp4 (default DIR/movie.gif)")
    words.add_argument("--overwrite", action="store_true", help="replace FILE, even if masonry did not make it")
    words.add_argument(
        "--fps", type=int, metavar="N", help="frames a second (default 6, or real time where the ground shakes)"
    )
    words.add_argument("--view", choices=VIEWS, help="default front, or side where it falls that way")
    words.add_argument("--scale", type=scale, metavar="N", help="displacements drawn N times (default: so they show)")
    return words


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code. Raises SceneError with one message before anything is written."""
    words = parser().parse_args(arguments)
    from masonry.laboratory.result import load_result
    from masonry.movies.movie_file import write_movie
    from masonry.runtime.progress import Progress

    result, to = load_result(words.folder), words.to or words.folder / "movie.gif"
    require_free(to, words.overwrite)
    with Progress(label="movie") as progress:
        path = write_movie(result, to, words.fps, words.view, words.scale, progress)
    print(visible(f"{path}"))
    return OK
