"""A film of a run as a file: GIF by Pillow, which comes with matplotlib, MP4 by ffmpeg."""

import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from geometry.whole_files import whole_file
from masonry.errors import SceneError

if TYPE_CHECKING:
    from masonry.results import Result

SUFFIXES = (".gif", ".mp4")
DPI = 96.0
HOLD = 1.5
"""Seconds that the last frame stays."""


def write_film(
    result: "Result",
    path: Path | str,
    fps: int = 6,
    view: str = "front",
    times: float | None = None,
    progress: Callable[[int, int, str], None] | None = None,
) -> Path:
    """Write a .gif or .mp4 of all frames, whole or not at all; returns the path.

    fps       frames a second, 1 to 60
    view      "front", "back" or "iso"
    times     by how much displacements are drawn larger
    progress  called with (frames done, frames, a word)

    Raises SceneError for another suffix, for a result without frames and where there is no ffmpeg for an .mp4;
    GeometryError where the file cannot be written.
    """
    path = Path(path)
    if path.suffix not in SUFFIXES:
        raise SceneError(f"'{path}': a film is a .gif or .mp4 file; nearest: '{path.stem or 'movie'}.gif'")
    if not 1 <= fps <= 60:
        raise SceneError(f"{fps} frames a second: a film has 1 to 60")
    settings: Any = {} if path.suffix == ".gif" else {"animation.ffmpeg_path": _ffmpeg()}
    from matplotlib import rc_context

    from masonry.film import Film

    film = Film(result, view, times)
    with whole_file(path) as beside, rc_context(settings):
        writer = _writer(path.suffix, fps)
        try:
            _write(film, writer, beside, fps, progress)
        except subprocess.CalledProcessError as error:
            raise SceneError(f"ffmpeg could not write '{path}' ({error}); a .gif needs no ffmpeg") from None
    return path


def _write(film: Any, writer: Any, path: Path, fps: int, progress: Callable[[int, int, str], None] | None) -> None:
    whole = len(film.frames)
    with writer.saving(film.figure, str(path), DPI):
        for number in range(whole):
            film.draw(number)
            writer.grab_frame()
            if progress is not None:
                progress(number + 1, whole, f"frame {number + 1} of {whole}")
        for _ in range(round(HOLD * fps)):
            writer.grab_frame()


def _writer(suffix: str, fps: int) -> Any:
    from matplotlib.animation import FFMpegWriter, PillowWriter

    return PillowWriter(fps=fps) if suffix == ".gif" else FFMpegWriter(fps=fps, codec="h264")


def _ffmpeg() -> str:
    """The ffmpeg of the system, else that of imageio-ffmpeg."""
    if found := shutil.which("ffmpeg"):
        return found
    try:
        from imageio_ffmpeg import get_ffmpeg_exe

        return str(get_ffmpeg_exe())
    except (ImportError, RuntimeError):
        raise SceneError(
            "an .mp4 needs ffmpeg: install it, or `pip install 'masonry-dem[movie]'`; a .gif needs nothing more"
        ) from None
