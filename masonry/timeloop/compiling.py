"""Before the first step: it is compiled, or loaded, and what is compiled is told, with the time it took last time."""

import contextlib
from collections.abc import Callable

import numba

from masonry.configuration.configuration import configuration_of
from masonry.errors import SceneError
from masonry.laws.law_dispatch import word_of
from masonry.model.model import Model
from masonry.runtime.processors import Seconds
from masonry.runtime.progress import Progress, duration
from masonry.timeloop.compiled_step import compile_for, is_compiled
from masonry.timeloop.machine_record import read_record, write_record

RECORD = "compiling"
"""Seconds that it took last time on this machine, and at most so far, by what was compiled."""
APART = 2.0
"""Times the last time from which on the longest one is told too: parts that other scenes share may be there already,
and a machine may be busy, so that the last time tells little."""


def prepare(model: Model, threads: int, progress: Callable[[int, int, str], None] | None) -> Seconds:
    """Have the step of a model compiled, or loaded where it is there already; the time that this takes."""
    begun = Seconds.now()
    if threads > 1:
        _use(threads)
    if is_compiled(model, threads):
        compile_for(model, threads)
        return Seconds.now() - begun
    what = compiling_text(model)
    kind = f"{what} in {'large' if configuration_of(model).any_size else 'small'} displacement"
    record, longest_of = read_record(RECORD), f"{kind}, longest"
    last, longest = record.get(kind), record.get(longest_of, 0.0)
    differs = last is not None and longest > APART * last
    waiting: contextlib.AbstractContextManager[None] = contextlib.nullcontext()
    if progress is not None:
        took = "" if last is None else f", {duration(last)} last time"
        took += f" and {duration(longest)} at most" if differs else ""
        words = f"{what} (once for all such scenes{took})"
        progress(0, 0, words)
        waiting = progress.waiting(words, None if differs else last) if isinstance(progress, Progress) else waiting
    with waiting:
        compile_for(model, threads)
    seconds = Seconds.now() - begun
    wall = round(seconds.wall, 1)
    write_record(RECORD, read_record(RECORD) | {kind: wall, longest_of: max(wall, longest)})
    return seconds


def compiling_text(model: Model) -> str:
    """Parts to compile: the kinds of blocks and the laws that are in the step, of what may meet friction."""
    blocks = " and ".join(kind for kind, members in model.layout.members.items() if len(members))
    words = [word_of(model.groups.parameters[g]) for g in model.swept]
    words += ["friction"] if configuration_of(model).any_size else []
    laws = ", ".join(dict.fromkeys(words))
    return f"compiling the step for {blocks} blocks, law {laws or 'none'}"


def _use(threads: int) -> None:
    """Raise SceneError where Numba has nothing to run threads with, or is told of something that does not exist."""
    try:
        numba.set_num_threads(min(threads, numba.config.NUMBA_NUM_THREADS))
    except ValueError as error:
        why = str(error).partition("\n")[0].rstrip(".")
        raise SceneError(
            f"--threads {threads}: Numba cannot run threads here ({why}); unset NUMBA_THREADING_LAYER if it is set, or"
            " use one thread"
        ) from None
