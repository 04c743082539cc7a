"""The files of a result without its pictures: written whole or not at all, and read back."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from masonry.errors import SceneError
from masonry.results import archive, fields
from masonry.results.data import ResultData
from masonry.results.joint_resultants import resultants_csv
from masonry.results.summary import Summary, read_summary
from masonry.results.table import csv_text
from masonry.runtime.folders.own_files import ResultFiles

NUMBERS = ("summary.json", "curve.csv", "resultants.csv", "history.h5", "scene.toml", "run.log")
"""Files of numbers and words."""
FIELDS = ("fields.vtkhdf", "joints.vtkhdf")
"""Files for ParaView."""


def save_numbers(result: ResultData, folder: Path) -> dict[str, Path]:
    """Write the files of numbers and words only, all or none; returns file name -> path. `read` reads them.

    Values that are not finite are not written; the log says so. Raises OSError if the folder cannot be written to.
    """
    result = result.finite()
    with ResultFiles(folder) as files:
        archive.write(files.new("history.h5"), result)
        files.text("curve.csv", csv_text(result.history, result.has_drive))
        files.text("resultants.csv", resultants_csv(result.resultants))
        files.text("scene.toml", result.scene_toml)
        files.text("run.log", "".join(line + "\n" for line in [*result.log, f"time: {result.summary.time}"]))
        files.text("summary.json", summary_json(result.summary))
    return {name: folder / name for name in NUMBERS}


def summary_json(summary: Summary) -> str:
    """Text of summary.json, of numbers that are all finite."""
    return json.dumps(dict(summary), indent=2, allow_nan=False, default=_plain) + "\n"


def save_fields(result: ResultData, folder: Path) -> None:
    """Write the fields of blocks and joints, both or none. Raises OSError if the folder cannot be written to."""
    from masonry.results import joint_fields  # has compiled loops, which who draws a result goes without

    with ResultFiles(folder) as grids:
        fields.write_blocks(grids.new(FIELDS[0]), result)
        joint_fields.write_joints(grids.new(FIELDS[1]), result)


def read(folder: Path | str) -> dict[str, Any]:
    """Parts of a ResultData, from summary.json and history.h5. Raises SceneError if the folder holds none."""
    folder = Path(folder)
    if not folder.is_dir():
        raise SceneError(f"'{folder}' is not a folder of results; `masonry run` writes one")
    for name in ("summary.json", "history.h5"):
        if not (folder / name).is_file() and (folder / "checkpoint" / "scene.toml").is_file():
            raise SceneError(f"the run in '{folder}' is not finished; continue it: masonry resume {folder}")
        if not (folder / name).is_file() and (folder / "limit.json").is_file():
            raise SceneError(f"'{folder}' holds a limit analysis, which has its pictures already, and no run")
        if not (folder / name).is_file():
            raise SceneError(f"'{folder}' has no {name}; it is not a folder of results, or its run did not finish")
    summary = read_summary(folder / "summary.json")
    try:
        return {"summary": summary, **archive.read(folder / "history.h5")}
    except (OSError, RuntimeError, KeyError, TypeError, ValueError, AttributeError, IndexError, OverflowError) as error:
        raise SceneError(f"'{folder / 'history.h5'}' is damaged ({f'{error}'[:300]}); run the scene again") from None


def _plain(value: Any) -> Any:
    """Records, Numpy's numbers, arrays and paths for JSON."""
    if isinstance(value, Mapping):
        return dict(value)
    if isinstance(value, np.generic | np.ndarray):
        return value.tolist()
    if isinstance(value, Path):
        return str(value)
    raise TypeError(f"cannot write {type(value).__name__} to summary.json")
