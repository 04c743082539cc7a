"""Result of a limit analysis for the user: printed, drawn, saved."""

import json
from pathlib import Path
from typing import TYPE_CHECKING

from masonry.limit_analysis.envelope_picture import envelope_figure, envelope_table
from masonry.limit_analysis.limit_data import LimitData
from masonry.limit_analysis.limit_text import result_rows, result_text
from masonry.limit_analysis.pictures import mechanism_figure, thrust_figure
from masonry.pictures.style import drawn, write_picture
from masonry.runtime.folders.own_files import ResultFiles, remove_own
from masonry.runtime.named_file import remove_pictures
from masonry.runtime.tables import html_table

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class LimitResult(LimitData):
    """The answer of a limit analysis: its numbers are those of LimitData; it prints as `masonry limit` does."""

    def save(self, folder: Path | str, view: str | None = None, form: str = "png") -> list[Path]:
        """Write limit.json, mechanism.png and thrust.png, of a vehicle that travels envelope.csv and envelope.png too,
        all or none; returns their paths. form: of the pictures, "png", "pdf" or "svg"."""
        folder, names = Path(folder), ["limit.json", f"mechanism.{form}", f"thrust.{form}"]
        remove_pictures(folder, "mechanism", "thrust", "envelope")
        remove_own(folder, "envelope.csv")
        with ResultFiles(folder) as files:
            files.text("limit.json", json.dumps(self.as_data(), indent=1, allow_nan=False) + "\n")
            write_picture(mechanism_figure(self, view), files.new(names[1]))
            write_picture(thrust_figure(self, view), files.new(names[2]))
            if self.envelope is not None:
                files.text("envelope.csv", envelope_table(self.envelope))
                names += ["envelope.csv", f"envelope.{form}"]
                write_picture(envelope_figure(self), files.new(names[-1]))
        return [folder / name for name in names]

    def plot(self, path: Path | str | None = None, view: str | None = None) -> "Figure":
        """The thrust line, or of a vehicle that travels its factor over its positions: a figure, and a .png, .pdf or
        .svg file where a path is given."""
        return drawn(thrust_figure(self, view) if self.envelope is None else envelope_figure(self), path)

    def picture(self, path: Path | str | None = None, view: str | None = None) -> "Figure":
        """The mechanism, in the same way."""
        return drawn(mechanism_figure(self, view), path)

    def _repr_html_(self) -> str:
        return html_table(self.title, result_rows(self))

    def __str__(self) -> str:
        return result_text(self)

    __repr__ = __str__
