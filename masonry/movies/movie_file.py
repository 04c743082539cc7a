"""A movie of a run as a file: GIF by Pillow, which comes with matplotlib, MP4 by ffmpeg."""

import os
import shutil
import subprocess
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from geometry.files.atomic import whole_file
from masonry.errors import SceneError, extra
from masonry.runtime.named_file import MARK

if TYPE_CHECKING:
    from masonry.movies.movie import Movie
    from masonry.results.data import ResultData

SUFFIXES = (".gif", ".mp4")
USUAL = 6
"""Frames a second."""
DPI = 96.0
HOLD = 1.5
"""Seconds that the last frame stays."""


def write_movie(
    result: "ResultData",
    path: Path | str,
    fps: int | None = None,
    view: str | None = None,
    times: float | None = None,
    progress: Callable[[int, int, str], None] | None = None,
) -> Path:
    """Write a .gif or .mp4 of all frames, whole or not at all; returns the path.

    fps       frames a second, 1 to 60; by default 6, and as many as happened in a second where the ground shakes
    view      "front", "back", "side" or "iso"; by default that which shows how it falls, else the front
    times     by how much displacements are drawn larger
    progress  called with (frames done, frames, a word)

    Raises SceneError for another suffix, for a result without frames and where there is no ffmpeg for an .mp4;
    GeometryError where the file cannot be written.
    """
    path = Path(path)
    if path.suffix not in SUFFIXES:
        raise SceneError(f"'{path}': a movie is a .gif or .mp4 file; nearest: '{path.stem or 'movie'}.gif'")
    if fps is not None and not 1 <= fps <= 60:
        raise SceneError(f"{fps} frames a second: a movie has 1 to 60")
    write = _write_gif if path.suffix == ".gif" else partial(_write_mp4, ffmpeg=_ffmpeg())
    from masonry.movies.movie import Movie

    with whole_file(path) as beside:
        beside.touch()  # before there is anything to lose
        movie = Movie(result, view, times)
        try:
            write(_shown(movie, progress), movie, beside, fps or pace(movie))
        except subprocess.CalledProcessError as error:
            raise SceneError(f"ffmpeg could not write '{path}' ({error}); a .gif needs no ffmpeg") from None
    return path


def pace(movie: "Movie") -> int:
    """Frames a second: those of the motion itself where the ground shakes, within what a movie can have."""
    times = np.array([frame.time for frame in movie.frames])
    if not movie.result.is_shaken or len(times) < 2:
        return USUAL
    return int(np.clip(round((len(times) - 1) / (times[-1] - times[0])), 1, 60))


def _shown(movie: "Movie", progress: Callable[[int, int, str], None] | None) -> Iterator[None]:
    """Show one frame after the other."""
    whole = len(movie.frames)
    for number in range(whole):
        movie.draw(number)
        yield
        if progress is not None:
            progress(number + 1, whole, f"frame {number + 1} of {whole}")


def _write_gif(shown: Iterator[None], movie: "Movie", path: Path, fps: int) -> None:
    from PIL import Image

    movie.figure.set_dpi(DPI)
    pictures = []
    for _ in shown:
        movie.figure.canvas.draw()
        pictures.append(Image.fromarray(np.array(movie.figure.canvas.buffer_rgba())[:, :, :3]))
    times = [1000.0 / fps] * (len(pictures) - 1) + [1000.0 / fps + 1000.0 * HOLD]
    pictures[0].save(path, save_all=True, append_images=pictures[1:], duration=times, loop=0, comment=MARK)


def _write_mp4(shown: Iterator[None], movie: "Movie", path: Path, fps: int, ffmpeg: str) -> None:
    from matplotlib import rc_context
    from matplotlib.animation import FFMpegWriter

    with rc_context({"animation.ffmpeg_path": ffmpeg}):
        writer = FFMpegWriter(fps=fps, codec="h264", metadata={"comment": MARK})
        with writer.saving(movie.figure, str(path), DPI):
            for _ in shown:
                writer.grab_frame()
            for _ in range(round(HOLD * fps)):
                writer.grab_frame()


def _ffmpeg() -> str:
    """The ffmpeg of the system, else that of imageio-ffmpeg; none of the current folder, where PATH names that."""
    for place in filter(os.path.isabs, os.get_exec_path()):  # `which` by itself looks here first on Windows
        for name in ("ffmpeg", "ffmpeg.exe"):
            if program := shutil.which(os.path.join(place, name)):
                return program
    try:
        from imageio_ffmpeg import get_ffmpeg_exe

        return str(get_ffmpeg_exe())
    except (ImportError, RuntimeError):
        raise SceneError(f"an .mp4 needs ffmpeg: install it, or {extra('movie')}; a .gif needs nothing more") from None
