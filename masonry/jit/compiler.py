"""How the step is compiled, and where what was compiled is kept.

Numba serves a changed law stale from its cache when only another file changed: so the folder of the step is named after
a hash of every source file that can be compiled into it. What else is compiled (cells in geometry) calls nothing of
another file, and stays where it is when a law changes. A law of another package has a hash of its sources in the name
of its NamedTuple, and so in the types that the step is compiled for.
"""

import contextlib
import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numba

from geometry.jit_cache import NOT_KEPT, NOWHERE, keep_code
from masonry.jit.cache_folder import cache_folders, words_of
from masonry.jit.linked_library import LinkedCompiler


def _folders() -> tuple[str, str]:
    """Where the step of these sources is kept, and where the rest is; "" where nothing can be, and NOWHERE says why."""
    try:
        step, rest = cache_folders()
    except OSError as error:
        NOWHERE.append(words_of(error))
        return "", ""
    return str(step), str(rest)


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
                keep_code(dispatcher, function)
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
THREADS = f"{STEP}/threads" if STEP else ""
jit_parallel = _kept(THREADS, parallel=True)
inner_parallel = _kept(THREADS, parallel=True, no_cpython_wrapper=True)


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
