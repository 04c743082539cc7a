"""The result of a run, as a user holds it: what it says, draws, shows and saves."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from masonry.laboratory.text import summary_rows, summary_text
from masonry.results import store
from masonry.results.data import ResultData
from masonry.runtime.folders.own_files import ResultFiles, require_own
from masonry.runtime.tables import html_table

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from masonry.ground.spectrum import ResponseSpectrum
    from masonry.viewing.view import PageView

PICTURES = {"curve.png": "plot", "cracks.png": "picture"}
"""Each picture of a result, and the method that draws it."""


@dataclass(repr=False)
class Result(ResultData):
    """The result of a run: its data (ResultData), and what is made of them."""

    def save(self, out: Path | str) -> dict[str, Path]:
        """Write every file to the folder `out`, made if need be; returns file name -> path.

        Each file appears whole or not at all: numbers first, then fields and pictures. Values that are not finite are
        not written; the log says so. Raises OSError if the folder cannot be written to, SceneError where a file there
        that masonry did not write would be replaced; then none is written.
        """
        folder = Path(out)
        require_own(folder, (*store.NUMBERS, *store.FIELDS, *PICTURES))
        result = self.finite()
        result.save_numbers(folder)
        store.save_fields(result, folder)
        result.save_pictures(folder)
        return {name: folder / name for name in (*store.NUMBERS[:3], *PICTURES, *store.FIELDS, *store.NUMBERS[3:])}

    def save_numbers(self, folder: Path) -> dict[str, Path]:
        """Write the files of numbers and words only: see results.store.save_numbers."""
        return store.save_numbers(self, folder)

    def save_pictures(self, folder: Path, form: str = "png") -> dict[str, Path]:
        """Write curve.png and cracks.png only, or as "pdf" or "svg"; returns file name -> path."""
        require_own(folder, [Path(name).with_suffix(f".{form}").name for name in PICTURES])
        paths = [self.save_picture(folder, name, form) for name in PICTURES]
        return {path.name: path for path in paths}

    def save_picture(self, folder: Path, name: str, form: str = "png") -> Path:
        """Write one of PICTURES, whole or not at all; in another form under its name."""
        path = (folder / name).with_suffix(f".{form}")
        with ResultFiles(folder) as pictures:
            getattr(self, PICTURES[name])(pictures.new(path.name))
        return path

    def plot(self, path: Path | str | None = None) -> "Figure":
        """Draw the curve and the energy ledger: to a .png, .pdf or .svg file, or as a figure that a notebook shows."""
        from masonry.curves import curve
        from masonry.pictures import style

        return style.drawn(curve.curve_figure(self), path)

    def picture(
        self,
        path: Path | str | None = None,
        step: str | int | float | None = None,
        view: str | None = None,
        scale: float | None = None,
    ) -> "Figure":
        """Draw the deformed specimen with its cracks: to a .png, .pdf or .svg file, or as a figure that a notebook
        shows.

        step   "peak", "lowest", "last", "first", a number of a step, "0.05 mm", "1.2 s"; without it peak and end
        view   "front", "back", "side" or "iso"; scale: how many times displacements are drawn
        """
        from masonry.pictures import crack_picture, style
        from masonry.pictures.frame_picture import frame_figure

        if step is None and view is None and scale is None:
            return style.drawn(crack_picture.cracks_figure(self), path)
        return style.drawn(frame_figure(self, "peak" if step is None else step, view, scale)[0], path)

    def movie(
        self,
        path: Path | str,
        fps: int | None = None,
        view: str | None = None,
        scale: float | None = None,
        overwrite: bool = False,
    ) -> Path:
        """Write a .gif or .mp4 of all frames, cracks beside the curve: see `masonry movie`. Raises SceneError."""
        from masonry.movies.movie_file import write_movie
        from masonry.runtime.named_file import require_free

        require_free(Path(path), overwrite)
        return write_movie(self, path, fps, view, scale)

    def view(self, frames: int | None = None) -> "PageView":
        """A page of HTML with the result in space, frame by frame, at most so many (default 60): a notebook shows it,
        `.save("view.html")` writes it. Raises SceneError where it has no frames."""
        from masonry.viewing.view import MOST, view_of_result

        return view_of_result(self, MOST if frames is None else frames)

    def spectra(self, of: Sequence[str] = (), damping: float = 0.05) -> dict[str, "ResponseSpectrum"]:
        """Response spectra of the ground and of gauges of an acceleration, or of some by name, at a share of critical
        damping: `.periods` (s), `.pseudo_acceleration` (m/s2). Raises SceneError where there is none."""
        from masonry.curves.response_spectra import spectra_of

        return {spectrum.name: spectrum.answers for spectrum in spectra_of(self, tuple(of), damping)}

    def __repr__(self) -> str:
        return f"Result: {self.title}\n\n{summary_text(self.summary)}"

    def _repr_html_(self) -> str:
        return html_table(self.title, summary_rows(self.summary))

    def show(self, step: str | int | float = "peak", field: str = "opening", **how: Any) -> None:
        """Show the specimen in 3D with PyVista: see masonry.movies.viewer.show. Raises SceneError where it cannot."""
        from masonry.movies.viewer import show

        show(self, step, field, **how)


def load_result(folder: Path | str) -> Result:
    """Read a result back from its folder. Raises SceneError if the folder is not one of results."""
    return Result(**store.read(folder))
