"""The place where a bad input is tried: what the program says, writes, takes and leaves, and what of it is wrong.

The working folder of the call is `input`; HOME and TMPDIR are folders beside it, which must stay empty.
"""

import contextlib
import faulthandler
import os
import shutil
import signal
import stat
import sys
import traceback
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from geometry.operating_system import SYSTEM
from masonry.runtime.shell import STOPPED, USAGE
from tests.fuzz.attempt import Attempt
from tests.fuzz.odd import FORGED, LEAK, furnish

MEMORY = 3 << 30
"""Bytes of real memory that the program may take for an input; readers of foreign files have a limit of their own."""
HANG = 30.0
"""Seconds after which an input counts as one that hangs."""
LONGEST, MOST_LINES = 4000, 40
"""Letters and lines of what is said against an input."""
WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
CHANGES = {
    **dict.fromkeys(("os.remove", "os.mkdir", "os.rmdir", "os.truncate", "os.chmod", "os.chown", "shutil.rmtree"), 1),
    **dict.fromkeys(("os.rename", "os.symlink", "os.link", "shutil.move"), 2),
}
"""Events of Python's audit hook that change files, and how many paths each has."""
FORBIDDEN = ("pickle.find_class", "os.system", "socket.connect", "webbrowser.open", "os.exec", "os.posix_spawn")
"""Events that no input may lead to."""
Listing = dict[str, tuple[int, ...]]


class Hangs(BaseException):
    """No end in time."""


@dataclass
class Room:
    """root holds `input`, `home` and `tmp`; below `allowed` files may change as well, such as caches."""

    root: Path
    allowed: tuple[Path, ...]
    capture: pytest.CaptureFixture[str]
    seen: list[str] = field(default_factory=list)

    def tried(self, attempt: Attempt) -> list[str]:
        """Call the program, and say what is wrong with what it did; nothing where all is well."""
        folder = self._furnished(attempt)
        before, alive = listing(folder), children()
        forget_peak()
        self.capture.readouterr()
        with ended_in_time(self.root / "stack.txt"), SYSTEM.limited_memory(4 * MEMORY), self._watched():
            code, warned = called(attempt.words)
        faults = [*said_wrong(code, attempt, *self.capture.readouterr()), *warned, *self.seen]
        writes = attempt.when_refused if code == USAGE else attempt.writes
        faults += [f"outside: {name}" for name in differences(before, listing(folder), writes)]
        faults += [f"left over: {top}/{name}" for top in ("home", "tmp") for name in os.listdir(self.root / top)]
        faults += [f"left running: process {number}" for number in children() - alive]
        if peak() > MEMORY:
            faults.append(f"took {peak() / 1e9:.2g} GB of memory")
        return faults

    def _furnished(self, attempt: Attempt) -> Path:
        """The working folder with the files of the input, and with paths that are no files."""
        for name in ("input", "home", "tmp"):
            shutil.rmtree(self.root / name, ignore_errors=True)
            (self.root / name).mkdir()
        folder = self.root / "input"
        furnish(folder)
        for name, content in attempt.files.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            if isinstance(content, Path):
                (folder / name).symlink_to(folder / content)
            else:
                (folder / name).write_bytes(content)
        os.chdir(folder)
        return folder

    @contextlib.contextmanager
    def _watched(self) -> Iterator[None]:
        hooked()
        self.seen.clear()
        ROOMS.append(self)
        try:
            yield
        finally:
            ROOMS.remove(self)

    def watch(self, event: str, words: tuple[Any, ...]) -> None:
        """An audit hook: notes what is written elsewhere, and what must never happen."""
        if event in FORBIDDEN and not _by_numba():
            self.seen.append(f"{event} {words[:2]!r:.200}")
        elif event == "open" and isinstance(words[2], int) and words[2] & WRITING:
            as_it_is = isinstance(words[0], int) or words[2] & os.O_NOFOLLOW
            self._note(event, words[0] if as_it_is else os.path.realpath(words[0]))
        elif event in CHANGES:
            for path in words[: CHANGES[event]]:
                self._note(event, path)

    def _note(self, event: str, path: Any) -> None:
        if isinstance(path, int):
            return
        with contextlib.suppress(TypeError, ValueError):
            place = Path(os.path.abspath(os.fsdecode(path)))
            fine = (self.root / "input", self.root / "tmp", Path("/dev/null"), *self.allowed)
            if not any(place.is_relative_to(top) for top in fine):
                self.seen.append(f"{event} {place}")


ROOMS: list[Room] = []
"""The room where an input is being tried."""


@cache
def hooked() -> None:
    """Have the hook called from now on: it cannot be taken away."""
    sys.addaudithook(lambda event, words: ROOMS[-1].watch(event, words) if ROOMS else None)


def _by_numba() -> bool:
    """Whether Numba is at work, which keeps what it compiled as pickles in a cache of its own."""
    return any("/numba/" in frame.f_code.co_filename for frame, _ in traceback.walk_stack(None))


def called(words: list[str]) -> tuple[int, list[str]]:
    """The exit code (-1 for an exception), and warnings; what is said goes to the streams as a shell has them."""
    from masonry.cli.main import main

    with (
        warnings.catch_warnings(record=True) as warned,
        open(1, "w", encoding="utf-8", errors="strict", closefd=False) as out,
        open(2, "w", encoding="utf-8", errors="backslashreplace", closefd=False) as err,
        contextlib.redirect_stdout(out),
        contextlib.redirect_stderr(err),
    ):
        warnings.simplefilter("default")
        for kind in (DeprecationWarning, PendingDeprecationWarning, ImportWarning, ResourceWarning):
            warnings.simplefilter("ignore", kind)
        try:
            code = main(words)
        except Hangs:
            code = -1
            print(f"Traceback: hangs: no end after {HANG:g} s", file=sys.stderr)
        except (Exception, SystemExit):  # the program returns its exit code
            code = -1
            traceback.print_exc()
    return code, [f"a warning of a package: {one.message!s:.300}" for one in warned]


@contextlib.contextmanager
def ended_in_time(stack: Path) -> Iterator[None]:
    """Raise Hangs in what takes too long; where native code never returns, end the process and write where it was."""

    def late(number: int, frame: Any) -> None:
        raise Hangs

    usual = signal.signal(signal.SIGALRM, late)
    signal.setitimer(signal.ITIMER_REAL, HANG)
    with open(stack, "w", encoding="utf-8") as file:
        faulthandler.dump_traceback_later(2 * HANG, file=file, exit=True)
        try:
            yield
        finally:
            faulthandler.cancel_dump_traceback_later()
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, usual)


def said_wrong(code: int, attempt: Attempt, out: str, err: str) -> list[str]:
    """What is wrong with the exit code and with what was said."""
    faults = []
    if code not in attempt.codes:
        faults.append(f"exit code {code}")
    if "Traceback" in err:
        faults.append(f"traceback: {err.strip().splitlines()[-1][:200]}")
    elif code in (USAGE, STOPPED) and not any(line.startswith("masonry: ") for line in err.splitlines()):
        faults.append(f"no message: {err[:200]!r}")
    if len(err) > LONGEST or err.count("\n") > MOST_LINES:
        faults.append(f"a message of {len(err)} letters in {err.count(chr(10))} lines")
    odd = {c for c in out + err if not c.isprintable() and c != "\n"}
    if odd:
        faults.append(f"control characters are shown: {sorted(odd)!r:.80}")
    if any(line.lstrip().startswith(FORGED) for line in (out + err).splitlines()):
        faults.append("a name looks like a line of its own")
    if LEAK in out + err:
        faults.append("the words of a file of others are repeated")
    return faults


def listing(folder: Path) -> Listing:
    """Every name below a folder with its kind, and the size and time of what is a file."""
    found: Listing = {}
    for top, folders, files in os.walk(folder):
        for name in (*folders, *files):
            state = os.lstat(os.path.join(top, name))
            one = (state.st_mode, state.st_size, state.st_mtime_ns)
            found[os.path.relpath(os.path.join(top, name), folder)] = one if stat.S_ISREG(state.st_mode) else one[:1]
    return found


def differences(before: Listing, after: Listing, writes: tuple[str, ...]) -> list[str]:
    """Names that came, went or changed, other than those that may."""
    changed = {name for name in before | after if before.get(name) != after.get(name)}
    return sorted(name for name in changed if not any(name == top or name.startswith(f"{top}/") for top in writes))


def forget_peak() -> None:
    """Count the memory from here on, where the system can."""
    with contextlib.suppress(OSError):
        Path("/proc/self/clear_refs").write_text("5", encoding="ascii")


def peak() -> int:
    """Bytes of real memory, at most; 0 where the system does not say."""
    with contextlib.suppress(OSError):
        for line in Path("/proc/self/status").read_text(encoding="ascii", errors="replace").splitlines():
            if line.startswith("VmHWM:"):
                return int(line.split()[1]) * 1024
    return 0


def children() -> set[str]:
    """Numbers of the processes that this one has begun and that have not gone."""
    names: set[str] = set()
    with contextlib.suppress(OSError):
        for task in Path("/proc/self/task").iterdir():
            names |= set((task / "children").read_text(encoding="ascii").split())
    return names
