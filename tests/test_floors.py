"""Imports go down the floors only. The table below says which floor each module stands on and what it may see."""

import ast
import sys
from collections.abc import Iterator
from fnmatch import fnmatchcase
from pathlib import Path
from typing import NamedTuple

import pytest

ROOT = Path(__file__).resolve().parents[1]
OURS = ("geometry", "masonry", "verification", "tests", "benchmarks")


class Floor(NamedTuple):
    """One floor: its modules (patterns; a package stands for all below it), the floors it may see, the packages too."""

    modules: str
    sees: str
    packages: str | None = None  # None: any


FLOORS = {
    "kept": Floor("geometry.jit_cache", sees="", packages="numba"),
    "geometry": Floor("geometry", sees="geometry kept"),
    "errors": Floor("masonry.errors masonry.plugins", sees="errors", packages=""),
    "equations": Floor(
        "masonry.laws masonry.kernels masonry.kinematics",
        sees="equations errors kept",
        packages="numpy numba llvmlite",
    ),
    "model": Floor(
        "masonry.model.model masonry.model.layout masonry.model.stable_step masonry.model.contact_groups masonry.model.loads masonry.model.arrays"
        " masonry.model.supports masonry.model.one_contact masonry.model.step_cost masonry.model.draws masonry.model.gauges masonry.loading.schedule",
        sees="model equations errors geometry",
        packages="numpy numba llvmlite",
    ),
    "run": Floor(
        "masonry.timeloop.timeloop masonry.loading.scheduled masonry.loading.adaptive masonry.loading.dispatch masonry.loading.cyclic_adaptive masonry.loading.varying_loads"
        " masonry.loading.cycles masonry.monitors.events masonry.loading.rest masonry.loading.predictor masonry.monitors.utilisation masonry.monitors.stability masonry.monitors.snap_back"
        " masonry.monitors.overlap masonry.monitors.slide masonry.monitors.collision masonry.monitors.corners masonry.monitors.mode_2_area masonry.monitors.contact_stress"
        " masonry.monitors.energy masonry.history masonry.runtime.progress masonry.timeloop.checkpoint"
        " masonry.timeloop.loop masonry.timeloop.recording masonry.timeloop.compiled_step masonry.timeloop.checkpointer masonry.timeloop.model_state masonry.runtime.state_file"
        " masonry.runtime.state masonry.runtime.lock masonry.runtime.hdf5 masonry.timeloop.reactions masonry.results.joint_resultants"
        " masonry.results.data masonry.results.archive masonry.runtime.folder masonry.results.fields masonry.runtime.processes masonry.runtime.tally"
        " masonry.results.table masonry.runtime.finite masonry.laboratory.text masonry.laboratory.notebook masonry.pictures.figure masonry.pictures.painter"
        " masonry.runtime.processors masonry.quantity"
        " masonry.pictures.curve masonry.pictures.curve_axes masonry.pictures.crack_picture masonry.pictures.crack_style masonry.pictures.cracks masonry.results.deformation"
        " masonry.results.dry_joints masonry.pictures.thrust_line"
        " masonry.results.vtkhdf masonry.results.joint_fields masonry.results.frames masonry.pictures.frame_picture"
        " masonry.pictures.settling"
        " masonry.pictures.hysteresis masonry.pictures.front masonry.pictures.oblique masonry.pictures.hidden_surfaces masonry.pictures.faces"
        " masonry.runtime.text_files masonry.runtime.open_archive masonry.results.validate"
        " masonry.movies.movie masonry.movies.movie_file masonry.movies.viewer masonry.movies.scene_3d",
        sees="run model equations errors geometry kept",
    ),
    "scene": Floor(
        "masonry masonry.__main__ masonry.cli.main masonry.cli.commands masonry.runtime.shell masonry.cli.doctor masonry.cli.installed"
        " masonry.scene* masonry.cli.picture_command masonry.cli.movie_command"
        " masonry.assembly.assemble masonry.assembly.schedule masonry.assembly.scatter masonry.assembly.specimens masonry.assembly.conditions masonry.assembly.restraint"
        " masonry.assembly.gauge_places masonry.assembly.size_limits masonry.block_* masonry.own_s* masonry.law_*"
        " masonry.import*"
        " masonry.laboratory.quality masonry.laboratory.contact_remarks masonry.drawings.geometry_picture masonry.drawings.picture_frame"
        " masonry.drawings.condition_marks masonry.drawings.mark_drawing"
        " masonry.laboratory.summary masonry.laboratory.cost masonry.laboratory.laboratory masonry.cli.run masonry.runtime.interrupts masonry.laboratory.provenance masonry.sweep"
        " masonry.laboratory.settling"
        " masonry.comparison",
        sees="scene run model equations errors geometry",
    ),
    "verification": Floor("verification", sees="verification scene run model equations errors geometry"),
    "tests": Floor("tests benchmarks", sees="tests verification scene run model equations errors geometry kept"),
}
GMSH = ("geometry.meshes.gmsh_session", "tests", "tests.*")


class Import(NamedTuple):
    module: str
    line: int


def modules() -> dict[str, Path]:
    """Every module of the house, by its dotted name."""
    found = {}
    for path in (p for package in OURS for p in (ROOT / package).rglob("*.py")):
        parts = path.relative_to(ROOT).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


MODULES = modules()


def floor_of(module: str) -> str | None:
    """The floor a module stands on; `masonry` alone does not stand for all of `masonry`."""
    for name, floor in FLOORS.items():
        for pattern in floor.modules.split():
            below = pattern != "masonry" and fnmatchcase(module, f"{pattern}.*")
            if below or fnmatchcase(module, pattern):
                return name
    return None


def imports(module: str, source: str, is_package: bool = False) -> Iterator[Import]:
    """All imports of a source, in functions too, relative ones resolved, and import_module("...") among them."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            yield from (Import(alias.name, node.lineno) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                up = node.level - 1 if is_package else node.level
                parts = module.split(".")
                base = ".".join(parts[: len(parts) - up] + ([base] if base else []))
            yield from (Import(target, node.lineno) for target in sorted(_targets(base, node)))
        elif isinstance(node, ast.Call) and node.args and isinstance(node.args[0], ast.Constant):
            called = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            if called in ("import_module", "__import__"):
                yield Import(str(node.args[0].value), node.lineno)


def _targets(base: str, node: ast.ImportFrom) -> set[str]:
    """What `from base import ...` names: modules where they are modules, else the base; `__version__` is nobody's."""
    names = {alias.name for alias in node.names if not alias.name.startswith("__")}
    return {f"{base}.{name}" if f"{base}.{name}" in MODULES else base for name in names}


def offences(module: str, source: str, is_package: bool = False) -> list[str]:
    """What the imports of one module do against the floors, a sentence each."""
    own = floor_of(module)
    if own is None:
        return [
            f"{module} stands on no floor: add it to a row of FLOORS in tests/test_floors.py (the lowest that fits)"
        ]
    floor, found = FLOORS[own], []
    for target, line in imports(module, source, is_package):
        package = target.split(".")[0]
        says = f"{module}, line {line}: imports {target}"
        if package in OURS:
            other = floor_of(target)
            if other is None:
                found.append(f"{says}, which stands on no floor")
            elif other not in floor.sees.split():
                found.append(f"{says} of floor '{other}'; floor '{own}' sees only: {floor.sees or 'nothing'}")
        elif package == "gmsh" and not any(fnmatchcase(module, allowed) for allowed in GMSH):
            found.append(f"{says}; only geometry/meshes/gmsh_session.py imports gmsh")
        elif floor.packages is not None and package not in (*sys.stdlib_module_names, *floor.packages.split()):
            found.append(f"{says}; floor '{own}' uses only the standard library {floor.packages}".rstrip())
    return found


@pytest.mark.parametrize("module", sorted(MODULES))
def test_imports_go_down_the_floors_only(module: str) -> None:
    path = MODULES[module]
    found = offences(module, path.read_text(encoding="utf-8"), path.name == "__init__.py")
    assert not found, "\n".join(found)


def test_every_folder_of_modules_is_a_package_so_that_it_is_installed() -> None:
    shipped = [
        path for path in MODULES.values() if path.relative_to(ROOT).parts[0] in ("geometry", "masonry", "verification")
    ]
    bare = {str(path.parent.relative_to(ROOT)) for path in shipped if not (path.parent / "__init__.py").exists()}
    assert not bare, f"add an __init__.py to {', '.join(sorted(bare))}"


@pytest.mark.parametrize(
    ("module", "source"),
    [
        ("geometry.blocks", "import masonry.errors"),
        ("geometry.blocks", "def f():\n    from masonry import errors"),
        ("geometry.blocks", "from masonry import anything"),
        ("geometry.joints.find", "import gmsh"),
        ("masonry.laws.dispatch", "from .. import scene"),
        ("masonry.laws.dispatch", "from ..scene import Scene"),
        ("masonry.laws.dispatch", "from geometry.blocks import Blocks"),
        ("masonry.kernels.step", "import scipy.sparse"),
        ("masonry.kernels.step", "import importlib\nimportlib.import_module('h5py')"),
        ("masonry.model.model", "if True:\n    import masonry.timeloop.timeloop as loop"),
        ("masonry.timeloop.timeloop", "from masonry.scene import Scene"),
        ("masonry.cli.main", "from verification import report"),
        ("verification.report", "import tests.test_floors"),
        ("verification.report", "from benchmarks import anything"),
        ("masonry.utils", "import math"),
    ],
)
def test_an_import_that_goes_up_is_found(module: str, source: str) -> None:
    assert len(offences(module, source)) == 1


@pytest.mark.parametrize(
    ("module", "source"),
    [
        ("masonry.laws", "from .door import beside\nfrom . import state\nimport numba, math"),
        ("masonry.model.model", "from geometry import blocks\nfrom masonry.laws import door"),
        ("masonry.timeloop.timeloop", "from masonry import __version__, model\nimport rich"),
        ("masonry.scene.schema", "import pydantic\nfrom masonry.quantity import parse"),
        ("geometry.meshes.gmsh_session", "def mesh():\n    import gmsh"),
    ],
)
def test_an_import_that_goes_down_is_let_through(module: str, source: str) -> None:
    assert offences(module, source, is_package=module == "masonry.laws") == []
