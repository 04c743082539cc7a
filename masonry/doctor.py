"""Looks at the machine: is everything there that a run needs?"""

import importlib
import os
import platform
import shutil
from collections.abc import Callable
from pathlib import Path

from masonry import __version__

APT = "apt-get install libgl1 libglu1-mesa libxrender1 libxcursor1 libxft2 libxinerama1 libfontconfig1 libgomp1"
"""What gmsh's wheel needs from a bare Debian."""
LEAST_FREE = 200e6
"""Bytes of free disk under which a run may not find room for its results."""

Finding = tuple[bool, str]


def examine() -> tuple[bool, str]:
    """Whether all is fine, and the findings as lines."""
    checks: dict[str, Callable[[], Finding]] = {
        "python": lambda: (True, platform.python_version()),
        "masonry": lambda: (True, __version__),
        "processors": lambda: (True, str(os.cpu_count())),
        "numpy": lambda: _module("numpy"),
        "numba": lambda: _module("numba"),
        "threading layer": _threading_layer,
        "h5py": lambda: _module("h5py"),
        "pyarrow": lambda: _module("pyarrow"),
        "matplotlib": lambda: _module("matplotlib"),
        "gmsh": _gmsh,
        "compiled code": _cache,
        "free disk here": _disk,
    }
    findings = {name: check() for name, check in checks.items()}
    margin = max(map(len, findings)) + 2
    lines = [f"{name:<{margin}}{'' if good else 'PROBLEM: '}{words}" for name, (good, words) in findings.items()]
    fine = all(good for good, _ in findings.values())
    lines.append("all fine" if fine else "some things are missing, see above")
    return fine, "\n".join(lines)


def _module(name: str) -> Finding:
    try:
        return True, str(importlib.import_module(name).__version__)
    except (ImportError, OSError) as error:
        return (
            False,
            f"cannot be imported ({error}); install masonry-dem again: pip install --force-reinstall masonry-dem",
        )


def _gmsh() -> Finding:
    try:
        return True, str(importlib.import_module("gmsh").__version__)
    except ImportError as error:
        return (
            False,
            f"cannot be imported ({error}); install masonry-dem again: pip install --force-reinstall masonry-dem",
        )
    except OSError as error:
        return False, f"a library is missing ({error}); on Debian and Ubuntu: {APT}"


def _threading_layer() -> Finding:
    """The first layer that Numba can load, in the order in which it tries them."""
    for name, module in (("tbb", "tbbpool"), ("omp", "omppool"), ("workqueue", "workqueue")):
        try:
            importlib.import_module(f"numba.np.ufunc.{module}")
            return True, name
        except ImportError:
            continue
    return False, "Numba can load none of tbb, omp and workqueue"


def _cache() -> Finding:
    """Where compiled code is kept between runs, and how much of it there is."""
    try:
        folder: Path = importlib.import_module("masonry.kernels.compiler").cache_root()
    except (ImportError, OSError) as error:
        return False, f"nothing can be compiled ({error})"
    files = [path.stat().st_size for path in folder.rglob("*") if path.is_file()] if folder.is_dir() else []
    place = folder
    while not place.exists():
        place = place.parent
    if not os.access(place, os.W_OK):
        return (
            False,
            f"{folder} cannot be written to: every run will compile anew; set MASONRY_CACHE to another folder",
        )
    return True, f"{folder}, {sum(files) / 1e6:.1f} MB in {len(files)} files"


def _disk() -> Finding:
    free = shutil.disk_usage(".").free
    return free > LEAST_FREE, f"{free / 1e9:.1f} GB"
