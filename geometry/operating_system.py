"""The operating system: all that the program asks of it and that not every system has, each with a plain substitute.

`Plain` asks for nothing but what Python has everywhere, and is what Windows gets; `Posix` is what macOS has more, and
`Linux` what Linux has more still. MASONRY_SYSTEM=plain or =posix in the environment chooses one that knows less than
this system, so that substitutes are tried where the real thing is at hand. Nobody else asks which system this is.
"""

import errno
import os
import platform
import re
import signal
import stat
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path, PureWindowsPath
from typing import Any

CHOICE = "MASONRY_SYSTEM"
RETRIES = (0.02, 0.05, 0.1, 0.3, 0.5)
"""Seconds between attempts at a file that another program has open, as scanners for viruses have for a moment."""
OF_OTHERS, FOR_ONE = 0o022, 0o700
"""Bits of a folder by which a group or all may write to it, and those of a folder for its owner alone."""
_NO_NAME = re.compile(r'[<>:"|?*\x00-\x1f]|[. ]$|^(con|prn|aux|nul|com\d|lpt\d) *(\.|$)', re.IGNORECASE)


class Plain:
    """Substitutes that work on every system; what Windows forbids, it forbids as well.

    ending               signals that ask a process to end, but for Ctrl-C
    too_late             exit code of a process that was ended by `limit_process` for its seconds
    removes_open_files   whether a file can be removed while it is open
    reads_locked_files   whether a file can be read while another process has it locked
    """

    ending: tuple[signal.Signals, ...] = (signal.SIGTERM,)
    if sys.platform == "win32":
        ending = (signal.SIGTERM, signal.SIGBREAK)  # which also comes where a console is closed
    too_late = 5
    removes_open_files = False
    reads_locked_files = False

    def processors(self) -> int:
        """The number that this process may use."""
        return os.cpu_count() or 1

    def busy_processors(self) -> float:
        """The mean number at work in the last minute; 0 where the system does not tell."""
        return 0.0

    def processor_name(self) -> str:
        """The model of the processor."""
        return platform.processor() or "unknown processor"

    def short_seconds(self) -> float:
        """A clock for work of some milliseconds: of processor where its clock has such ticks (Windows: 16 ms)."""
        return time.perf_counter()

    def strangers(self, folder: Path) -> str:
        """Who else may write to a folder, as a sentence; "" for nobody, and where that cannot be asked."""
        return ""

    def close_to_others(self, folder: Path) -> None:
        """Have other users see nothing of a folder."""

    def wakeup_pipe(self) -> tuple[int, int]:
        """Both ends of a pipe, to read and to write, into which a handler of signals may write."""
        theirs, mine = os.pipe()
        if sys.platform != "win32":
            os.set_blocking(mine, False)
        return theirs, mine

    def apart(self) -> dict[str, Any]:
        """Words of subprocess.Popen for a process that Ctrl-C in this terminal does not reach."""
        if sys.platform == "win32":
            import subprocess

            return {"creationflags": subprocess.CREATE_NEW_PROCESS_GROUP}
        return {}

    def home(self, folder: Path) -> dict[str, str]:
        """Variables of a process whose libraries leave their settings in this folder."""
        return dict.fromkeys(("HOME", "USERPROFILE", "APPDATA", "LOCALAPPDATA"), str(folder))

    def limit_process(self, memory: int, seconds: int) -> None:
        """End this process after so many seconds of processor; memory (bytes) is not limited here."""

        def watch() -> None:
            while time.process_time() < seconds:
                time.sleep(0.1)
            os._exit(self.too_late)

        threading.Thread(target=watch, daemon=True).start()

    @contextmanager
    def limited_memory(self, more: int) -> Iterator[None]:
        """Let this process take up `more` bytes beyond what it has, where the system can see to that."""
        yield

    def replace(self, path: Path, target: Path) -> None:
        """Give a file or a folder another name, in place of the file that has it. Raises OSError; where another
        program has one of them open it is tried for a second."""
        for seconds in RETRIES:
            with suppress(PermissionError):
                os.replace(path, target)
                return
            time.sleep(seconds)
        try:
            os.replace(path, target)
        except PermissionError as error:
            words = f"'{Path(target).name}' cannot be replaced; is it open in another program?"
            raise PermissionError(error.errno, words, str(target)) from None

    def flush(self, path: Path) -> None:
        """Have the disk hold what was written to a file; of a folder nothing is left to do."""
        if not path.is_dir():
            _flush(path, os.O_RDWR)

    def is_name(self, path: str) -> bool:
        """Whether files and folders can be called so: no NUL, no half of a letter, nothing that Windows keeps."""
        pure = PureWindowsPath(path)
        parts = pure.parts[1:] if pure.anchor else pure.parts
        return _is_encoded(path) and not any(_NO_NAME.search(part) for part in parts if part not in (".", ".."))

    def has_display(self) -> bool:
        """Whether windows can be shown, as far as the system tells."""
        return True

    def is_reader_gone(self, error: OSError) -> bool:
        """Whether writing failed as nobody reads the pipe any more."""
        return isinstance(error, BrokenPipeError) or (error.errno == errno.EINVAL and error.filename is None)


SYSTEM: Plain = Plain()
"""The one that the program runs on."""

if sys.platform != "win32":
    import resource

    class Posix(Plain):
        """What macOS and Linux have."""

        ending = (signal.SIGTERM, signal.SIGHUP)
        too_late = -signal.SIGXCPU
        removes_open_files = True
        reads_locked_files = True

        def busy_processors(self) -> float:
            return os.getloadavg()[0]

        def short_seconds(self) -> float:
            return time.process_time()

        def strangers(self, folder: Path) -> str:
            state = folder.stat()
            if state.st_uid != os.geteuid():
                return f"'{folder}' belongs to another user (number {state.st_uid})"
            if state.st_mode & OF_OTHERS:
                return f"other users may write to '{folder}': delete it, or take that from them (chmod go-w)"
            return ""

        def close_to_others(self, folder: Path) -> None:
            if (mode := stat.S_IMODE(folder.stat().st_mode)) & ~FOR_ONE:
                folder.chmod(mode & FOR_ONE)

        def apart(self) -> dict[str, Any]:
            return {"start_new_session": True}

        def home(self, folder: Path) -> dict[str, str]:
            return {"HOME": str(folder)}

        def limit_process(self, memory: int, seconds: int) -> None:
            for limit, bound in ((resource.RLIMIT_CPU, seconds), (resource.RLIMIT_CORE, 0)):
                _set_limit(limit, bound)
            _set_limit(resource.RLIMIT_FSIZE, memory)

        def replace(self, path: Path, target: Path) -> None:
            os.replace(path, target)

        def flush(self, path: Path) -> None:
            _flush(path, os.O_RDONLY)

        def is_name(self, path: str) -> bool:
            return _is_encoded(path)

        def is_reader_gone(self, error: OSError) -> bool:
            return isinstance(error, BrokenPipeError)

    def _set_limit(limit: int, bound: int) -> None:
        hard = resource.getrlimit(limit)[1]
        resource.setrlimit(limit, (bound if hard == resource.RLIM_INFINITY else min(bound, hard), hard))

    SYSTEM = Posix()

if sys.platform == "linux":

    class Linux(Posix):
        """What Linux alone has: processors of a process, /proc, and limits of memory that hold."""

        def processors(self) -> int:
            return len(os.sched_getaffinity(0))

        def processor_name(self) -> str:
            try:
                lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
            except OSError:
                lines = []
            named = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
            return named[0] if named else super().processor_name()

        def has_display(self) -> bool:
            return any(os.environ.get(key) for key in ("DISPLAY", "WAYLAND_DISPLAY"))

        def limit_process(self, memory: int, seconds: int) -> None:
            _set_limit(resource.RLIMIT_AS, memory)
            super().limit_process(memory, seconds)

        @contextmanager
        def limited_memory(self, more: int) -> Iterator[None]:
            try:
                pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
            except (OSError, ValueError):
                yield
                return
            soft, hard = resource.getrlimit(resource.RLIMIT_AS)
            total = pages * resource.getpagesize() + more
            bounds = [limit for limit in (soft, hard) if limit != resource.RLIM_INFINITY]
            resource.setrlimit(resource.RLIMIT_AS, (min([total, *bounds]), hard))
            try:
                yield
            finally:
                resource.setrlimit(resource.RLIMIT_AS, (soft, hard))

    SYSTEM = Linux()


def _flush(path: Path, how: int) -> None:
    handle = os.open(path, how)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _is_encoded(path: str) -> bool:
    try:
        return b"\0" not in os.fsencode(path)
    except UnicodeEncodeError:
        return False


def _chosen(word: str) -> Plain:
    """The system that the environment names, of those that this one can stand in for; this one where it names none."""
    kinds = {kind.__name__.lower(): kind for kind in type(SYSTEM).__mro__ if issubclass(kind, Plain)}
    return kinds.get(word, type(SYSTEM))()


SYSTEM = _chosen(os.environ.get(CHOICE, ""))
