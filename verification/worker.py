"""One case run to its end, in this process or in another: whatever happens there becomes an outcome with a reason."""

import contextlib
import time
import traceback
from multiprocessing import get_context
from multiprocessing.connection import Connection
from pickle import PickleError
from typing import Any

from threadpoolctl import threadpool_limits

from geometry.blocks import GeometryError
from masonry.errors import SceneError, Stopped
from verification.case import Case, Findings, RequiredFeature
from verification.outcome import Outcome, judge

EXPECTED = (SceneError, GeometryError, Stopped, MemoryError)
"""Errors that say themselves what is wrong; of any other one the place in the code is told as well."""


def run_case(case: Case) -> Outcome:
    """The outcome of a case; raises nothing but KeyboardInterrupt."""
    begun = time.perf_counter()
    findings = Findings()
    try:
        findings = case.run()
        status, reason = judge(findings)
    except RequiredFeature as lacking:
        status, reason = "NOT BUILT", f"needs {str(lacking) or 'a feature'}"
    except EXPECTED as error:
        status, reason = "ERROR", f"{type(error).__name__}: {error}"
    except Exception as error:
        last = traceback.extract_tb(error.__traceback__)[-1]
        status, reason = "ERROR", f"{type(error).__name__}: {error} ({last.filename}, line {last.lineno})"
    return Outcome(case, findings, status, reason, time.perf_counter() - begun)


def serve(pipe: Connection) -> None:
    """A worker's life: a case comes in, what became of it goes out, until the other side closes."""
    with contextlib.suppress(EOFError, KeyboardInterrupt, BrokenPipeError), threadpool_limits(1):
        while True:
            outcome = run_case(pipe.recv())
            try:
                pipe.send((outcome.findings, outcome.status, outcome.reason, outcome.seconds))
            except (TypeError, AttributeError, PickleError) as error:  # something in the findings cannot travel
                pipe.send((Findings(), "ERROR", f"{type(error).__name__}: {error}", outcome.seconds))


class Worker:
    """A process of its own, started afresh (spawn), that runs one case at a time."""

    def __init__(self) -> None:
        context = get_context("spawn")
        self.pipe, theirs = context.Pipe()
        self.process: Any = context.Process(target=serve, args=(theirs,), daemon=True)
        self.process.start()
        theirs.close()
        self.case: Case | None = None
        self.begun = 0.0

    def begin(self, case: Case) -> None:
        """Hand it a case; `finish` once its pipe is ready."""
        self.case, self.begun = case, time.perf_counter()
        with contextlib.suppress(BrokenPipeError):  # a process that died already: `finish` says so
            self.pipe.send(case)

    def finish(self) -> Outcome:
        """The outcome of the case in hand; a process that died is an error of the case."""
        assert self.case is not None
        case, self.case = self.case, None
        try:
            return Outcome(case, *self.pipe.recv())
        except EOFError:
            self.process.join(5.0)
            reason = f"the process died (exit code {self.process.exitcode})"
            return Outcome(case, Findings(), "ERROR", reason, time.perf_counter() - self.begun)

    def stop(self) -> None:
        """End the process, whatever it does."""
        self.pipe.close()
        self.process.terminate()
        self.process.join(5.0)
