"""The result of a run: its summary, history and specimen, and the files that hold them."""

import json
import math
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any

import numpy as np

from geometry.blocks import Joints, Specimen, TetMesh
from masonry import archive
from masonry.errors import SceneError
from masonry.folder import WholeFiles
from masonry.history import UNITS, Frame, History, unit_of
from masonry.text_files import json_of, toml_of

NUMBERS = ("summary.json", "curve.csv", "history.h5", "scene.toml", "run.log")
"""Files of a run without its pictures and fields."""


@dataclass
class Result:
    """What a run leaves behind.

    summary       numbers and words of summary.json
    joint_group   (C,) index into joint_groups, the contact group of each contact point
    mesh          tets, None where every block is rigid or affine
    scene_toml    the resolved scene: enough to run it again
    log           what the run had to say, one sentence each
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

    @property
    def title(self) -> str:
        """The scene's title, or its name where it has none."""
        try:
            title = toml_of(self.scene_toml, "scene").get("title")
        except SceneError:
            title = None
        return str(title or self.summary.get("scene", "masonry"))

    def save(self, out: Path | str) -> dict[str, Path]:
        """Write every file to the folder `out`, made if need be; returns file name -> path.

        Each file appears whole or not at all: first the numbers, all together, then the pictures. Values that are not
        finite are not written; the log says so. Raises OSError if the folder cannot be written to.
        """
        from masonry import fields as vtk_fields

        folder = Path(out)
        result = self.finite()
        result.save_numbers(folder)
        with WholeFiles(folder) as fields_file:
            vtk_fields.write(fields_file.new("fields.vtkhdf"), result)
        result.save_pictures(folder)
        names = "summary.json curve.csv curve.png cracks.png fields.vtkhdf history.h5 scene.toml run.log"
        return {name: folder / name for name in names.split()}

    def save_numbers(self, folder: Path) -> dict[str, Path]:
        """Write the files of numbers and words only, all or none; returns file name -> path. `load_history` reads them.

        Values that are not finite are not written; the log says so. Raises OSError if the folder cannot be written to.
        """
        result = self.finite()
        with WholeFiles(folder) as files:
            archive.write(files.new("history.h5"), result)
            files.text("curve.csv", csv_text(result.history.rows))
            files.text("scene.toml", result.scene_toml)
            files.text("run.log", "".join(line + "\n" for line in result.log))
            files.text("summary.json", json.dumps(result.summary, indent=2, allow_nan=False, default=_plain) + "\n")
        return {name: folder / name for name in NUMBERS}

    def save_pictures(self, folder: Path) -> dict[str, Path]:
        """Write curve.png and cracks.png only; returns file name -> path."""
        with WholeFiles(folder) as pictures:
            self.plot(pictures.new("curve.png"))
            self.picture(pictures.new("cracks.png"))
        return {name: folder / name for name in ("curve.png", "cracks.png")}

    def plot(self, path: Path | str) -> None:
        """Draw the curve and the energy ledger to a PNG file."""
        from masonry import plot

        plot.write_png(plot.curve_figure(self), path)

    def picture(self, path: Path | str) -> None:
        """Draw the deformed specimen with its cracks to a PNG file."""
        from masonry import picture, plot

        plot.write_png(picture.cracks_figure(self), path)

    def finite(self) -> "Result":
        """The same without what is not finite: rows from the first bad one on go, so do bad frames; summary values
        become null. Each loss is a line of the log."""
        log = list(self.log)
        rows, last_step = _finite_rows(self.history.rows, log)
        frames = [frame for frame in self.history.frames if _is_finite(frame) and frame.step <= last_step]
        if len(frames) < len(self.history.frames):
            log.append(f"{len(self.history.frames) - len(frames)} frames with values that are not finite were dropped")
        summary = {key: _without_nan(value, key, log) for key, value in self.summary.items()}
        return replace(self, summary=summary, history=History(rows, frames), log=log)


def load_history(folder: Path | str) -> Result:
    """Read a result back from summary.json and history.h5. Raises SceneError if the folder is not one of results."""
    folder = Path(folder)
    if not folder.is_dir():
        raise SceneError(f"'{folder}' is not a folder of results; `masonry run` writes one")
    for name in ("summary.json", "history.h5"):
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


def csv_text(rows: dict[str, np.ndarray]) -> str:
    """The rows as CSV in SI units, displacement, stress and gauges first, floats to full precision."""
    first = ("displacement", "stress", *(name for name in rows if name not in UNITS))
    names = [name for name in (*first, *(name for name in UNITS if name not in first)) if name in rows]
    lines = [",".join(f"{name} [{unit_of(name)}]" for name in names)]
    columns = [np.asarray(rows[name]).tolist() for name in names]
    lines += [",".join(map(repr, values)) for values in zip(*columns, strict=True)]
    return "\n".join(lines) + "\n"


def _finite_rows(rows: dict[str, np.ndarray], log: list[str]) -> tuple[dict[str, np.ndarray], float]:
    """The rows before the first that is not finite, and the last step that frames may have."""
    if not rows:
        return {}, math.inf
    good = np.logical_and.reduce([np.isfinite(values) for values in rows.values()])
    if good.all():
        return dict(rows), math.inf
    first = int(np.argmin(good))
    bad = ", ".join(name for name, values in rows.items() if not np.isfinite(values[first]))
    log.append(f"{len(good) - first} rows were dropped: from row {first + 1} on, {bad} is not finite")
    kept = {name: values[:first] for name, values in rows.items()}
    return kept, float(kept["step"][-1]) if first and "step" in kept else -math.inf


def _is_finite(frame: Frame) -> bool:
    return all(np.isfinite(getattr(frame, entry.name)).all() for entry in fields(frame))


def _without_nan(value: Any, key: str, log: list[str]) -> Any:
    if isinstance(value, dict):
        return {name: _without_nan(entry, f"{key}.{name}", log) for name, entry in value.items()}
    if isinstance(value, list | tuple):
        return [_without_nan(entry, key, log) for entry in value]
    if isinstance(value, float | np.floating) and not math.isfinite(value):
        log.append(f"summary: {key} is not finite and was left empty")
        return None
    return value


def _plain(value: Any) -> Any:
    """Numpy's numbers, arrays and paths for JSON."""
    if isinstance(value, np.generic | np.ndarray):
        return value.tolist()
    if isinstance(value, Path):
        return str(value)
    raise TypeError(f"cannot write {type(value).__name__} to summary.json")
