"""Processes that are started afresh and do one task at a time: a task that kills its process costs that task only."""

import contextlib
import math
import os
import shutil
import signal
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Generator, Iterator, Sequence
from dataclasses import dataclass
from multiprocessing import get_context, parent_process
from multiprocessing.connection import Connection, wait
from pickle import PickleError
from types import ModuleType
from typing import Any

from masonry.runtime.progress import duration

Act = Callable[[Any], Any]
SAFE_PATH = "PYTHONSAFEPATH"
"""The variable that keeps Python from looking into the current folder first."""
STARTING = threading.Lock()


@dataclass(frozen=True)
class Lost:
    """Record of a task without an answer: its process died, it took too long, or its answer cannot travel."""

    reason: str
    seconds: float


def work(act: Act, tasks: Sequence[Any], workers: int, limit: float = math.inf) -> Generator[tuple[int, Any]]:
    """Number of each task and what `act` made of it (or Lost), as they end; tasks are begun in the order given.

    act      a function of a module, which takes a task; what it raises ends its process
    limit    seconds after which a task is given up
    The processes end with the iterator, whatever they do: close it (`contextlib.closing`) where it is left early.
    """
    begun, scratch = 0, tempfile.mkdtemp(prefix="masonry-")  # what an ended worker left half-done goes with it
    crew = [_Worker(act, scratch) for _ in range(min(workers, len(tasks)))]
    try:
        while True:
            for place, worker in enumerate(crew):
                if worker.task is None and begun < len(tasks):
                    if not worker.process.is_alive():
                        crew[place] = worker = _Worker(act, scratch)
                    worker.begin(begun, tasks[begun])
                    begun += 1
            busy = [worker for worker in crew if worker.task is not None]
            if not busy:
                return
            ready = wait([worker.pipe for worker in busy], timeout=1.0)
            for worker in busy:
                if worker.pipe in ready:
                    yield worker.finish()
                elif worker.seconds > limit:
                    yield worker.give_up(limit)
    finally:
        for worker in crew:
            worker.stop()
        shutil.rmtree(scratch, ignore_errors=True)


class _Worker:
    """A process of its own, started afresh (spawn: a fork would copy the threads of what is compiled)."""

    def __init__(self, act: Act, scratch: str) -> None:
        context = get_context("spawn")
        self.pipe, theirs = context.Pipe()
        self.process: Any = context.Process(target=_serve, args=(theirs, act, scratch), daemon=True)
        with _apart():
            self.process.start()
        theirs.close()
        self.task: int | None = None
        self.begun = 0.0

    @property
    def seconds(self) -> float:
        return time.perf_counter() - self.begun

    def begin(self, number: int, task: Any) -> None:
        self.task, self.begun = number, time.perf_counter()
        with contextlib.suppress(BrokenPipeError):  # a process that died already: `finish` says so
            self.pipe.send(task)

    def finish(self) -> tuple[int, Any]:
        """The answer to the task in hand."""
        number = self._put_down()
        try:
            return number, self.pipe.recv()
        except (EOFError, ConnectionResetError):
            self.process.join(5.0)
            return number, Lost(f"the process died (exit code {self.process.exitcode})", self.seconds)

    def give_up(self, limit: float) -> tuple[int, Any]:
        number = self._put_down()
        self.stop()
        return number, Lost(f"no result after {duration(limit)}", limit)

    def _put_down(self) -> int:
        assert self.task is not None
        number, self.task = self.task, None
        return number

    def stop(self) -> None:
        """End the process, whatever it does."""
        self.pipe.close()
        self.process.terminate()
        self.process.join(5.0)
        if self.process.is_alive():
            self.process.kill()
            self.process.join()


@contextlib.contextmanager
def _apart() -> Iterator[None]:
    """Have a process that is started within run nothing that is not ours: no module of the standard library that it
    would look for in the current folder, and not the script of the user once more, of which its tasks need nothing."""
    with STARTING:
        script, before = sys.modules["__main__"], os.environ.get(SAFE_PATH)
        sys.modules["__main__"], os.environ[SAFE_PATH] = ModuleType("__main__"), "1"
        try:
            yield
        finally:
            sys.modules["__main__"] = script
            if before is None:
                del os.environ[SAFE_PATH]
            else:
                os.environ[SAFE_PATH] = before


def _serve(pipe: Connection, act: Act, scratch: str) -> None:
    """A worker's life: a task comes in, what became of it goes out, until the other side closes or is gone."""
    from threadpoolctl import threadpool_limits

    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches all processes of a terminal; the first one decides
    os.environ["OPENBLAS_NUM_THREADS"] = "1"  # for what is loaded later; the limits below are for what is there
    os.environ["TMPDIR"] = tempfile.tempdir = scratch
    threading.Thread(target=_end_with_parent, args=(scratch,), daemon=True).start()
    with contextlib.suppress(EOFError, BrokenPipeError), threadpool_limits(1):
        while True:
            task, begun = pipe.recv(), time.perf_counter()
            answer = act(task)
            try:
                pipe.send(answer)
            except (TypeError, AttributeError, PickleError) as error:
                pipe.send(Lost(f"{type(error).__name__}: {error}", time.perf_counter() - begun))


def _end_with_parent(scratch: str) -> None:
    """Nobody waits for an answer when the first process was killed."""
    parent = parent_process()
    if parent is not None:
        wait([parent.sentinel])
        shutil.rmtree(scratch, ignore_errors=True)
        os._exit(1)
