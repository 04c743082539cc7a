"""The cracks of a result at one moment, as a picture of one panel."""

from pathlib import Path
from typing import TYPE_CHECKING

from geometry.files.atomic import whole_file
from masonry.errors import SceneError, nearest
from masonry.pictures.camera import VIEWS
from masonry.pictures.crack_picture import gallery
from masonry.pictures.style import plain, write_picture
from masonry.results.frame_choice import choose
from masonry.runtime.named_file import require_picture

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from masonry.results.data import ResultData


def draw_frame(
    result: "ResultData",
    path: Path | str,
    step: str | int | float = "peak",
    view: str | None = None,
    times: float | None = None,
) -> str:
    """Write the picture (.png, .pdf or .svg) of the frame nearest to `step`, whole or not at all.

    step   as masonry.results.frame_choice.choose takes it
    view   "front", "back", "side" or "iso"; by default that which shows how it falls, else the front
    times  by how much displacements are drawn larger; by default so that they show

    Returns a sentence where the frame is not just the one that was asked for, else nothing. Raises SceneError for what
    cannot be drawn, and GeometryError where the file cannot be written.
    """
    path = Path(path)
    require_picture(path)
    figure, note = frame_figure(result, step, view, times)
    with whole_file(path) as beside:
        write_picture(figure, beside)
    return note


def frame_figure(
    result: "ResultData", step: str | int | float = "peak", view: str | None = None, times: float | None = None
) -> tuple["Figure", str]:
    """The figure of `draw_frame`, and its sentence."""
    if view is not None and view not in VIEWS:
        raise SceneError(f"view '{view}'; {nearest(view, VIEWS)}")
    chosen = choose(result, step)
    figure = gallery([(chosen.name, result, chosen.frame)], 1, view, times)
    figure.suptitle(plain(result.title), fontsize=13, wrap=True)
    return figure, chosen.note
