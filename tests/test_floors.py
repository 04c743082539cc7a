"""The house by its folders: each stands on a floor and imports from the floors below only, lazy imports included."""

import ast
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

ROOT = Path(__file__).resolve().parents[1]
OURS = ("geometry", "masonry", "verification", "tests", "benchmarks")
FLOORS = (
    *("geometry.errors", "geometry.blocks", "geometry.checks", "geometry.jit_cache", "geometry.child_python"),
    "geometry.operating_system",
    *("geometry.polyhedra", "geometry.cells"),
    *("geometry.joints", "geometry.meshes", "geometry.specimens", "geometry.structures", "geometry.files", "geometry"),
    *("masonry.errors", "masonry.units", "masonry.quantity", "masonry.rows", "masonry.runtime"),
    *("masonry.jit", "masonry.simd", "masonry.laws", "masonry.laws.building"),
    *("masonry.ground", "masonry.scene.tables", "masonry.scene", "masonry.materials", "masonry.starting"),
    *("masonry.judgement", "masonry.results", "masonry.pictures", "masonry.curves", "masonry.movies"),
    *("masonry.detection", "masonry.kinematics", "masonry.patches", "masonry.kernels", "masonry.model"),
    *(
        "masonry.elements",
        "masonry.elements.bars",
        "masonry.elements.joints",
        "masonry.configuration.parts",
        "masonry.configuration",
    ),
    *("masonry.monitors", "masonry.monitors.collisions"),
    *("masonry.loading.moves", "masonry.loading", "masonry.loading.drive", "masonry.loading.collapse"),
    *("masonry.timeloop", "masonry.importing", "masonry.assembly"),
    *("masonry.estimates", "masonry.drawings", "masonry.statics", "masonry.limit_analysis", "masonry.modal_analysis"),
    "masonry.viewing",
    *("masonry.laboratory.summary.measurements", "masonry.laboratory.summary"),
    *("masonry.laboratory.remarks", "masonry.laboratory", "masonry.reporting"),
    *(
        "masonry.sweeps",
        "masonry.sweeps.sensitivity",
        *("masonry.sweeps.convergence.refinement", "masonry.sweeps.convergence.search"),
        "masonry.sweeps.convergence",
        "masonry.sweeps.error_bars",
        "masonry.shell_functions",
        "masonry",
    ),
    "masonry.cli",
    "masonry.__main__",
    *("verification.references", "verification.balance", "verification.scene_runs", "verification.case"),
    "verification.fixtures",
    *("verification.checks", "verification.cases", "verification.catalogue", "verification.outcome"),
    *("verification.runner", "verification.records", "verification.comparison"),
    *("verification.text", "verification.timed_run", "verification.problem", "verification.html"),
    *("verification.convergence", "verification.reference_step", "verification.self_test", "verification.stability"),
    *("verification.studies", "verification.paper", "verification.report", "verification.command"),
    *("verification", "tests", "benchmarks"),
)
"""From the lowest to the highest: folders, and the files that stand at the top of a package."""
TOWERS = {
    "reading": ("masonry.judgement", "masonry.results", "masonry.pictures", "masonry.curves", "masonry.movies"),
    "computing": (
        *("masonry.detection", "masonry.kinematics", "masonry.patches", "masonry.kernels", "masonry.model"),
        *("masonry.elements", "masonry.configuration", "masonry.monitors", "masonry.loading"),
        *("masonry.timeloop", "masonry.assembly"),
    ),
}
"""What shows and judges results needs rows, laws and the scene; what computes them shows nothing."""
PACKAGES = {
    **dict.fromkeys(("masonry.errors", "masonry.laws.building.entry_points"), ""),
    **dict.fromkeys(("masonry.simd", "masonry.laws", "masonry.kinematics"), "numpy numba llvmlite"),
    "masonry.laws.building": "numpy numba llvmlite",
    **dict.fromkeys(("masonry.patches", "masonry.kernels", "masonry.model", "masonry.loading"), "numpy numba llvmlite"),
    **dict.fromkeys(("masonry.elements", "masonry.elements.bars", "masonry.elements.joints"), "numpy numba llvmlite"),
    "masonry.jit": "numpy numba llvmlite filelock",
    "masonry.detection": "numpy numba",
    "masonry.ground": "numpy scipy",
    "geometry.jit_cache": "numba",
}
"""The packages that a floor may use besides the standard library; any where nothing is said."""
GMSH = ("geometry.meshes.gmsh_session", "tests")
MOST, MOST_AT_TOP, LONGEST = 15, 6, 400
"""Python files in a folder, in `masonry/` itself, and lines of a file."""
LONG = {"geometry/cells/space_energy.py"}
"""An energy and its gradient belong together."""


class Import(NamedTuple):
    module: str
    line: int


def modules() -> dict[str, Path]:
    """Every module of the house, by its dotted name."""
    named = {}
    for path in (p for package in OURS for p in (ROOT / package).rglob("*.py")):
        parts = path.relative_to(ROOT).with_suffix("").parts
        named[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return named


MODULES = modules()


def floor_of(module: str) -> str | None:
    """The floor a module stands on: its folder, or the nearest one above that is named. A package that is named stands
    for its own file only where it is the top of the house."""
    name = module
    while name and name not in FLOORS:
        name = name.rpartition(".")[0]
    return None if name in ("geometry", "masonry", "verification") and name != module else name or None


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


def tower_of(floor: str) -> str:
    """The tower that a floor belongs to; none where both stand on it, or it stands on both."""
    for name, rooms in TOWERS.items():
        if any(floor == room or floor.startswith(f"{room}.") for room in rooms):
            return name
    return ""


def offences(module: str, source: str, is_package: bool = False) -> list[str]:
    """What the imports of one module do against the floors, a sentence each."""
    own, sentences = floor_of(module), []
    if own is None:
        return [f"{module} stands on no floor: add its folder to FLOORS in tests/test_floors.py, as low as it goes"]
    for target, line in imports(module, source, is_package):
        package = target.split(".")[0]
        says = f"{module}, line {line}: imports {target}"
        if package in OURS:
            other = floor_of(target)
            if other is None:
                sentences.append(f"{says}, which stands on no floor")
            elif FLOORS.index(other) > FLOORS.index(own):
                sentences.append(f"{says} of floor '{other}', which is above floor '{own}'")
            elif {tower_of(own), tower_of(other)} == {"reading", "computing"}:
                sentences.append(f"{says}: rooms that read and rooms that compute know nothing of each other")
        elif package == "gmsh" and not any(module == allowed or module.startswith(f"{allowed}.") for allowed in GMSH):
            sentences.append(f"{says}; only {GMSH[0]} imports gmsh")
        elif own in PACKAGES and package not in (*sys.stdlib_module_names, *PACKAGES[own].split()):
            sentences.append(f"{says}; floor '{own}' uses only the standard library {PACKAGES[own]}".rstrip())
    return sentences


@pytest.mark.parametrize("module", sorted(MODULES))
def test_imports_go_down_the_floors_only(module: str) -> None:
    path = MODULES[module]
    sentences = offences(module, path.read_text(encoding="utf-8"), path.name == "__init__.py")
    assert not sentences, "\n".join(sentences)


def circles(graph: dict[str, set[str]]) -> list[list[str]]:
    """What is left once all that imports nothing left is taken away, again and again: circles and what leads there."""
    left = {name: set(targets) - {name} for name, targets in graph.items()}
    while free := [name for name, targets in left.items() if not targets & left.keys()]:
        for name in free:
            del left[name]
    return [[name, *sorted(targets & left.keys())] for name, targets in sorted(left.items())]


def test_no_files_import_each_other_in_a_circle() -> None:
    graph = {
        module: {target.module for target in imports(module, path.read_text(encoding="utf-8"), path.stem == "__init__")}
        for module, path in MODULES.items()
    }
    assert circles(graph) == []


def test_a_circle_is_found() -> None:
    assert circles({"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}, "e": set()}) != []
    assert circles({"a": {"b", "c"}, "b": {"c"}, "c": {"numpy"}}) == []


def test_no_folder_has_too_many_files_and_no_file_too_many_lines() -> None:
    inside: dict[str, int] = {}
    for path in MODULES.values():
        folder = path.parent.relative_to(ROOT).as_posix()
        inside[folder] = inside.get(folder, 0) + 1
    full = {folder: count for folder, count in inside.items() if count > MOST}
    assert not full, f"folders with more than {MOST} files: {full}"
    assert inside["masonry"] <= MOST_AT_TOP
    lines = {p.relative_to(ROOT).as_posix(): p.read_text(encoding="utf-8").count("\n") for p in MODULES.values()}
    long = {file: count for file, count in lines.items() if count > LONGEST and file not in LONG}
    assert not long, f"files with more than {LONGEST} lines: {long}"


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
        ("geometry.polyhedra.indexing", "from geometry.joints import find"),
        ("masonry.laws.law_dispatch", "from .. import scene"),
        ("masonry.laws.law_dispatch", "from ..scene import Scene"),
        ("masonry.kernels.step", "import scipy.sparse"),
        ("masonry.kernels.step", "import importlib\nimportlib.import_module('h5py')"),
        ("masonry.model.model", "if True:\n    import masonry.timeloop.timeloop as loop"),
        ("masonry.results.data", "if TYPE_CHECKING:\n    from masonry.curves.curve import curve_figure"),
        ("masonry.timeloop.timeloop", "from masonry.results import data"),
        ("masonry.results.data", "from masonry.model.model import Model"),
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
        ("masonry.laws", "from .dispatch import beside\nfrom . import state\nimport numba, math"),
        ("masonry.model.model", "from geometry import blocks\nfrom masonry.laws import dispatch"),
        ("masonry.timeloop.timeloop", "from masonry import __version__\nfrom masonry.model import model\nimport rich"),
        ("masonry.scene.schema", "import pydantic\nfrom masonry.quantity import parse"),
        ("geometry.meshes.gmsh_session", "def mesh():\n    import gmsh"),
    ],
)
def test_an_import_that_goes_down_is_let_through(module: str, source: str) -> None:
    assert offences(module, source, is_package=module == "masonry.laws") == []
