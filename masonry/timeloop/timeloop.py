"""A whole run of a model: its step is compiled or loaded, its chunks are taken, and what it came to is put together."""

import time
from collections.abc import Callable

import numba
import numpy as np

from geometry.jit_cache import NOT_KEPT
from masonry.errors import SceneError, Stopped
from masonry.history import UNITS, History
from masonry.loading.dispatch import pace_of
from masonry.model.loads import Controlled, Program
from masonry.model.model import Model
from masonry.timeloop.checkpointer import Keeper
from masonry.timeloop.compiled_step import compile_for
from masonry.timeloop.loop import Loop
from masonry.timeloop.recording import Outcome, Recording


def run(
    model: Model,
    plan: Program | Controlled,
    recording: Recording,
    threads: int = 1,
    progress: Callable[[int, int, str], None] | None = None,
    keeper: Keeper | None = None,
) -> Outcome:
    """Run the whole plan. An unstable or too large motion ends it: Outcome.stopped says why, rows stay trusted.

    keeper  writes checkpoints, goes on from one, and says when to end; without one, Ctrl-C ends the run
    """
    outcome = Outcome(History({key: np.zeros(0) for key in UNITS}))
    if threads > 1:
        _use(threads)
    begun = time.perf_counter()
    pace = pace_of(model, plan, recording.rows)
    if progress is not None:
        progress(0, pace.progress()[1], "compiling the step for this scene, or loading it")
    compile_for(model, threads)
    if NOT_KEPT:
        outcome.log.append(f"what was compiled could not be kept, so the next run compiles it again: {NOT_KEPT[0]}")
    outcome.seconds_compile = time.perf_counter() - begun
    loop = Loop(model, pace, plan.settle, recording, threads, outcome)
    if keeper is not None and keeper.start(model, loop):
        outcome.log += [f"resumed at step {loop.done}", *keeper.remarks]
    try:
        loop.run(progress, keeper)
    except KeyboardInterrupt:
        if keeper is not None:
            raise
        outcome.interrupted = True
    except Stopped as stop:
        outcome.stopped = str(stop)
    outcome.seconds_run = loop.seconds
    loop.finish()
    return outcome


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
