"""The reader of foreign files as a fork of this process: the same code under the same limits, begun in milliseconds.

Started afresh, as the program does it, a reader needs most of a second to begin; this is for many thousand files. Every
`AFRESH`th one is started as the program does it.
"""

import contextlib
import ctypes
import os
import signal
import subprocess
import time
from pathlib import Path
from typing import Any

from geometry.files import sandbox as guard

AFRESH = 25
START = 5
"""Seconds of processor time that a reader has for a small file, in the place of `guard.START`."""
END_WITH_PARENT = 1
"""PR_SET_PDEATHSIG of prctl(2)."""
_afresh = guard.begin
_count = 0


class Forked:
    """As far as `geometry.files.sandbox` needs a subprocess.Popen."""

    def __init__(self, task: str, folder: Path) -> None:
        self.code: int | None = None
        self.pid = os.fork()
        if self.pid == 0:
            code = 70
            with contextlib.suppress(BaseException):
                ctypes.CDLL(None).prctl(END_WITH_PARENT, signal.SIGKILL)
                os.setsid()
                os.chdir(folder)
                nothing = os.open(os.devnull, os.O_RDWR)
                for n in range(3):
                    os.dup2(nothing, n)
                signal.signal(signal.SIGTERM, signal.SIG_DFL)
                code = guard.serve(task)
            os._exit(code)

    def poll(self) -> int | None:
        """The exit code, None while it runs."""
        if self.code is None:
            number, status = os.waitpid(self.pid, os.WNOHANG)
            self.code = os.waitstatus_to_exitcode(status) if number else None
        return self.code

    def wait(self, timeout: float | None = None) -> int:
        """The exit code at the end. Raises subprocess.TimeoutExpired."""
        end = time.monotonic() + (timeout or 1e9)
        pause = 1e-3
        while (code := self.poll()) is None:
            if timeout is not None and time.monotonic() > end:
                raise subprocess.TimeoutExpired("reader", timeout)
            time.sleep(pause)
            pause = min(2 * pause, 0.02)
        return code

    def kill(self) -> None:
        """End it."""
        os.kill(self.pid, signal.SIGKILL)


def begin(task: str, folder: Path, alive: int) -> Any:
    """In the place of `geometry.files.sandbox.begin`."""
    global _count
    _count += 1
    return _afresh(task, folder, alive) if _count % AFRESH == 0 else Forked(task, folder)


def quicken() -> None:
    """Have readers begun so, with what they import loaded already."""
    import meshio  # noqa: F401

    import geometry.files.cad
    import geometry.files.mesh_files
    import geometry.files.tess  # noqa: F401
    from geometry.meshes.gmsh_session import gmsh_model

    with gmsh_model({}):
        pass
    guard.begin, guard.START = begin, START
