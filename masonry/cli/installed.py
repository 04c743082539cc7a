"""Inventory of this installation: packages and their versions, system libraries, processor, threads, compiled code."""

import importlib
import os
import platform
import re
from importlib import metadata

from masonry.errors import extra as how_to_install
from masonry.runtime.processors import processors

APT = "apt-get install libgl1 libglu1-mesa libxrender1 libxcursor1 libxft2 libxinerama1 libfontconfig1 libgomp1"
"""What the wheel of gmsh and threads need from a bare Debian."""
ON_DEBIAN = f"on Debian and Ubuntu: {APT}"
AGAIN = "install it again, in the clone of masonry-dem: pip install --force-reinstall ."
COMPUTING = ("numpy", "scipy", "numba", "h5py", "matplotlib", "gmsh")
"""Packages of compiled code, which may be there and yet not load."""
DISTRIBUTION = "masonry-dem"
TRIED = "Linux"
"""The system on which the tests were run."""
TOOLS = ("dev", "docs")
"""Extras for those who change the program; a user lacks nothing without them."""
Finding = tuple[bool, str]


def module(name: str) -> Finding:
    """Version of a package, or why it cannot be imported."""
    try:
        return True, str(importlib.import_module(name).__version__)
    except ImportError as error:
        return False, f"cannot be imported ({error}); {AGAIN}"
    except OSError as error:
        return False, f"a library is missing ({error}); {ON_DEBIAN}"


def system() -> Finding:
    """Which one this is, and whether the program was ever tried on it."""
    words = f"{platform.system()} {platform.release()}, {platform.machine()}"
    return True, words if platform.system() == TRIED else f"{words}; this program was tried on {TRIED} only"


def processor() -> Finding:
    """How many there are, how many this process may use, which kind."""
    try:
        kind = importlib.import_module("llvmlite.binding").get_host_cpu_name()
    except (ImportError, OSError):
        kind = "of a kind that is not known without llvmlite"
    return True, f"{os.cpu_count()}, of which {processors()} may be used (--threads), {kind}"


def threading_layer() -> Finding:
    """The first layer that Numba can load, in the order in which it is told to try them."""
    for name, layer in (("omp", "omppool"), ("tbb", "tbbpool"), ("workqueue", "workqueue")):
        try:
            importlib.import_module(f"numba.np.ufunc.{layer}")
            return True, name
        except ImportError:
            continue
    return False, f"Numba can load none of tbb, omp and workqueue; {ON_DEBIAN}"


def others(optional: bool) -> Finding:
    """Versions of the packages that are asked for besides those, or of the optional ones that users may want."""
    present, absent = [], []
    for name, part in _requirements():
        if bool(part) != optional or part in TOOLS or name in COMPUTING:
            continue
        try:
            present.append(f"{name} {metadata.version(name)}")
        except metadata.PackageNotFoundError:
            absent.append(f"{name} ({how_to_install(part)})" if part else name)
    words = ", ".join(present)
    if absent and not optional:
        return False, f"{', '.join(absent)} not installed; {AGAIN}"
    return True, "; not installed: ".join(filter(None, (words, ", ".join(absent)))) or "none known"


def _requirements() -> list[tuple[str, str]]:
    """Name and extra ("" where it is needed) of what the distribution asks for; none where it is not installed."""
    try:
        requirements = metadata.requires(DISTRIBUTION) or []
    except metadata.PackageNotFoundError:
        return []
    names = []
    for line in requirements:
        name = re.match(r"[\w.-]+", line)
        extra = re.search(r"extra == ['\"]([\w-]+)['\"]", line)
        if name and name[0] != DISTRIBUTION:
            names.append((name[0], extra[1] if extra else ""))
    return names


def cached_code() -> Finding:
    """Where compiled code is kept between runs, how much of it there is, and how much of it is of this version."""
    try:
        importlib.import_module("masonry.jit.compiler")
        cache = importlib.import_module("masonry.jit.cache_folder")
    except (ImportError, OSError) as error:
        return False, f"nothing can be compiled ({error})"
    try:
        step, _ = cache.cache_folders()
    except OSError as error:
        return False, f"{cache.words_of(error)}: every run will compile anew; set MASONRY_CACHE to another folder"
    files = [path.stat().st_size for path in step.parent.rglob("*") if path.is_file()]
    kinds = len(list(step.glob("*.compiled")))
    size = f"{sum(files) / 1e6:.1f} MB in {len(files)} files"
    return True, f"{step.parent}, {size}; of this version {kinds} kinds of step, which need not be compiled again"
