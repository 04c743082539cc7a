"""How the step is compiled, and where what was compiled is kept.

Numba serves a changed law stale from its cache when only another file changed: so the folder of the step is named after
a hash of every source file that can be compiled into it. What else is compiled (cells in geometry) calls nothing of
another file, and stays where it is when a law changes. A law of another package has a hash of its sources in the name
of its NamedTuple, and so in the types that the step is compiled for.
"""

import contextlib
import os
import re
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numba

from geometry.jit_cache import NOT_KEPT, CheckedCache
from masonry.jit.linked_library import LinkedCompiler
from masonry.jit.sources import COMPILED, source_hash

KEPT = 5
"""Cache folders of older sources that are kept."""
OTHERS = "cells"
"""The cache folder of what does not depend on laws, kernels and kinematics."""
MARKER = "CACHEDIR.TAG"
"""The file that marks a folder as a cache (bford.info/cachedir): programs that make backups leave it out."""
OURS = (
    b"Signature: 8a477f597d28d172789f06886806bc55\n# Made by masonry-dem, which deletes this folder with all in it.\n"
)
"""What the marker says of a folder that was made here. Nothing is deleted that does not carry it."""


def cache_root() -> Path:
    """Where compiled steps are kept: `masonry-dem` in $MASONRY_CACHE, or in the user's cache folder."""
    chosen = os.environ.get("MASONRY_CACHE") or os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(chosen).absolute() / "masonry-dem"


def _folders() -> tuple[str, str]:
    """Where the step of these sources is kept, and where the rest is; "" (Numba's own choice) where nothing can be."""
    root = cache_root()
    mode = "-plain" if os.environ.get("MASONRY_LANES") == "0" else ""
    folder, rest = root / f"{source_hash(COMPILED)}{mode}", root / OTHERS
    try:
        for path in (folder, rest):
            _make(path)
        os.utime(folder)
        older = sorted(filter(_is_ours, root.iterdir()), key=lambda path: path.stat().st_mtime)
        for stale in older[:-KEPT]:
            shutil.rmtree(stale, ignore_errors=True)
    except OSError:
        return "", ""
    return str(folder), str(rest)


def _make(folder: Path) -> None:
    """Make a folder of the cache and mark it; one that is there already stays as it is, marked or not."""
    if not folder.is_dir():
        folder.mkdir(parents=True, exist_ok=True)
        (folder / MARKER).write_bytes(OURS)


def _is_ours(path: Path) -> bool:
    """Whether this is a folder of compiled steps that was made here: by its name, and by the marker in it."""
    named = re.fullmatch(r"[0-9a-f]{16}(-plain)?", path.name) is not None
    try:
        return named and not path.is_symlink() and (path / MARKER).read_bytes() == OURS
    except OSError:
        return False


STEP, REST = _folders()
numba.config.CACHE_DIR = REST or numba.config.CACHE_DIR
if "NUMBA_THREADING_LAYER_PRIORITY" not in os.environ:
    numba.config.THREADING_LAYER_PRIORITY = ["omp", "tbb", "workqueue"]
"""Measured on two cores: OpenMP begins a parallel loop in 2 us, TBB in 16, Numba's own in 130; a step has several."""

OPTIONS = {"error_model": "numpy", "fastmath": {"contract"}, "no_cfunc_wrapper": True}
"""`contract` alone fuses multiply and add, and keeps NaN tests and the order of sums. Nobody calls these from C."""


def _refuse_python(dispatcher: Any) -> None:
    """End a call from Python in one message: Numba would jump to a wrapper that is not there."""

    def refuse(*args: Any, **named: Any) -> None:
        raise TypeError(
            f"{dispatcher.__name__} is compiled into other functions; what Python calls is decorated by jit"
        )

    dispatcher._insert = lambda *args: None  # so no call finds what was compiled for others
    dispatcher._compile_for_args = refuse


def _kept(folder: str, keep: bool = True, **options: Any) -> Callable[[Any], Any]:
    """A decorator that compiles, and keeps what it compiled in a folder of these sources; what Python cannot call in
    another one: Numba's cache does not tell the ways to compile one function apart."""
    decorate = numba.njit(**OPTIONS | options)
    folder = f"{folder}/inner" if folder and options.get("no_cpython_wrapper") else folder

    def compiled(function: Any) -> Any:
        numba.config.CACHE_DIR = folder or numba.config.CACHE_DIR
        try:
            dispatcher = decorate(function)
            if keep:
                dispatcher._cache = CheckedCache(function)
            if options.get("no_cpython_wrapper"):
                _refuse_python(dispatcher)
            return dispatcher
        finally:
            numba.config.CACHE_DIR = REST or numba.config.CACHE_DIR

    return compiled


jit = _kept(STEP, _nrt=False, nogil=True)
"""For what Python calls. Who holds an array is not counted (`_nrt`), which would cost a pair of boxes half as long
again: what is compiled may read and write arrays and views of them, but not make, return or keep one. Meanwhile other
threads of Python go on (`nogil`): they hear signals, and in a worker that its parent has died."""
part = _kept(STEP, _nrt=False, no_cpython_wrapper=True)
"""For what is called by its address: a wrapper that takes dozens of arrays from Python costs more to compile than the
function in it."""
LINKED: dict[str, Any] = {"keep": False, "no_cpython_wrapper": True, "pipeline_class": LinkedCompiler}
inner = _kept(STEP, _nrt=False, **LINKED)
"""For what other compiled functions alone call, into which it is linked; nothing of it is kept."""
inlined = _kept(STEP, _nrt=False, forceinline=True, **LINKED)
"""The same for what is called in one place: an array is handed over as nine numbers, which costs as much as the work
of a small function."""
THREADS: dict[str, Any] = {"folder": f"{STEP}/threads"} if STEP else {"folder": "", "keep": False}
jit_parallel = _kept(**THREADS, parallel=True)
inner_parallel = _kept(**THREADS, parallel=True, no_cpython_wrapper=True)


def is_kept(name: str, folder: str = STEP) -> bool:
    """Whether what has this name was compiled before, and is kept."""
    return bool(folder) and (Path(folder) / f"{name}.compiled").exists()


def is_begun(name: str, folder: str = STEP) -> bool:
    """Whether a process compiles what has this name just now."""
    if not folder:
        return False
    from filelock import FileLock, Timeout

    try:
        with FileLock(Path(folder) / f"{name}.lock", timeout=0):
            return False
    except (OSError, Timeout):
        return True


@contextlib.contextmanager
def once(name: str, folder: str = STEP) -> Iterator[None]:
    """Compile within: of all processes that need what has this name, one goes in alone, and the others wait and then
    find it in the cache; when one came through, there is no more waiting. A process that dies lets the next one in.

    folder  STEP or REST, whichever keeps what is compiled; "" where nothing is kept, and each compiles for itself
    """
    done = Path(folder) / f"{name}.compiled"
    if not folder or done.exists():
        yield
        return
    from filelock import FileLock

    lock = FileLock(done.with_suffix(".lock"))
    with contextlib.suppress(OSError):  # nothing can be kept here: each compiles for itself
        lock.acquire()
        if done.exists():
            lock.release()
    try:
        yield
        if lock.is_locked and not NOT_KEPT:
            with contextlib.suppress(OSError):
                done.touch()
    finally:
        lock.release()
