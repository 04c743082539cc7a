"""Functions of `masonry` that do what a command of the shell does, by the same code; each is small."""

import importlib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from masonry.laboratory.arguments import speaking_python

if TYPE_CHECKING:
    from masonry.drawings.law_report import LawReport
    from masonry.ground.made_record import MadeRecord
    from masonry.importing.report import ImportReport
    from masonry.laboratory.result import Result
    from masonry.scene import Scene
    from masonry.sweeps.convergence.convergence import Convergence
    from masonry.viewing.view import PageView

    SceneLike = Scene | str | Path | Mapping[str, Any]

VERIFICATION = "verification.command"
"""It stands on a floor above `masonry`, and is looked up when it is called."""


def scenes() -> dict[str, str]:
    """The scenes that come with the program: name -> title.

    >>> masonry.scenes()["couplet"]
    'Couplet under confinement and shear'
    """
    from masonry.scene.source import titles

    return titles()


@speaking_python
def import_blocks(
    source: str | Path, out: str | Path | None = None, overwrite: bool = False, **words: Any
) -> "ImportReport":
    """Blocks and a scene from CAD, surfaces, COMPAS, Neper or meshes: see docs/import.md for what is read.

    out    the scene to write, NAME.toml, with its blocks beside it; without it the blocks stand in the scene itself
    words  as of `masonry import`: unit="mm", tolerance="0.1 mm", gap="5 mm", up="y", groups={"brick*": "units"}, ...
    What comes back prints as the command does; `.scene`, `.specimen`, `.joints`, `.notes`. Raises SceneError or
    GeometryError; then nothing is written.

    >>> dome = masonry.import_blocks("dome.obj", gap="5 mm")  # ships with the program
    >>> dome.specimen.blocks.count, len(dome.joints.patch_start) - 1
    (90, 250)
    """
    from masonry.importing.import_words import settings_of
    from masonry.importing.importing import import_file
    from masonry.laboratory.arguments import flag, path

    target = None if out is None else path("out", out)
    return import_file(path("source", source), target, settings_of(words), flag("overwrite", overwrite))


@speaking_python
def new(task: str, out: str | Path | None = None, overwrite: bool = False, **numbers: Any) -> "Scene":
    """A first scene of a task: arch, bridge, wall, facade, house, earthquake or couplet, with the numbers of the user.

    out      a file, NAME.toml, to write as `masonry new` does, with comments; without it nothing is written
    numbers  options of `masonry new TASK --help`, _ for -: numbers in the unit that it names, texts with a unit, lists
    All else is a stated assumption of the scene. Raises SceneError or GeometryError; then nothing is written.

    >>> bridge = masonry.new("bridge", spans=[8, 6], axles=[90, 90])
    >>> bridge.title
    'Bridge of 2 spans (8 m, 6 m) under a vehicle of 2 axles'
    >>> bare = masonry.new("facade", height=3, thickness="40 cm", returns=0, door_width=0)
    >>> print(f"{masonry.limit(bare).factor:.4f}")  # by hand thickness / height
    0.1333
    """
    from masonry.laboratory.arguments import flag, path
    from masonry.starting.starting import scene_of, task_of, write_scene

    target = path("out", f"{task_of(task).name}.toml" if out is None else out)
    scene, text, _ = scene_of(task, numbers, str(target))
    if out is not None:
        write_scene(target, text, flag("overwrite", overwrite))
    return scene


@speaking_python
def write_blocks(
    path: str | Path,
    blocks: Sequence[Any],
    names: Sequence[str] | None = None,
    groups: str | Sequence[str] = "units",
    units: Sequence[int] | None = None,
    section: str | None = None,
    tolerance: str = "0.1 mm",
    open_gaps: bool = False,
) -> Path:
    """Write blocks of your own to a file, NAME.blocks.h5, which a scene names: kind = "file", path = "NAME.blocks.h5".

    blocks     for each a pair of vertices (V, 3) in m and faces, lists of vertex numbers: flat polygons or triangles;
               or a mesh with `vertices` and `faces` (trimesh) or `to_vertices_and_faces()` (COMPAS)
    names      of each block, "" for none: sets of the scene; several blocks may share one
    groups     of blocks: pick material, kinematics and contact group; one for all, or one for each
    units      number of the unit that each block is part of; each is a unit of its own where left out
    section    area such as "0.05 m^2" that turns a force into the reported stress; that of the faces in the lowest
               plane where left out
    tolerance  gaps and overlaps between facing faces are mended up to this length
    open_gaps  gaps larger than the tolerance stay open; else those of up to ten times of it are refused
    Returns the path. Raises GeometryError, with the block to blame, for bodies that are not closed or not flat, or that
    overlap, SceneError for the rest; then nothing is written.

    >>> import numpy as np
    >>> corners = np.array([[x, y, z] for x in (0, 0.2) for y in (0, 0.1) for z in (0, 0.1)])  # (8, 3) m
    >>> faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    >>> blocks = [(corners, faces), (corners + [0, 0, 0.1], faces)]
    >>> masonry.write_blocks("two.blocks.h5", blocks, names=["lower", "upper"]).name
    'two.blocks.h5'
    """
    from masonry.importing.block_writing import write_blocks as write

    return write(path, blocks, names, groups, units, section, tolerance, open_gaps)


@speaking_python
def converge(
    scene: "SceneLike",
    out: str | Path | None = None,
    of: Sequence[str] = (),
    to: str | float | None = None,
    cost: float | None = None,
    workers: Any = None,
    tell: Callable[[str], None] | None = None,
    form: str = "png",
    modes: int | None = None,
) -> "Convergence":
    """Refine a scene: how far are its numbers from what the same model gives when it is refined without end?

    scene    a scene, a file of one, the name of a packaged one, or a dictionary
    out      folder of results; without it the next free results/SCENE-convergence-N
    of       numbers of summary.json by dotted name; peak, displacement there and so on where none is named
    to       an error, "1 %" or 0.01: settings whose numbers have no larger one are chosen as well
    cost     times the scene itself that all other runs may take: 6 where none is given, with tets 8
    workers  processes (default: all processors; 0: in this one), or what does the runs in their place: a Dask client,
             the address of its scheduler, an executor of concurrent.futures; tell is called with a line a run that ends
    form     of the picture: "png", "pdf" or "svg"
    modes    the frequencies of so many modes, in place of the numbers of a run
    What comes back prints as `masonry converge` does; `.errors` has value, limit, error and the half_width of the 95 %
    interval of each number. Raises SceneError or GeometryError before anything runs.

    >>> scene = masonry.load("couplet", {"confinement": "0.1 MPa"})
    >>> dissipated = masonry.converge(scene, of=["energy_j.friction"], workers=1).errors[0]
    >>> dissipated.at_most < 0.01 * dissipated.value
    True
    """
    from masonry.errors import SceneError
    from masonry.importing.handed_blocks import scene_of
    from masonry.laboratory.arguments import called, number, path, whole, words
    from masonry.sweeps.convergence.convergence import converge as refine
    from masonry.sweeps.convergence.refinement.analyses import frequency_keys

    folder = None if out is None else path("out", out)
    workers = whole("workers", workers, 0, 10_000) if isinstance(workers, int | float) else workers
    cost, tell = None if cost is None else number("cost", cost, 1.0, 1e6), called("tell", tell, None)
    numbers = words("of", of) if modes is None else frequency_keys(whole("modes", modes, 1, 100))
    if of and modes is not None:
        raise SceneError("of names numbers, and modes the frequencies of so many modes: leave one of them out")
    return refine(scene_of(scene), folder, numbers, to, cost, workers, tell, form=form)


@speaking_python
def export(scene: "SceneLike", to: str | Path, overwrite: bool = False) -> Path:
    """Write the blocks of a scene for other programs: a .step, .obj, .stl, .msh or .vtu file, with tets where it has
    them. Raises SceneError or GeometryError; then nothing is written.

    >>> masonry.export("couplet", "couplet.step").name
    'couplet.step'
    """
    from masonry.laboratory.arguments import flag, path

    target = path("to", to)
    write_export(scene, target, flag("overwrite", overwrite))
    return target


def write_export(scene: "SceneLike", to: Path, overwrite: bool) -> int:
    """See `export`; returns how many blocks were written."""
    from geometry.files.export import export as write
    from geometry.files.export import require_suffix
    from masonry.assembly.assemble import joined, meshed
    from masonry.importing.handed_blocks import scene_of
    from masonry.runtime.named_file import require_free

    require_suffix(to)
    require_free(to, overwrite)
    loaded = scene_of(scene)
    specimen, joints = joined(loaded)
    write(to, specimen, meshed(loaded, specimen.blocks, joints)[0])
    return specimen.blocks.count


def resume(folder: str | Path, threads: int | str | None = None) -> "Result":
    """Go on with a run of `masonry run` that was interrupted or killed, from its last checkpoint to its end.

    Its results are written to the folder; of a run that is finished they are read. Raises SceneError, or Stopped.

    >>> files = masonry.run(masonry.load("couplet", {"drive.accuracy": "10 %"})).save("done")
    >>> print(f"{masonry.resume('done').peak.stress / 1e6:.2f} MPa")
    1.37 MPa
    """
    from masonry.errors import Stopped
    from masonry.laboratory import arguments
    from masonry.laboratory.result import load_result
    from masonry.laboratory.run_command import resume_in
    from masonry.runtime.processors import processors
    from masonry.runtime.shell import OK, STOPPED
    from masonry.sweeps.error_bars.run_with_bar import is_begun, refine

    place = arguments.path("folder", folder)
    code = resume_in(place, None if threads is None else arguments.threads(threads))
    if code == OK and is_begun(place):
        refine(place, processors())
    result = load_result(place)
    if code == STOPPED:
        stop = Stopped(str(result.summary.stopped))
        stop.result = result
        raise stop
    return result


def law(name: str, settings: Mapping[str, Any] | None = None, plot: str | Path | None = None) -> "LawReport":
    """Response of a contact under a law: parameters, energies as measured, values that the law refuses.

    settings  keys of the contact, {"cohesion": "0.6 MPa"}; the others are those of the couplet and the law's examples
    plot      a .png file to draw it to
    It prints as `masonry law` does; `.portrait` has the curves. Raises SceneError.

    >>> linear = masonry.law("linear", {"fracture_energy_mode_1": "10 N/m"})
    >>> print(f"{linear.portrait.mode_1.whole:.2f} N/m")
    10.00 N/m
    """
    from masonry.drawings.law_report import report_of
    from masonry.laboratory.arguments import path

    report = report_of(name, [f"{key}={value}" for key, value in (settings or {}).items()])
    if plot is not None:
        report.draw(path("plot", plot))
    return report


def record(
    to: str | Path | None = None, components: int = 1, overwrite: bool = False, **keys: Any
) -> dict[str, "MadeRecord"]:
    """Records of the ground made by seed, by component: `.time` (s), `.acceleration` (m/s2), `.spectrum`, `.target`.

    to    a .csv file to write, which a scene names as ground.record
    keys  of [ground.made] in a scene: spectrum, soil, a_g, duration, seed, ...
    Raises SceneError.

    >>> made = masonry.record(spectrum="eurocode-8-1", soil="B", a_g="0.2 g", duration="20 s", seed=1)
    >>> list(made), made["first"].mismatch < 0.1
    (['first'], True)
    """
    from masonry.curves.made_record_files import made_records, require_csv, write_records
    from masonry.laboratory.arguments import flag, path

    target = None if to is None else path("to", to)
    if target is not None:
        require_csv(target, flag("overwrite", overwrite))
    records = made_records(keys, components)
    if target is not None:
        write_records(target, records)
    return records


def load_result(folder: str | Path) -> "Result":
    """Read the result of an earlier run from its folder. Raises SceneError if the folder is not one of results.

    >>> files = masonry.run(masonry.load("couplet", {"confinement": "0.1 MPa"})).save("couplet-0.1")
    >>> result = masonry.load_result("couplet-0.1")
    >>> print(f"{result.peak.stress / 1e6:.2f} MPa")
    0.97 MPa
    """
    from masonry.laboratory.arguments import path
    from masonry.laboratory.result import load_result

    return load_result(path("folder", folder))


@speaking_python
def report(result: "Result | str | Path", path: str | Path, *, overwrite: bool = False) -> Path:
    """Write a result, or a folder of results, as one page (.html) for others; overwrite: a file that is not ours too.
    Raises SceneError for another suffix, for what is no result, and where such a file stands.

    >>> masonry.report(masonry.run("couplet"), "couplet.html").name
    'couplet.html'
    """
    from masonry.reporting.run_report import report_of

    return report_of(result, path, overwrite)


@speaking_python
def view(source: "SceneLike | Result", frames: int | None = None) -> "PageView":
    """A page of HTML with the model of a scene, or a result or a folder of results, in space: a notebook shows it,
    `.save("view.html")` writes it.

    frames  of a result, at most so many (default 60)
    Raises SceneError or GeometryError.

    >>> masonry.view("couplet").save("couplet.html").name
    'couplet.html'
    """
    from masonry.errors import SceneError
    from masonry.importing.handed_blocks import scene_of
    from masonry.laboratory.arguments import whole
    from masonry.laboratory.result import Result, load_result
    from masonry.viewing.view import view_of_scene

    frames = None if frames is None else whole("frames", frames, 2, 100_000)
    if isinstance(source, str | Path) and Path(source).is_dir():
        source = load_result(source)
    if isinstance(source, Result):
        return source.view(frames)
    if frames is not None:
        raise SceneError("frames: of a result; a scene that was not run has none")
    return view_of_scene(scene_of(source))


def verify(*cases: str, full: bool = False, workers: int = 2, tell: Callable[[str], None] | None = None) -> Any:
    """Run cases with known answers, by name; without any the quick ones, with `full` all. It prints as
    `masonry verify` does; `.holds`, `.outcomes`. Raises SceneError.

    workers  processes; 0: all in this one, which scripts need not guard
    tell     is called with a line for each case that ends

    >>> masonry.verify("incline", workers=0).holds
    True
    """
    return importlib.import_module(VERIFICATION).verify(cases, full, workers, tell)
