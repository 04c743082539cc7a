"""The result of a run: its summary, history and specimen, and the files that hold them."""

import json
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from geometry.blocks import Joints, Specimen, TetMesh
from masonry.results import archive
from masonry.results.table import csv_text, table_of
from masonry.errors import SceneError
from masonry.runtime.finite import finite_rows, is_finite, without_nan
from masonry.runtime.folder import WholeFiles
from masonry.history import History
from masonry.results.joint_resultants import resultants_csv
from masonry.runtime.text_files import json_of, toml_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from pandas import DataFrame

    from masonry.results.table import Table
    from masonry.pictures.painter import Painter
    from masonry.pictures.curve import Peak

NUMBERS = ("summary.json", "curve.csv", "resultants.csv", "history.h5", "scene.toml", "run.log")
"""Files of a run without its pictures and fields."""
PICTURES = {"curve.png": "plot", "cracks.png": "picture"}
"""And what draws each of its pictures."""


@dataclass(repr=False)
class Result:
    """What a run leaves behind.

    summary       numbers and words of summary.json
    joint_group   (C,) index into joint_groups, the contact group of each contact point
    mesh          tets, None where every block is rigid or affine
    scene_toml    the resolved scene: enough to run it again
    log           what the run had to say, one sentence each
    resultants    column by column, what each joint between units carries at the peak and at the end
    """

    summary: dict[str, Any]
    history: History
    specimen: Specimen
    joints: Joints
    joint_group: np.ndarray
    joint_groups: tuple[str, ...]
    mesh: TetMesh | None = None
    scene_toml: str = ""
    log: list[str] = field(default_factory=list)
    resultants: dict[str, np.ndarray] = field(default_factory=dict)

    @property
    def title(self) -> str:
        """The scene's title, or its name where it has none."""
        try:
            title = toml_of(self.scene_toml, "scene").get("title")
        except SceneError:
            title = None
        return str(title or self.summary.get("scene", "masonry"))

    @property
    def has_drive(self) -> bool:
        """Whether something is driven; where nothing is, there are reactions and gauges, but no curve and no peak."""
        from masonry.laboratory.text import has_drive

        return has_drive(self.summary)

    @property
    def curve(self) -> "DataFrame | Table":
        """The rows, one a moment, in SI units (`curve.attrs["units"]`): `curve["displacement"]`, `curve["stress"]`,
        gauges, energies. A table of pandas where that is installed, else a small one of the same columns.
        """
        return table_of(self.history.rows)

    @property
    def peak(self) -> "Peak":
        """`peak.stress` (Pa) and `peak.displacement` (m) of the drive: the largest of all steps, not of the rows."""
        from masonry.pictures.curve import peak_point

        return peak_point(self)

    @property
    def energies(self) -> dict[str, float]:
        """The energy ledger at the end, J: external work, what is stored, what was dissipated and how."""
        return dict(self.summary.get("energy_j") or {})

    @property
    def trust(self) -> str:
        """How far to trust the numbers, in a sentence."""
        from masonry.laboratory.text import trust

        return trust(self.summary)

    def save(self, out: Path | str, painter: "Painter | None" = None) -> dict[str, Path]:
        """Write every file to the folder `out`, made if need be; returns file name -> path.

        Each file appears whole or not at all: numbers first, then pictures, drawn by a painter meanwhile. Values that
        are not finite are not written; the log says so. Raises OSError if the folder cannot be written to.
        """
        from masonry.results import fields, joint_fields

        folder = Path(out)
        result = self.finite()
        result.save_numbers(folder)
        if painter is not None:
            painter.begin(folder)
        with WholeFiles(folder) as grids:
            fields.write_blocks(grids.new("fields.vtkhdf"), result)
            joint_fields.write_joints(grids.new("joints.vtkhdf"), result)
        if painter is None or not painter.has_drawn():
            result.save_pictures(folder)
        fields_of = ("fields.vtkhdf", "joints.vtkhdf")
        return {name: folder / name for name in (*NUMBERS[:3], *PICTURES, *fields_of, *NUMBERS[3:])}

    def save_numbers(self, folder: Path) -> dict[str, Path]:
        """Write the files of numbers and words only, all or none; returns file name -> path. `load_history` reads them.

        Values that are not finite are not written; the log says so. Raises OSError if the folder cannot be written to.
        """
        result = self.finite()
        with WholeFiles(folder) as files:
            archive.write(files.new("history.h5"), result)
            files.text("curve.csv", csv_text(result.history.rows))
            files.text("resultants.csv", resultants_csv(result.resultants))
            files.text("scene.toml", result.scene_toml)
            files.text("run.log", "".join(line + "\n" for line in result.log))
            files.text("summary.json", json.dumps(result.summary, indent=2, allow_nan=False, default=_plain) + "\n")
        return {name: folder / name for name in NUMBERS}

    def save_pictures(self, folder: Path) -> dict[str, Path]:
        """Write curve.png and cracks.png only; returns file name -> path."""
        return {name: self.save_picture(folder, name) for name in PICTURES}

    def save_picture(self, folder: Path, name: str) -> Path:
        """Write one of PICTURES, whole or not at all."""
        with WholeFiles(folder) as pictures:
            getattr(self, PICTURES[name])(pictures.new(name))
        return folder / name

    def plot(self, path: Path | str | None = None) -> "Figure":
        """Draw the curve and the energy ledger: to a PNG file, or as a figure that a notebook shows."""
        from masonry.pictures import curve as plot

        return plot.drawn(plot.curve_figure(self), path)

    def picture(self, path: Path | str | None = None) -> "Figure":
        """Draw the deformed specimen with its cracks: to a PNG file, or as a figure that a notebook shows."""
        from masonry.pictures import crack_picture as picture, curve as plot

        return plot.drawn(picture.cracks_figure(self), path)

    def __repr__(self) -> str:
        from masonry.laboratory.text import summary_text

        return f"Result: {self.title}\n\n{summary_text(self.summary)}"

    def _repr_html_(self) -> str:
        from masonry.laboratory.notebook import html_table
        from masonry.laboratory.text import summary_rows

        return html_table(self.title, summary_rows(self.summary))

    def show(self, step: str | int | float = "peak", field: str = "opening", **how: Any) -> None:
        """Show the specimen in 3D with PyVista: all as masonry.movies.viewer.show has it. Raises SceneError where it cannot."""
        from masonry.movies.viewer import show

        show(self, step, field, **how)

    def finite(self) -> "Result":
        """The same without what is not finite: rows from the first bad one on go, so do bad frames; summary values
        become null. Each loss is a line of the log."""
        log = list(self.log)
        rows, last_step = finite_rows(self.history.rows, log)
        frames = [frame for frame in self.history.frames if is_finite(frame) and frame.step <= last_step]
        if len(frames) < len(self.history.frames):
            log.append(f"{len(self.history.frames) - len(frames)} frames with values that are not finite were dropped")
        summary = {key: without_nan(value, key, log) for key, value in self.summary.items()}
        return replace(self, summary=summary, history=History(rows, frames), log=log)


def load_history(folder: Path | str) -> Result:
    """Read a result back from summary.json and history.h5. Raises SceneError if the folder is not one of results."""
    folder = Path(folder)
    if not folder.is_dir():
        raise SceneError(f"'{folder}' is not a folder of results; `masonry run` writes one")
    for name in ("summary.json", "history.h5"):
        if not (folder / name).is_file() and (folder / "checkpoint" / "scene.toml").is_file():
            raise SceneError(f"the run in '{folder}' is not finished; continue it: masonry resume {folder}")
        if not (folder / name).is_file():
            raise SceneError(f"'{folder}' has no {name}; it is not a folder of results, or its run did not finish")
    summary = json_of(folder / "summary.json")
    if not isinstance(summary, dict):
        raise SceneError(
            f"'{folder / 'summary.json'}' is damaged (not a table of keys and values); run the scene again"
        )
    try:
        return Result(summary=summary, **archive.read(folder / "history.h5"))
    except (OSError, RuntimeError, KeyError, TypeError, ValueError, AttributeError, IndexError, OverflowError) as error:
        raise SceneError(f"'{folder / 'history.h5'}' is damaged ({f'{error}'[:300]}); run the scene again") from None


def _plain(value: Any) -> Any:
    """Numpy's numbers, arrays and paths for JSON."""
    if isinstance(value, np.generic | np.ndarray):
        return value.tolist()
    if isinstance(value, Path):
        return str(value)
    raise TypeError(f"cannot write {type(value).__name__} to summary.json")
