"""A whole run of a model: its step is compiled or loaded, its chunks are taken, and what it came to is put together."""

import contextlib
from collections.abc import Callable

import numba

from geometry.jit_cache import NOT_KEPT
from masonry.configuration.configuration import configuration_of
from masonry.errors import SceneError, Stopped
from masonry.laws.law_dispatch import word_of
from masonry.loading.plan import Plan
from masonry.model.model import Model
from masonry.rows.history import History
from masonry.runtime.processors import Seconds
from masonry.runtime.progress import Progress
from masonry.timeloop.checkpointer import Checkpointer
from masonry.timeloop.compiled_step import compile_for, is_compiled
from masonry.timeloop.loop import Loop
from masonry.timeloop.recording import Outcome, Recording


def run(
    model: Model,
    plan: Plan,
    recording: Recording,
    threads: int = 1,
    progress: Callable[[int, int, str], None] | None = None,
    checkpointer: Checkpointer | None = None,
) -> Outcome:
    """Run the whole plan. An unstable or too large motion ends it: Outcome.stopped says why, rows stay trusted.

    checkpointer  writes checkpoints, goes on from one, and says when to end; without one, Ctrl-C ends the run
    """
    outcome = Outcome(History())
    outcome.seconds_compile = prepare(model, threads, progress)
    loading = plan.loading(model, recording.rows, recording.gauges)
    if NOT_KEPT:
        outcome.log.append(f"what was compiled could not be kept, so the next run compiles it again: {NOT_KEPT[0]}")
    loop = Loop(model, loading, plan.settle, recording, threads, outcome)
    if checkpointer is not None and checkpointer.start(model, loop):
        outcome.log += [f"resumed at step {loop.done}", *checkpointer.remarks]
    try:
        loop.run(progress, checkpointer)
    except KeyboardInterrupt:
        if checkpointer is not None:
            raise
        outcome.interrupted = True
    except Stopped as stop:
        outcome.stopped = str(stop)
    outcome.seconds_run = loop.seconds
    loop.finish()
    return outcome


def prepare(model: Model, threads: int, progress: Callable[[int, int, str], None] | None) -> Seconds:
    """Have the step of a model compiled, or loaded where it is there already; the time that this takes."""
    begun = Seconds.now()
    if threads > 1:
        _use(threads)
    waiting: contextlib.AbstractContextManager[None] = contextlib.nullcontext()
    if progress is not None and not is_compiled(model, threads):
        what = compiling_text(model)
        progress(0, 0, what)
        waiting = progress.waiting(what) if isinstance(progress, Progress) else waiting
    with waiting:
        compile_for(model, threads)
    return Seconds.now() - begun


def compiling_text(model: Model) -> str:
    """What is compiled: the kinds of blocks and the laws that are in it, of what may meet friction."""
    blocks = " and ".join(kind for kind, members in model.layout.members.items() if len(members))
    words = [word_of(model.groups.parameters[g]) for g in model.swept]
    words += ["friction"] if configuration_of(model).any_size else []
    laws = ", ".join(dict.fromkeys(words))
    return f"compiling the step for {blocks} blocks, law {laws or 'none'} (once for all such scenes, half a minute)"


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
