"""Masonry on the computer: discrete elements with elastic-softening contacts, tested and told how far to trust.

>>> import masonry
>>> scene = masonry.load("couplet").with_(confinement="0.1 MPa")
>>> result = masonry.run(scene)
>>> print(f"{result.peak.stress / 1e6:.2f} MPa")
0.97 MPa
>>> figure = result.plot("curve.png")
>>> files = result.save("results/couplet-0.1")
"""

import os
import sys

if sys.argv[:1] == ["-m"] and sys.path[0] == os.getcwd() != os.path.dirname(os.path.dirname(__file__)):
    del sys.path[0]  # by `python -m masonry` it is the current folder, with whatever lies beside a scene

from collections.abc import Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any

from masonry.laboratory.arguments import speaking_python
from masonry.shell_functions import (
    converge,
    export,
    import_blocks,
    law,
    load_result,
    new,
    record,
    report,
    resume,
    scenes,
    verify,
    view,
    write_blocks,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from geometry.errors import GeometryError
    from masonry.errors import SceneError, Stopped
    from masonry.laboratory.result import Result
    from masonry.laboratory.text import Report
    from masonry.limit_analysis.limit_result import LimitResult
    from masonry.materials.contact_table import ContactTable
    from masonry.modal_analysis.modes_result import ModesResult
    from masonry.scene.checked_scene import Scene
    from masonry.sweeps.convergence.convergence import Convergence
    from masonry.sweeps.sensitivity.sensitivity import Sensitivity
    from masonry.sweeps.sweep_run import SweepResult
    from masonry.viewing.view import PageView

    SceneLike = Scene | str | Path | Mapping[str, Any]

__all__ = [
    "check", "contact", "converge", "export", "import_blocks", "law", "limit", "load", "load_result", "modes", "new",
    "record", "report", "resume", "run", "scenes", "sensitivity", "sweep", "verify", "view", "write_blocks",
    "ContactTable", "Convergence", "GeometryError", "LimitResult", "ModesResult", "PageView", "Report", "Result",
    "Scene", "SceneError", "Sensitivity", "Stopped", "SweepResult",
]  # fmt: skip
CLASSES = {  # that functions give back and raise, and their modules
    "ContactTable": "masonry.materials.contact_table",
    "Convergence": "masonry.sweeps.convergence.convergence",
    "GeometryError": "geometry.errors",
    "LimitResult": "masonry.limit_analysis.limit_result",
    "ModesResult": "masonry.modal_analysis.modes_result",
    "PageView": "masonry.viewing.view",
    "Report": "masonry.laboratory.text",
    "Result": "masonry.laboratory.result",
    "Scene": "masonry.scene",
    "SceneError": "masonry.errors",
    "Sensitivity": "masonry.sweeps.sensitivity.sensitivity",
    "Stopped": "masonry.errors",
    "SweepResult": "masonry.sweeps.sweep_run",
}
__version__ = "0.2.0"


def __getattr__(name: str) -> Any:
    """One of CLASSES, imported when it is asked for: what reads a scene brings pydantic and numpy with it."""
    if name not in CLASSES:
        raise AttributeError(f"module 'masonry' has no attribute '{name}'")
    return getattr(import_module(CLASSES[name]), name)


def __dir__() -> list[str]:
    """The names that a user has."""
    return [*__all__, "__version__"]


def load(scene: "str | Path | Mapping[str, Any]", overrides: Any = ()) -> "Scene":
    """The scene of a file, a packaged name or a dictionary of its tables; overrides by dotted key, see `Scene.with_`.

    The specimen of a dictionary may be blocks: a `Specimen` or `Blocks` of `geometry`, a list of (vertices, faces) in
    m, or a table with such `blocks` and with names, groups, units, tolerance, open_gaps as in `write_blocks`. They
    become part of the scene. Raises SceneError or GeometryError.

    >>> scene = masonry.load("couplet", {"contact.unit_unit.cohesion": "0.6 MPa"})
    >>> scene.contact["unit_unit"].cohesion  # Pa, as all that a scene holds is in SI
    600000.0
    >>> thick = masonry.load({"base": "arch-tilted", "specimen": {"thickness": "0.25 m"}})
    >>> print(f"{masonry.limit(thick).factor:.3f}, {masonry.limit('arch-tilted').factor:.3f}")
    0.684, 0.374
    """
    from masonry.scene import load as load_scene

    return load_scene(_packed(scene), _packed(overrides))


@speaking_python
def contact(scene: "SceneLike | None" = None, **known: Any) -> "ContactTable":
    """The contact table of a scene from moduli, tests or the tables of Eurocode 6, with the source of each number.

    scene  the one that it is for: it then has its kinematics, divisions and heights
    known  what is known, as texts with their unit: the options of `masonry contact` with _ for -; `triplets` may be
           pairs of pressure and shear strength
    What comes back prints as TOML, and is what `Scene.with_` takes. Its `tables` are those of a scene file, its
    `ranges` (SI) what a sensitivity should vary, its `notes` what to mind. Raises SceneError.

    >>> joint = masonry.contact("couplet", unit="clay", unit_strength="20 MPa", mortar="M5", joint="10 mm")
    >>> joint["contact.unit_unit"]["cohesion"], joint["contact.unit_unit"]["tan_friction_angle"]
    ('0.25 MPa', 0.5)
    >>> couplet = masonry.load("couplet").with_(joint)
    >>> couplet.contact["unit_unit"].cohesion  # Pa
    250000.0
    """
    from masonry.materials.contact_data import ContactData
    from masonry.materials.contact_table import ContactTable
    from masonry.materials.scene_data import with_scene

    return ContactTable(ContactData(known if scene is None else with_scene(known, _scene(scene))))


@speaking_python
def check(scene: "SceneLike") -> "Report":
    """Sizes, time step, expected seconds, parts not compiled and warnings of a scene, without running it.

    scene  a scene, a file of one, the name of a packaged one, or a dictionary
    A dictionary that prints as `masonry check` does. Raises SceneError or GeometryError.

    >>> report = masonry.check("couplet")
    >>> report["blocks"], report["contact_points"], report["freedoms"]
    (2, 4, 12)
    """
    from masonry.sweeps.error_bars.check_line import checked

    return checked(_scene(scene))


@speaking_python
def run(
    scene: "SceneLike",
    threads: int | str = 1,
    progress: "Callable[[int, int, str], None] | bool | None" = None,
    error_bar: bool = False,
) -> "Result":
    """Run a scene to its end. Raises SceneError or GeometryError before it starts, Stopped if it runs away.

    scene     a scene, a file of one, the name of a packaged one, or a dictionary
    threads   their number, or "auto": as many as the scene is worth; no bit depends on it
    progress  True: say how far it is; False: say nothing; None: say it in a notebook only, where the line goes when
              the run ends; or a function of step, steps and a note
    error_bar True: it is refined as well, in about seven times the time, by processes side by side:
              `result.summary.numerical_error` has the bars, see docs/converge.md

    >>> result = masonry.run(masonry.load("couplet", {"confinement": "0.1 MPa"}))
    >>> peak = result.peak  # m and Pa; by hand c + p tan(phi) = 0.971 MPa
    >>> print(f"{1e6 * peak.displacement:.0f} um, {peak.stress / 1e6:.2f} MPa")
    14 um, 0.97 MPa
    >>> stress = result.curve["stress"]  # a number for each row of the curve
    >>> stress.shape == (len(result.curve),), result.curve.attrs["units"]["stress"]
    (True, 'Pa')
    >>> print(f"{result.energies['fracture_mode_2']:.2f} J")
    0.79 J
    """
    from masonry.laboratory import arguments
    from masonry.laboratory.laboratory import run as run_scene
    from masonry.laboratory.notebook import telling

    threads, refined = arguments.threads(threads), arguments.flag("error_bar", error_bar)
    progress, scene = arguments.called("progress", progress, True, False, None), _scene(scene)
    with telling(progress, scene.name) as tell:
        if not refined:
            return run_scene(scene, threads, tell)
        from masonry.sweeps.error_bars.run_with_bar import run_refined

        return run_refined(scene, threads, tell)


@speaking_python
def limit(
    scene: "SceneLike",
    *,
    dilation: bool = True,
    strength: bool = True,
    safety: bool = False,
    at: float = 0.0,
    crushing: str | float | None = None,
    sides: int = 0,
    points: str = "corners",
) -> "LimitResult":
    """The largest factor of a load that forces in the joints of a scene can balance: its limit analysis.

    scene     a scene, a file of one, the name of a packaged one, or a dictionary; [limit] says what grows
    dilation  False: friction without dilation, as joints of one stiffness come to it from the dead loads: no bound
    strength  False: cohesion and tension are left out
    safety    the factor of safety on friction and cohesion in place of the load factor, at the load factor `at`
    crushing  compressive strength of the joints, "5 MPa" or Pa
    sides     of the pyramids that take the place of friction cones in space; 0 for cones
    points    "corners" of the joints, or the contact points of the "scene"
    What comes back prints as `masonry limit` does; `.factor`, `.velocity`, `.thrust()`, `.save(folder)`; of a vehicle
    that travels `.envelope`, its factors over its positions. Raises SceneError, in one sentence, for what cannot stand,
    what nothing loads, and what has no limit.

    >>> arch = masonry.limit("arch-tilted")
    >>> print(f"{arch.factor:.4f}")  # the tangent of the tilt
    0.3736
    >>> arch.velocity.shape  # (B, 6): how each block begins to move, along x, y, z and about them
    (10, 6)
    """
    from masonry.laboratory.arguments import flag, number, stress, whole
    from masonry.limit_analysis.analysis import LimitSettings, analyse

    wishes = LimitSettings(
        dilation=flag("dilation", dilation),
        strength=flag("strength", strength),
        safety=flag("safety", safety),
        at=number("at", at, -1e9, 1e9),
        crushing=stress("crushing", crushing),
        points=points,
        sides=whole("sides", sides, 0, 1000),
    )
    return analyse(_scene(scene), wishes)


@speaking_python
def modes(
    scene: "SceneLike",
    count: int = 6,
    *,
    pressed: bool = False,
    ratio: float = 0.05,
    between: "tuple[int, int] | None" = None,
) -> "ModesResult":
    """The slowest modes of a scene: frequencies, shapes and effective masses, from the tangent stiffness of its joints.

    scene    a scene, a file of one, the name of a packaged one, or a dictionary; supports hold, masses are real
    count    of modes, 1 to 200
    pressed  True: only the joints that press under the dead loads are closed, in place of all
    ratio    of Rayleigh damping, which has it at the modes `between`, the first and the third unless they are named
    What comes back prints as `masonry modes` does; `.frequencies` (m,) Hz, `.effective_mass` (m, 3) kg, `.rayleigh`,
    `.save(folder)`. Raises SceneError, in one sentence, where nothing can vibrate.

    >>> arch = masonry.modes("arch", 3)
    >>> print(" ".join(f"{frequency:.1f}" for frequency in arch.frequencies), "Hz")
    36.7 44.5 96.3 Hz
    >>> arch.share.shape  # (m, 3): of the mass that can move, along x, y and z
    (3, 3)
    """
    from masonry.laboratory.arguments import flag, number, whole
    from masonry.modal_analysis.vibration import MOST, ModesSettings, analyse

    wishes = ModesSettings(
        whole("count", count, 1, MOST),
        flag("pressed", pressed),
        number("ratio", ratio, 0.0, 1.0),
        None if between is None else (whole("between", between[0], 1, MOST), whole("between", between[1], 1, MOST)),
    )
    return analyse(_scene(scene), wishes)


@speaking_python
def sensitivity(
    scene: "SceneLike",
    out: "str | Path | None" = None,
    only: "Sequence[str]" = (),
    quick: bool = False,
    workers: int | None = None,
    tell: "Callable[[str], None] | None" = None,
    form: str = "png",
) -> "Sensitivity":
    """Run a scene with other damping, pace, coupling, kinematics, unloading, plates, cells and seeds, side by side.

    scene    a scene, a file of one, the name of a packaged one, or a dictionary
    out      folder of results; without it the next free results/SCENE-sensitivity-N
    only     kinds of variants; all that make sense for the scene where none is named
    quick    one variant of each kind, and none of the slow kinds
    workers  processes (default: all processors; 0: in this one); tell is called with a line for each run that ends
    form     of the picture: "png", "pdf" or "svg"
    What comes back prints as `masonry sensitivity` does; `.rows` are dictionaries. Raises SceneError or GeometryError
    before anything runs.

    >>> scene = masonry.load("couplet", {"drive.accuracy": "10 %", "confinement": "0.1 MPa"})
    >>> found = masonry.sensitivity(scene, only=["coupling"], quick=True, workers=1)
    >>> for row in found.rows:
    ...     print(f"{row['variant']}: {row['peak_stress_pa'] / 1e6:.2f} MPa")
    as it is: 0.97 MPa
    coupling independent: 0.97 MPa
    """
    from masonry.laboratory.arguments import called, flag, path, whole, words
    from masonry.sweeps.sensitivity.sensitivity import sensitivity as compare

    folder = None if out is None else path("out", out)
    workers = None if workers is None else whole("workers", workers, 0, 10_000)
    kinds, quick, tell = words("only", only), flag("quick", quick), called("tell", tell, None)
    return compare(_scene(scene), folder, kinds, quick, workers, tell, form=form)


@speaking_python
def sweep(
    scene: "SceneLike",
    vary: "Mapping[str, Any] | None" = None,
    out: "str | Path | None" = None,
    *,
    workers: int | None = None,
    executor: Any = None,
    refused: str = "stop",
    overwrite: bool = False,
    progress: "Callable[[str], None] | bool | None" = None,
    form: str = "png",
) -> "SweepResult":
    """Run a scene many times over: one row a run, with its verdict, doubts, warnings and numbers.

    scene     a scene, a file of one, the name of a packaged one, or a dictionary; where nothing varies, a sweep file
    vary      dotted keys with the values of each, all combinations; or the tables of a sweep file: grid, list (of
              dictionaries), latin_hypercube, settings, fragility, error_bars (how many of the runs are refined)
    out       folder of results, in which what is done of this sweep stays; without it the next results/SCENE-sweep-N
    workers   processes (default: all processors); 0: one run after the other in this process
    executor  a Dask client, the address of a Dask scheduler or an executor of concurrent.futures does the runs instead
    refused   "stop": runs that cannot be built end the sweep before it begins; "keep": they are rows with their reason
    overwrite the table of another sweep in `out` is replaced
    progress  True: a line on standard error for each run that ends; None: in a notebook only; or a function of a line
    form      of the pictures: "png", "pdf" or "svg"
    What comes back prints as `masonry sweep` does; `.table` (pandas), `.rows`, `.result(index)`, `.plot()`. Raises
    SceneError before anything runs.

    >>> short = masonry.load("couplet", {"drive.accuracy": "10 %"})
    >>> pressures = masonry.sweep(short, {"confinement": ["0.1 MPa", "0.5 MPa"]}, workers=0)
    >>> for row in pressures.rows:
    ...     print(f"{row['confinement']}: {row['peak_stress_pa'] / 1e6:.2f} MPa, {row['verdict']}")
    0.1 MPa: 0.97 MPa, sound
    0.5 MPa: 1.37 MPa, sound
    """
    from masonry.laboratory.arguments import called, flag, path, whole
    from masonry.laboratory.notebook import telling_lines
    from masonry.runtime.processors import processors
    from masonry.sweeps.read import read, sweep_of_tables
    from masonry.sweeps.sweep_run import Running, run_sweep

    if vary is None and isinstance(scene, Mapping) and "scene" in scene:
        vary = {key: value for key, value in scene.items() if key != "scene"}
        scene = scene["scene"]
    if vary is None and isinstance(scene, str | os.PathLike):
        file = path("scene", scene)
        request, name, text = read(file), str(file), file.read_text(encoding="utf-8-sig")
    else:
        loaded = _scene(scene)
        request, name, text = sweep_of_tables(loaded, vary), f"{loaded.name}-sweep", None
    running = Running(
        None if out is None else path("out", out),
        flag("overwrite", overwrite),
        processors() if workers is None else whole("workers", workers, 0, 10_000),
        executor,
        refused,
        form,
    )
    if request.error_bars:
        from masonry.sweeps.error_bars.sweep_bars import refining

        running = refining(request, running)
    with telling_lines(called("progress", progress, True, False, None)) as tell:
        return run_sweep(request, name, running, tell, text)


def _packed(tables: Any) -> Any:
    """Tables of a scene with a specimen that was handed over as text, and whatever else as it is."""
    if not isinstance(tables, Mapping) or "specimen" not in tables:
        return tables
    from masonry.importing.handed_blocks import with_packed_blocks

    return with_packed_blocks(tables)


def _scene(scene: "SceneLike") -> "Scene":
    """A scene as it is, else the one of that file, packaged name or dictionary. Raises SceneError."""
    from masonry.scene import Scene

    return scene if isinstance(scene, Scene) else load(scene)
