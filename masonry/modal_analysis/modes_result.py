"""Result of a modal analysis for the user: printed, drawn, saved."""

import json
from pathlib import Path
from typing import TYPE_CHECKING

from masonry.modal_analysis.mode_pictures import modes_figure
from masonry.modal_analysis.modes_data import ModesData
from masonry.modal_analysis.modes_text import head_rows, mode_table, note_rows, result_text
from masonry.pictures.style import drawn, write_picture
from masonry.runtime.folders.own_files import ResultFiles
from masonry.runtime.tables import html_columns, html_table

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class ModesResult(ModesData):
    """The modes of a scene: its numbers are those of ModesData; it prints as `masonry modes` does."""

    def save(self, folder: Path | str, view: str | None = None, form: str = "png") -> list[Path]:
        """Write modes.json and, where there are modes, modes.png, all or none; returns their paths.

        form: of the picture, "png", "pdf" or "svg"
        """
        folder = Path(folder)
        with ResultFiles(folder) as files:
            files.text("modes.json", json.dumps(self.as_data(), indent=1, allow_nan=False) + "\n")
            if not len(self.frequencies):
                return [folder / "modes.json"]
            write_picture(modes_figure(self, view), files.new(f"modes.{form}"))
        return [folder / name for name in ("modes.json", f"modes.{form}")]

    def picture(self, path: Path | str | None = None, view: str | None = None) -> "Figure":
        """The shapes of the modes: a figure, and a .png, .pdf or .svg file where a path is given."""
        return drawn(modes_figure(self, view), path)

    def _repr_html_(self) -> str:
        head, *rows = mode_table(self)
        table = html_columns(head, rows)
        return html_table(self.title, head_rows(self)) + table + html_table("", note_rows(self))

    def __str__(self) -> str:
        return result_text(self)

    __repr__ = __str__
