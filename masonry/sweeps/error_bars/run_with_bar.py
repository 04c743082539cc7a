"""A run whose numbers have bars: its refinements lie in a folder within that of its results, and are gone on with."""

from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from masonry.errors import SceneError
from masonry.runtime.processors import processors

if TYPE_CHECKING:
    from masonry.laboratory.laboratory import Progress
    from masonry.laboratory.result import Result
    from masonry.runtime.progress import Tell
    from masonry.scene import Scene
    from masonry.sweeps.convergence.convergence import Convergence

FOLDER = "convergence"
CURVE = "curve.csv"
"""By which the run in a folder of results is known to be that of the scene that was refined."""


def require_refinable(scene: "Scene") -> None:
    """Raise SceneError where a scene has nothing that could be refined."""
    from masonry.sweeps.convergence.refinement.resolutions import resolutions_of

    if not resolutions_of(scene):
        raise SceneError(f"--error-bar: '{scene.name}' has nothing that could be refined; masonry run does without")


def begin_refinement(scene: "Scene", results: Path, overwrite: bool = False) -> None:
    """Make the folder of the refinements, with the scene in it, before the scene is run into `results`: so it is known
    that a bar was asked for, whatever ends the run. Raises SceneError, also where something else is there."""
    from masonry.runtime.folder import writing
    from masonry.runtime.folders.own_files import remove_own
    from masonry.sweeps.convergence.convergence import DOING, TABLE
    from masonry.sweeps.study_folder import begin

    require_refinable(scene)
    folder = begin(scene, FOLDER, TABLE, DOING, results / FOLDER, overwrite)
    with writing(folder):
        remove_own(folder, TABLE)


def is_begun(results: Path) -> bool:
    """Whether a bar was asked for of the run in a folder, and is not there yet."""
    folder = results / FOLDER
    return (folder / "scene.toml").is_file() and not (folder / "convergence.json").exists()


def forget(results: Path) -> None:
    """Leave no word of a bar beside a run that left nothing to go on with."""
    from masonry.runtime.folder import CHECKPOINT
    from masonry.runtime.folders.own_files import LIST, remove_own

    if (results / CHECKPOINT / "scene.toml").is_file() or not is_begun(results):
        return
    folder = results / FOLDER
    remove_own(folder, "scene.toml")
    for path in (folder, results):
        if {entry.name for entry in path.iterdir()} <= {LIST}:
            (path / LIST).unlink(missing_ok=True)
            path.rmdir()


def refine(
    results: Path, workers: int, tell: "Tell | None" = None, is_new: bool = False, form: str = "png"
) -> "Convergence":
    """Refine the scene that was run into a folder, and put the bars into its summary.json and its curve.png.

    is_new  its run has just come to its end: it is the scene as it is, which is not run once more
    Raises SceneError where the results are those of another scene, or of another version.
    """
    from masonry.laboratory.result import load_result
    from masonry.runtime.lock import sole
    from masonry.scene import load
    from masonry.sweeps.convergence.convergence import DOING, converge
    from masonry.sweeps.convergence.error_record import record_of, write_record
    from masonry.sweeps.job import Job

    folder = results / FOLDER
    scene = load(folder / "scene.toml")
    with sole(results, DOING):
        if is_new:
            _take_along(results, folder, Job(scene).key())
        result = converge(scene, folder, workers=workers, tell=tell)
        if not result.has_come_to_its_end:
            return result
        same = folder / "runs" / result.runs[0][1]["key"] / CURVE
        if same.read_bytes() != (results / CURVE).read_bytes():
            raise SceneError(
                f"'{results}' holds a run of another scene, or of another version, than '{folder}': run it again with "
                "--error-bar"
            )
        write_record(results, record_of(result.errors, result.runs))
        load_result(results).save_picture(results, "curve.png", form)
    return result


def _take_along(results: Path, folder: Path, key: str) -> None:
    """Have a run be one of those in a folder."""
    from masonry.results.store import NUMBERS
    from masonry.sweeps.run_store import Store
    from masonry.sweeps.work import OK, RunEnd

    store = Store(folder)
    if store.row(key) is None:
        files = {name: (results / name).read_bytes() for name in NUMBERS}
        store.keep(key, RunEnd(OK, "", 0.0, files))


def run_refined(scene: "Scene", threads: int | str = 1, progress: "Progress | None" = None) -> "Result":
    """Result of a run with its bars, by processes side by side of which nothing stays. Raises as a run does; one that
    was interrupted has none."""
    from masonry.laboratory.laboratory import run
    from masonry.results.records.convergence_record import NUMERICAL_ERROR
    from masonry.sweeps.convergence.convergence import converge
    from masonry.sweeps.convergence.error_record import record_of
    from masonry.sweeps.job import Job

    require_refinable(scene)
    result = run(scene, threads, progress)
    if result.summary.interrupted:
        return result
    tell = None if progress is None else lambda line: progress(0, 0, line)
    with TemporaryDirectory(prefix="masonry-") as place:
        folder = Path(place) / FOLDER
        begin_refinement(scene, folder.parent)
        result.save_numbers(folder.parent)
        _take_along(folder.parent, folder, Job(scene).key())
        refined = converge(scene, folder, workers=processors(), tell=tell)
    return replace(result, summary=result.summary | {NUMERICAL_ERROR: record_of(refined.errors, refined.runs)})
