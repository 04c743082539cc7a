"""A scene's sensitivity to choices that should not matter: run, written, and kept for a Python user."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from masonry.assembly.assemble import assemble
from masonry.assembly.growing_loads import require_axles_to_load
from masonry.errors import SceneError
from masonry.runtime.folder import writing
from masonry.runtime.folders.own_files import ResultFiles
from masonry.runtime.lock import sole
from masonry.runtime.named_file import FORMATS, remove_pictures, require_format
from masonry.runtime.processors import processors
from masonry.runtime.progress import Tell
from masonry.scene import Scene
from masonry.sweeps.sensitivity import study_table
from masonry.sweeps.sensitivity.study import DOING, TABLE, study
from masonry.sweeps.sensitivity.variants import variants
from masonry.sweeps.study_folder import begin

PICTURE, CSV = "sensitivity", "sensitivity.csv"


@dataclass(frozen=True, repr=False)
class Sensitivity:
    """Result of a scene and its variants; it prints as `masonry sensitivity` does.

    folder  of the runs, the table (sensitivity.csv, sensitivity.json) and the picture (sensitivity.png)
    rows    a dictionary for each run, the scene as it is first: see `study`
    """

    folder: Path
    rows: list[dict[str, Any]]

    def __repr__(self) -> str:
        return study_table.text(self.rows)


def sensitivity(
    scene: Scene,
    out: str | Path | None = None,
    only: Sequence[str] = (),
    quick: bool = False,
    workers: int | None = None,
    tell: Tell | None = None,
    overwrite: bool = False,
    form: str = FORMATS[0],
) -> Sensitivity:
    """Run a scene in several ways, in processes side by side, and compare them.

    out      folder, else the next free results/SCENE-sensitivity-N; what is done of this scene there is kept
    only     kinds of variants, such as ["pace", "plates"]; all that make sense where none is named
    quick    one variant of each kind, without those that cost several times the base
    workers  processes (default: all processors; 0: one run after the other in this one)
    tell     is called with a line for each run that ends
    form     of the picture, one of FORMATS
    Raises SceneError or GeometryError before anything runs. A variant that cannot be built, or is stopped, is a row.
    """
    require_format(form)
    require_axles_to_load(scene)
    chosen = variants(assemble(scene), only, quick)
    if workers is not None and workers < 0:
        raise SceneError(f"{workers} workers: 0 (all in this process) or more")
    folder = begin(scene, "sensitivity", TABLE, DOING, None if out is None else Path(out), overwrite)
    if tell is not None:
        tell(f"{len(chosen)} runs, results in '{folder}'")
    with sole(folder, DOING):
        rows = study(scene, folder, chosen, processors() if workers is None else workers, tell)
        _write(scene, folder, rows, form)
    return Sensitivity(folder, rows)


def _write(scene: Scene, folder: Path, rows: list[dict[str, Any]], form: str) -> None:
    """Table and picture, all or none; the picture is left out where no run left a curve."""
    from masonry.pictures.style import write_picture
    from masonry.sweeps.sensitivity.picture import figure_of

    with writing(folder):
        remove_pictures(folder, PICTURE)
        with ResultFiles(folder) as files:
            files.text(CSV, study_table.as_csv(rows))
            files.text(TABLE, study_table.as_json(rows))
            if any((folder / "runs" / row["key"] / "history.h5").is_file() for row in rows):
                write_picture(figure_of(scene.title or scene.name, folder, rows), files.new(f"{PICTURE}.{form}"))
