"""Parts that are compiled side by side: by this process from the first one on, by others from the last one on.

Each takes what nobody else has begun. What the others compiled lies in the cache then; where one of them fails or dies,
this process compiles for itself.
"""

import contextlib
import importlib
import os
import pickle
import subprocess
import sys
from collections.abc import Iterator
from multiprocessing import parent_process
from typing import Any

from geometry.child_python import child_command, end_with_parent
from geometry.operating_system import SYSTEM
from masonry.jit.compiler import STEP, is_begun

MOST = 4
"""Processes that compile at once, at most: each takes some 300 MB."""

Work = list[tuple[Any, Any]]
"""Parts (parts.CompiledPart) and the kinds of record that they are to be compiled for."""


def processes() -> int:
    """How many processes may compile at once: MASONRY_COMPILERS, or as many as there are processors, up to four. A
    worker of a sweep compiles alone, as there are others of its like."""
    if parent_process() is not None or not STEP:
        return 1
    with contextlib.suppress(ValueError):
        return int(os.environ.get("MASONRY_COMPILERS", min(MOST, SYSTEM.processors())))
    return 1


def compile_all(work: Work) -> None:
    """Compile what is not there yet, side by side."""
    missing = list({part.stamp(kind): (part, kind) for part, kind in work if not part.is_compiled(kind)}.values())
    with _others(missing, min(processes(), len(missing)) - 1):
        _compile_free(missing)
        for part, kind in missing:
            part.compile(kind)


def _compile_free(work: Work) -> None:
    for part, kind in work:
        if not is_begun(part.stamp(kind)):
            part.compile(kind)


@contextlib.contextmanager
def _others(work: Work, count: int) -> Iterator[None]:
    """Let `count` other processes compile meanwhile."""
    order = pickle.dumps([(part.module, part.name, kind) for part, kind in reversed(work)])
    command, others = child_command("masonry.jit.workers"), []
    try:
        for _ in range(count):
            with contextlib.suppress(OSError):
                other = subprocess.Popen(
                    command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
                )
                others.append(other)
                assert other.stdin is not None
                other.stdin.write(order)
                other.stdin.flush()  # and stays open, as it tells that somebody waits
        yield
    finally:
        for other in others:  # all is compiled by now, or this process was told to end
            other.kill()
            other.communicate()


def main() -> None:
    """What another process does: its work comes from the process that began it, and with which it ends."""
    work = pickle.load(sys.stdin.buffer)
    end_with_parent()
    for module, name, kind in work:
        part = getattr(importlib.import_module(module), name)
        if not part.is_compiled(kind) and not is_begun(part.stamp(kind)):
            part.compile(kind)
