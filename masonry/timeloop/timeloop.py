"""A whole run of a model: its step is compiled or loaded, its chunks are taken, and what it came to is put together."""

from collections.abc import Callable

from geometry.jit_cache import NOT_KEPT, NOWHERE
from masonry.errors import Stopped
from masonry.loading.plan import Plan
from masonry.model.model import Model
from masonry.monitors.recording import Recording
from masonry.rows.history import History
from masonry.timeloop.checkpointer import Checkpointer
from masonry.timeloop.compiling import prepare
from masonry.timeloop.loop import Loop
from masonry.timeloop.run_outcome import Outcome


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
    for why in (*NOWHERE, *NOT_KEPT)[:1]:
        outcome.log.append(f"what was compiled could not be kept, so the next run compiles it again: {why}")
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
